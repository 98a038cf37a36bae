"""What the loop costs: `svsa bench`."""
