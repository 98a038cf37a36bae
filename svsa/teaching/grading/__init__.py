"""Grades: what was submitted, run again where nobody can peek."""
