"""The server's data of each session: state, recording, bench, stream."""
