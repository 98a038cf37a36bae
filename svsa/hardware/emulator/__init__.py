"""The emulator: a process that behaves like the bench on the CAN bus."""
