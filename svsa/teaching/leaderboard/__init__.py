"""The leaderboard: submitted and installed laws on the hidden trials of a season."""
