"""References of position and stiffness."""
