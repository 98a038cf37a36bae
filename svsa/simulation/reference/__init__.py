"""What the actuator is asked to follow."""
