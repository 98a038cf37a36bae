"""The search against random draws of the same number, seed by seed."""

from collections.abc import Callable, Iterable
from math import inf
from typing import NamedTuple

from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.find import falsify


class Lap(NamedTuple):
    """Of a seed the run of the first fault, None without one, and the greatest severity else."""

    seed: int
    cma_run: int | None
    cma_worst: float
    random_run: int | None
    random_worst: float


class Race(NamedTuple):
    """All laps, of so many runs at most. message: who was first how often."""

    adversary: str
    law: str
    runs: int
    laps: tuple[Lap, ...]
    message: str


def race(
    adversary: Adversary,
    runs: int,
    seeds: Iterable[int],
    progress: Callable[[int, float], None] = lambda done, worst: None,
) -> Race:
    """Search with every seed by both ways; a law that needs no adversary raises."""
    laps, done = list[Lap](), 0
    for seed in seeds:
        found: list[tuple[int | None, float]] = []
        for method in ("cma", "random"):
            begun = done

            def report(count: int, worst: float, begun: int = begun) -> None:
                progress(begun + count, worst)

            one = falsify(
                adversary,
                runs=runs,
                seed=seed,
                method=method,
                on_generation=report,
                is_shrunk=False,
            )
            found.append((one.run if one.is_fault else None, one.severity))
            done += runs
        laps.append(Lap(seed, *found[0], *found[1]))
    return Race(adversary.title, adversary.law, runs, tuple(laps), _tell(laps))


def _tell(laps: list[Lap]) -> str:
    cma = sum(lap.cma_run is not None for lap in laps)
    random = sum(lap.random_run is not None for lap in laps)
    first = sum((lap.cma_run or inf) < (lap.random_run or inf) for lap in laps)
    return (
        f"Of {len(laps)} seeds: CMA-ES found a fault with {cma}, random draws with {random};"
        f" CMA-ES alone or earlier with {first}."
    )
