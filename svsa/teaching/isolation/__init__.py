"""A control law that nobody has read, in a process of its own that has nothing but its task."""
