"""Observers: estimates of unmeasured states and disturbances."""
