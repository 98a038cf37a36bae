"""Long-running jobs in parallel with the live sessions: queue, progress, cancellation."""
