"""Bodies of the routes of recorded runs."""
