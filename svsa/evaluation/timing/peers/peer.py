"""What a peer is: a package, its methods with their settings, and what makes a solver of one."""

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from svsa.evaluation.timing.peers.problem import Problem

Solver = Callable[[], np.ndarray]
"""Solves the problem that it was built for: the states at the end of each period, (periods, 6)."""


class Peer(NamedTuple):
    """A package beside us.

    package: its name for an import. methods: by name the settings, the least accurate first.
    build: the solver of a problem by a method at one of its settings; what it costs to build is
    not counted.
    """

    package: str
    methods: Mapping[str, Sequence[float]]
    build: Callable[[Problem, str, float], Solver]
