"""Bodies of the session's routes and the stream."""
