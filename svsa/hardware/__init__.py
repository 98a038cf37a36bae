"""The bench: drives on CAN, encoders, states, limits."""
