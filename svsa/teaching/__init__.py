"""Course, grading, leaderboard and the isolation of submitted code."""
