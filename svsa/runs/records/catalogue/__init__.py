"""The catalogue of runs on this machine: a SQLite index of their folders."""
