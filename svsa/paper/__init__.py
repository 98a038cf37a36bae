"""The paper: its figures as runs, and reproduced with their table of numbers and pictures."""

from svsa.run.figure import (
    BENCH_FIGURES,
    CABLE_PULL,
    DURATION_S,
    FIGURES,
    LOAD_TIME_S,
    STEADY_S,
    Figure,
    get_figure,
)

__all__ = [
    "BENCH_FIGURES",
    "CABLE_PULL",
    "DURATION_S",
    "FIGURES",
    "LOAD_TIME_S",
    "STEADY_S",
    "Figure",
    "get_figure",
]
