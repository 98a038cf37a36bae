"""The bench as the plant of the loop: clock, readings and commands of each tick."""
