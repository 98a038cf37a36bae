"""Eight actuators side by side: a number type of eight doubles, for the same equations."""
