"""Values that drives, encoders, safety and loop of a bench share: settings, homing, readings."""
