"""Families of drives, each in a folder of its own, and what the bench expects of each."""
