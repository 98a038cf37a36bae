"""The loop that drives a bench: a process of its own, and the session that watches it."""
