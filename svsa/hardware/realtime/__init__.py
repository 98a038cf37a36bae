"""The real-time loop of a bench in its own process, and its connection to the session."""
