"""Runs of an arm: configuration and run."""
