"""Results of whole runs, simulated, on the emulator or recorded: numbers and figures."""
