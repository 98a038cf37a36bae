"""Metrics of a run, during it or afterwards: errors, effort, step response; the paper's claims."""
