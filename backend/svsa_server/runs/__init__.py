"""Recorded runs as people see them: their lanes, and files of other programs."""
