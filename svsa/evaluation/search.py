"""Search of the unit cube: CMA-ES with restarts after convergence, or random points.

N. Hansen, "The CMA Evolution Strategy: A Tutorial" (2016), by the package `cmaes`. A generation is
evaluated as one batch. The random numbers are Philox, keyed by the seed and the number of the
start.
"""

from collections.abc import Callable, Iterator
from typing import Literal

import numpy as np

from svsa.evaluation.trials import start_generator

Method = Literal["cma", "random"]
GENERATION = 32
STEP = 0.3
CONVERGED = 0.01
"""Width of a generation, as a share of the ranges, below which a start has converged."""
PATIENCE = 15
"""Number of generations without a worse run after which a start ends."""
_HARMLESS = 1e30
"""Cost for the optimizer of the best possible run of the law."""

Judge = Callable[[np.ndarray], np.ndarray]
"""Maps shares (n, size) from 0 to 1 to the maximized values (n,), infinite to end the search."""


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
        size: Dimension of the cube.
        seed: Seed of all random numbers.
        judge: Function to maximize.
        generation: Number of points in a generation.
        step: Initial standard deviation of CMA-ES.
        start: Initial mean of the first start of CMA-ES, shape (size,); by default a random point.
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
