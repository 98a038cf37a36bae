"""User input: values and files, validated with units, limits and clear errors."""
