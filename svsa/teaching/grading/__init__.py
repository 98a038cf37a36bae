"""Grading: submitted runs are simulated again, submitted laws run in isolation."""
