"""Bodies of the bench's routes."""
