"""The simulated actuator with loads and non-ideal effects."""
