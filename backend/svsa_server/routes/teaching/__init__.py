"""Course, grades, leaderboard and learning platforms."""
