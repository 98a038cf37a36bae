"""Families of drives, one folder each, and their common interface."""
