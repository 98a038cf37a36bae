"""Models of actuators and arms for other programs."""
