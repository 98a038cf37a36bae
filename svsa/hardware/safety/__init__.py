"""Safety functions of a bench: checks, limits, and reactions to faults."""
