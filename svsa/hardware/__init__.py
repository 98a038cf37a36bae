"""The real actuator: two drives on CAN, an encoder, and its safety functions."""
