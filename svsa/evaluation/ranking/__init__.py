"""The ranking: every law on the same plant, limits, noise and loads, and what comes of it."""
