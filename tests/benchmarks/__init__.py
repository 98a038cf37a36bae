"""What things cost: not tests, since a busy machine would make them fail."""
