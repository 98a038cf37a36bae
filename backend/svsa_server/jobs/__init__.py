"""Long work beside the live sessions: queue, progress, cancelling."""
