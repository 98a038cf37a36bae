"""Long work in parallel with the live sessions: queue, progress, cancelling."""
