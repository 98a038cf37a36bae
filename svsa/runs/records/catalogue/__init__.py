"""The runs on this machine: an index in SQLite over the folders of their records."""
