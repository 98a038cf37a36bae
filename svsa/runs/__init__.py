"""Runs: definition, timeline, execution, metrics, sessions, records and results."""
