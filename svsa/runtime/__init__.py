"""The loop, runs, sessions and their clocks."""
