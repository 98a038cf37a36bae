"""The session of a bench, as the server sees it."""
