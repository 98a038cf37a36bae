"""A course in the lab: exercises as files, what is submitted, and how it is judged."""
