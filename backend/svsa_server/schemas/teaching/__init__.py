"""Bodies of the routes of course, grades and leaderboard."""
