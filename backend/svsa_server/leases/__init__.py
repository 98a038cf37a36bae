"""Who is in control of a session, who waits, and what became of a call."""
