"""What the loop costs: `svsa benchmark`."""
