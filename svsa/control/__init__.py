"""The control laws, their gains and the torque limits."""
