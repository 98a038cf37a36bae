"""Records of runs: written during the run, recovered after a crash, read back."""
