"""Search of the unit cube: CMA-ES with restarts after convergence, or random points.

N. Hansen, "The CMA Evolution Strategy: A Tutorial" (2016), by the package `cmaes`. A generation is
judged as one batch. Chance is Philox, keyed by the seed and the number of the start.
"""

from collections.abc import Callable, Iterator
from typing import Literal

import numpy as np

from svsa.evaluation.trials import start_generator

Method = Literal["cma", "random"]
GENERATION = 32
STEP = 0.3
CONVERGED = 0.01
"""Of the ranges: what a generation is then no wider than."""
PATIENCE = 15
"""Generations that a start goes on without a worse run."""
_HARMLESS = 1e30
"""As the optimizer takes it that a run is the best of all for the law."""

Judge = Callable[[np.ndarray], np.ndarray]
"""(n, size) shares from 0 to 1 → (n,) what is maximized, infinite for what ends the search."""


def search(
    method: Method,
    size: int,
    seed: int,
    judge: Judge,
    generation: int = GENERATION,
    step: float = STEP,
    start: np.ndarray | None = None,
) -> None:
    """Pass one generation after another to `judge`, until it raises.

    Args:
        method: CMA-ES, or random points.
        size: Of the cube.
        seed: Of all chance.
        judge: What is maximized.
        generation: Points in a generation.
        step: First standard deviation of CMA-ES.
        start: Where the first start of CMA-ES begins, (size,); a random point if left out.
    """
    if method == "random":
        for shares in _draw(size, seed, generation):
            judge(shares)
    number = 0
    while True:
        random = start_generator(seed, number)
        mean = random.random(size)
        _climb(mean if start is None or number else start, step, random, judge, generation)
        number += 1


def _draw(size: int, seed: int, generation: int) -> Iterator[np.ndarray]:
    random = start_generator(seed, 0)
    while True:
        yield random.random((generation, size))


def _climb(
    mean: np.ndarray, step: float, random: np.random.Generator, judge: Judge, generation: int
) -> None:
    """Run CMA-ES once, until it has converged."""
    from cmaes import CMA

    optimizer = CMA(
        mean=mean,
        sigma=step,
        bounds=np.array([[0.0, 1.0]] * len(mean)),
        seed=int(random.integers(2**32)),
        population_size=generation,
    )
    worst, since = -np.inf, 0
    while since < PATIENCE:
        shares = np.array([optimizer.ask() for _ in range(generation)])
        severity = judge(shares)
        cost = np.where(np.isfinite(severity), -severity, _HARMLESS)
        optimizer.tell(list(zip(shares, cost.tolist(), strict=True)))
        if optimizer.should_stop() or np.ptp(shares, axis=0).max() < CONVERGED:
            return
        worst, since = max(worst, severity.max()), 0 if severity.max() > worst else since + 1
