"""Measurement of the loop's cost: `svsa benchmark`."""
