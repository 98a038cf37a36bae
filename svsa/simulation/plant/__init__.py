"""The simulated actuator and what the world does to it."""
