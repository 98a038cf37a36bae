"""Whole runs in hand, simulated, on the emulated rig or recorded: numbers and pictures."""
