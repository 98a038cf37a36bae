"""A run over time, from its configuration and commands: loads, controllers, windows, events."""
