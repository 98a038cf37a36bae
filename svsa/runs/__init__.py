"""A run as a value: configuration, commands, who controlled what, and how well."""
