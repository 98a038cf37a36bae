"""Login, classes and their members, and the audit log."""
