"""Parameters of the actuator from a recorded run."""
