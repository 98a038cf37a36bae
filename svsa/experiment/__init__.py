"""The paper's experiments, whole runs, their numbers and pictures."""
