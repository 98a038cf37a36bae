"""What the server keeps about each session: its state, recording, bench, stream."""
