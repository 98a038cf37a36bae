"""Grades: what was handed in, run again where nobody can peek."""
