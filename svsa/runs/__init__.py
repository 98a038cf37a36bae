"""Runs as values: configuration, commands, timeline, metrics, records and results."""
