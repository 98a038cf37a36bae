"""Bodies of the routes of login, classes and audit log."""
