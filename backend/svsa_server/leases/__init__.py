"""Control of a session: lease, queue, and outcomes of requests."""
