"""The leaderboard: laws that were handed in, and the installed ones, on a season nobody knows."""
