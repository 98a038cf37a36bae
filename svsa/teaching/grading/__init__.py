"""Grading: submissions, run again in isolation."""
