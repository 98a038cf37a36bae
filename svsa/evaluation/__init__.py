"""Comparison of control laws: ranking, tuning, studies and falsifier."""
