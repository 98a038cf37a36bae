"""One control law per file."""
