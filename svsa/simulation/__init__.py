"""References, plant, loads and the control loop."""
