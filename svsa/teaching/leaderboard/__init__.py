"""The leaderboard: laws that were submitted, and the installed ones, on a season nobody knows."""
