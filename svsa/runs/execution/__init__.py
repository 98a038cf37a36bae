"""Execution of a run: in slices, tick by tick, in batches, and again from its commands."""
