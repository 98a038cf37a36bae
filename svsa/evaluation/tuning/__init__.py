"""Tuning of the parameters of a control law."""
