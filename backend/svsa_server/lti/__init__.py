"""LTI 1.3: launches from a learning platform into the class, and grades back to it."""
