"""Isolation of an untrusted control law in a process that can only compute."""
