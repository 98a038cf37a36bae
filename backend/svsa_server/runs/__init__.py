"""Recorded runs in the API: their lanes, and exports."""
