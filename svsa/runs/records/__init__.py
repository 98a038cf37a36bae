"""Records of runs: written while they go on, recovered after a crash, read back."""
