"""Authentication, permissions, and the guard that checks every request."""
