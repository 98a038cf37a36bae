"""Results of complete runs, simulated, on the emulator or recorded: numbers and figures."""
