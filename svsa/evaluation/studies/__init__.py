"""Studies: many runs of every law with varied settings, and their statistics."""
