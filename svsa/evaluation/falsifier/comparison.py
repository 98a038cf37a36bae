"""Comparison of CMA-ES with random samples: the run of the first fault, seed by seed."""

from collections.abc import Callable, Iterable
from math import inf
from typing import NamedTuple

from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.falsification import falsify


class SeedResult(NamedTuple):
    """The run of the first fault of one seed, None without one, and the largest severity."""

    seed: int
    cma_run: int | None
    cma_worst: float
    random_run: int | None
    random_worst: float


class MethodComparison(NamedTuple):
    """The results of all seeds, each of at most `runs` runs; `message` reports which method was
    first.
    """

    adversary: str
    law: str
    runs: int
    results: tuple[SeedResult, ...]
    message: str


def compare_methods(
    adversary: Adversary,
    runs: int,
    seeds: Iterable[int],
    progress: Callable[[int, float], None] = lambda done, worst: None,
) -> MethodComparison:
    """Search with every seed by both methods.

    Raises:
        FalsifierError: As `falsify`.
    """
    results, done = list[SeedResult](), 0
    for seed in seeds:
        faults: list[tuple[int | None, float]] = []
        for method in ("cma", "random"):

            def report(count: int, worst: float, before: int = done) -> None:
                progress(before + count, worst)

            options = {"seed": seed, "method": method, "is_shrunk": False}
            falsified = falsify(adversary, runs=runs, on_generation=report, **options)
            faults.append((falsified.run if falsified.is_fault else None, falsified.severity))
            done += runs
        results.append(SeedResult(seed, *faults[0], *faults[1]))
    return MethodComparison(
        adversary.title, adversary.law, runs, tuple(results), _summarize(results)
    )


def _summarize(results: list[SeedResult]) -> str:
    cma = sum(result.cma_run is not None for result in results)
    random = sum(result.random_run is not None for result in results)
    first = sum((result.cma_run or inf) < (result.random_run or inf) for result in results)
    return (
        f"Of {len(results)} seeds: CMA-ES found a fault with {cma}, random samples with {random};"
        f" CMA-ES alone or earlier with {first}."
    )
