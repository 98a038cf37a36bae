"""Where an adversary looks: CMA-ES over its ranges, begun anew where it has converged.

N. Hansen, "The CMA Evolution Strategy: A Tutorial" (2016), by the package `cmaes`. A generation is
one batch: 32 runs, four times the eight that go side by side. Chance is Philox, keyed by the seed
and the number of the start.
"""

from collections.abc import Callable, Iterator
from typing import Literal

import numpy as np

from svsa.evaluation.ranking.trials import start_generator

Method = Literal["cma", "random"]
GENERATION = 32
STEP = 0.3
CONVERGED = 0.01
"""Of the ranges: what a generation is then no wider than."""
PATIENCE = 15
"""Generations that a start goes on without a worse run."""
_HARMLESS = 1e30
"""As the optimiser takes it that a run is the best of all for the law."""

Judge = Callable[[np.ndarray], np.ndarray]
"""(n, size) shares from 0 to 1 → (n,) how much each hurts, infinite for what ends the search."""


def search(method: Method, size: int, seed: int, judge: Judge) -> None:
    """Ask `judge` of one generation after another, until it raises."""
    if method == "random":
        for shares in _draw(size, seed):
            judge(shares)
    start = 0
    while True:
        _climb(size, seed, start, judge)
        start += 1


def _draw(size: int, seed: int) -> Iterator[np.ndarray]:
    random = start_generator(seed, 0)
    while True:
        yield random.random((GENERATION, size))


def _climb(size: int, seed: int, start: int, judge: Judge) -> None:
    """One start of CMA-ES, from a place of its own until it has converged."""
    from cmaes import CMA

    random = start_generator(seed, start)
    optimizer = CMA(
        mean=random.random(size),
        sigma=STEP,
        bounds=np.array([[0.0, 1.0]] * size),
        seed=int(random.integers(2**32)),
        population_size=GENERATION,
    )
    worst, since = -np.inf, 0
    while since < PATIENCE:
        shares = np.array([optimizer.ask() for _ in range(GENERATION)])
        severity = judge(shares)
        cost = np.where(np.isfinite(severity), -severity, _HARMLESS)
        optimizer.tell(list(zip(shares, cost.tolist(), strict=True)))
        if optimizer.should_stop() or np.ptp(shares, axis=0).max() < CONVERGED:
            return
        worst, since = max(worst, severity.max()), 0 if severity.max() > worst else since + 1
