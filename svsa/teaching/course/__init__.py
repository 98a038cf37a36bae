"""A course in the lab: exercises as files, what is handed in, and how it is judged."""
