"""Benchmarks. They are not tests, since their results depend on the load of the machine."""
