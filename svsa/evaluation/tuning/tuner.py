"""Tuning a law: Sobol points all over its space, then Nelder–Mead from the best of them."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from svsa.control.installed import check_installed
from svsa.errors import ParameterError, Violation
from svsa.evaluation.ranking.cost import RunCost, measure_cost
from svsa.evaluation.tuning.search_space import Space, build_space
from svsa.evaluation.tuning.training import DURATION_S, TRAINING, TrainingRun
from svsa.inputs.checked import check_number
from svsa.runs.configuration import Configuration, Design, load_prototype

BUDGET, MAX_BUDGET = 124, 100_000
SIMPLEX_STEP = 0.12
WORKERS = 2

Stage = Literal["present", "sobol", "local"]


class Trial(NamedTuple):
    """One candidate. values: in the order of the axes. runs: what each cost. cost: their mean."""

    number: int
    stage: Stage
    values: tuple[float, ...]
    runs: tuple[RunCost, ...]
    cost: float


@dataclass(frozen=True)
class Tuned:
    """What a search found. trials: all that was tried, the design as it was first.

    is_complete: whether the budget was used up, and not broken off.
    """

    space: Space
    runs: tuple[TrainingRun, ...]
    duration_s: float
    budget: int
    seed: int
    present: Design
    trials: tuple[Trial, ...]
    is_complete: bool

    @property
    def start(self) -> Trial:
        """The design as it was."""
        return self.trials[0]

    @property
    def best(self) -> Trial:
        """The trial of the least cost; the first of these."""
        return min(self.trials, key=lambda trial: trial.cost)

    @property
    def design(self) -> Design:
        """The present design with the best values for the law."""
        return self.space.set_design(self.present, self.best.values)


class _BrokenOffError(Exception):
    """The search is not to go on."""


class _Search:
    """The trials of a search, counted against its budget."""

    def __init__(
        self,
        evaluate: Callable[[Sequence[tuple[float, ...]]], Iterator[tuple[RunCost, ...]]],
        budget: int,
        on_trial: Callable[[Trial], None],
        is_cancelled: Callable[[], bool],
    ) -> None:
        self.trials: list[Trial] = []
        self._evaluate, self._budget = evaluate, budget
        self._on_trial, self._is_cancelled = on_trial, is_cancelled

    @property
    def is_done(self) -> bool:
        """Whether the budget is used up; the present design does not count."""
        return len(self.trials) > self._budget

    def try_all(self, stage: Stage, candidates: Sequence[tuple[float, ...]]) -> list[float]:
        """The costs of candidates, one after another; raises `_BrokenOffError`."""
        self._check()
        found = []
        for values, runs in zip(candidates, self._evaluate(candidates), strict=True):
            cost = sum(run.cost for run in runs) / len(runs)
            trial = Trial(len(self.trials), stage, values, runs, cost)
            self.trials.append(trial)
            found.append(cost)
            self._on_trial(trial)
            if values is not candidates[-1]:
                self._check()
        return found

    def _check(self) -> None:
        if self.is_done or (self.trials and self._is_cancelled()):
            raise _BrokenOffError


def tune(
    law: str,
    *,
    budget: int = BUDGET,
    seed: int = 0,
    held: Mapping[str, Any] | None = None,
    present: Design | None = None,
    runs: Sequence[TrainingRun] = TRAINING,
    duration_s: float = DURATION_S,
    on_trial: Callable[[Trial], None] = lambda _: None,
    is_cancelled: Callable[[], bool] = lambda: False,
) -> Tuned:
    """Search a law's parameters for the least mean cost of the training runs.

    The same for every law: the present design first, then scrambled Sobol points all over the
    space, the power of two nearest to half of the budget, then Nelder–Mead from the best of all.
    The same arguments give the same result. budget: candidates besides the present design. held:
    parameters of the law by name that are not searched, as {"estimate_share": 0.0}. present: the
    design that the law is in, the prototype's if left out. duration_s: of each run. on_trial: told
    every trial. is_cancelled: asked before each but the present design, which is always tried;
    where it says so, and at Ctrl-C, the best so far is returned.

    Raises `ParameterError` for a law that is not installed or has nothing to tune, and for numbers
    out of range; `KeyboardInterrupt` before the first trial.
    """
    check_installed(law)
    check_number("budget", budget, "", 1, MAX_BUDGET)
    check_number("seed", seed, "", 0, 2**63 - 1)
    if not runs:
        raise ParameterError(Violation("runs", 0, "", "at least one training run"))
    space, design = build_space(law, held), present or load_prototype()
    if held:
        design = _hold(space, design)
    with ThreadPoolExecutor(WORKERS) as pool:

        def evaluate(candidates: Sequence[tuple[float, ...]]) -> Iterator[tuple[RunCost, ...]]:
            jobs = [
                pool.submit(measure_cost, configuration, duration_s)
                for values in candidates
                for configuration in build_runs(space.set_design(design, values), law, runs)
            ]
            for first in range(0, len(jobs), len(runs)):
                yield tuple(job.result() for job in jobs[first : first + len(runs)])

        search = _Search(evaluate, budget, on_trial, is_cancelled)
        try:
            _run(search, space, design, budget, seed)
        except _BrokenOffError:
            pass
        except KeyboardInterrupt:
            if not search.trials:
                raise
        finally:
            pool.shutdown(cancel_futures=True)
    trials = tuple(search.trials)
    return Tuned(space, tuple(runs), duration_s, budget, seed, design, trials, len(trials) > budget)


def build_runs(design: Design, law: str, runs: Sequence[TrainingRun]) -> list[Configuration]:
    """The training runs of a law with the gains, observer and parameters of a design."""
    own = {name: getattr(design, name) for name in ("gains", "observer", "parameters")}
    return [run.build_configuration(law).changed(**own) for run in runs]


def count_sobol(budget: int) -> int:
    """How many Sobol points: the power of two nearest to half of the budget, at most all of it."""
    return min(1 << max(0, round(math.log2(max(budget, 2) / 2.0))), budget)


def _hold(space: Space, design: Design) -> Design:
    return space.set_design(design, space.read_values(design))


def _run(search: _Search, space: Space, design: Design, budget: int, seed: int) -> None:
    from scipy.optimize import minimize
    from scipy.stats import qmc

    search.try_all("present", [space.read_values(design)])
    shares = qmc.Sobol(len(space.axes), rng=seed).random(count_sobol(budget))
    search.try_all("sobol", [_place(space, row) for row in shares])
    while not search.is_done:
        best = min(search.trials, key=lambda trial: trial.cost)
        start = np.array(
            [axis.compute_share(v) for axis, v in zip(space.axes, best.values, strict=True)]
        )
        minimize(
            lambda row: search.try_all("local", [_place(space, row)])[0],
            start,
            method="Nelder-Mead",
            bounds=[(0.0, 1.0)] * len(start),
            options={"initial_simplex": _build_simplex(start), "maxfev": budget},
        )


def _place(space: Space, shares: np.ndarray) -> tuple[float, ...]:
    return tuple(
        axis.compute_value(float(share)) for axis, share in zip(space.axes, shares, strict=True)
    )


def _build_simplex(start: np.ndarray) -> np.ndarray:
    """`start`, and from it a step into the space along every axis."""
    steps = np.where(start > 0.5, -SIMPLEX_STEP, SIMPLEX_STEP)
    return np.vstack([start, start + np.diag(steps)])
