"""Search for the parameters of a control law."""
