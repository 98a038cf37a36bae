"""The emulator: a process that behaves on the wire as the bench does."""
