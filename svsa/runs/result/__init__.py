"""Whole runs in hand, simulated, on the emulator or recorded: numbers and pictures."""
