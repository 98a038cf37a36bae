"""The ranking: every law on the same plant, limits, noise and loads."""
