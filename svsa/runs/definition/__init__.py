"""A run as a value: configuration, commands, and the forms in which users write them."""
