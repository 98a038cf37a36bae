"""The real actuator: two drives on CAN, an encoder, and what keeps it safe."""
