"""The falsifier: search an adversary's ranges for the largest cost, then simplify the result."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from svsa.errors import SvsaError
from svsa.evaluation.campaign.journal import Journal
from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.description import describe_outcome, describe_worst
from svsa.evaluation.falsifier.measure import Measured, measure_attacks
from svsa.evaluation.falsifier.neighborhood import Neighborhood, measure_neighborhood
from svsa.evaluation.falsifier.scenario import Attack, Finding, LoadScenario
from svsa.evaluation.falsifier.shrink import Shrunk, shrink
from svsa.evaluation.search import Method, search
from svsa.inputs.checked import check_number
from svsa.inputs.extras import __version__

RUNS, MAX_RUNS = 20_000, 1_000_000


class FalsifierError(SvsaError):
    """A search that cannot start."""


@dataclass(frozen=True)
class Falsified:
    """The result of a search.

    Attributes:
        adversary: The adversary.
        method: Search method.
        seed: Seed of the search.
        runs: Maximum number of runs.
        severities: Severity of each run, infinite for a fault, see `measure.judge`; with them an
            interrupted search continues.
        nothing: Severity without any load of the adversary.
        run: Number of the worst run, from 1; the first fault.
        attack: The worst attack as found.
        outcome: Its outcome.
        shrunk: The simplified attack; None if the search was interrupted or not to be simplified.
        neighborhood: Neighborhood of the simplified attack, or None.
        is_complete: Whether the search was completed.
    """

    adversary: Adversary
    method: Method
    seed: int
    runs: int
    severities: np.ndarray
    nothing: float
    run: int
    attack: Attack
    outcome: str
    shrunk: Shrunk | None
    neighborhood: Neighborhood | None
    is_complete: bool

    @property
    def severity(self) -> float:
        """Severity of the worst run."""
        return float(self.severities[self.run - 1])

    @property
    def is_fault(self) -> bool:
        """Whether the worst run ended in a fault."""
        return math.isinf(self.severity)

    @property
    def scenario(self) -> LoadScenario:
        """The simplified attack as a scenario."""
        simple = self.shrunk
        return _describe(
            self.adversary,
            simple.attack if simple else self.attack,
            simple.duration_s if simple else self.adversary.duration_s,
            (self.outcome, simple.outcome if simple else self.outcome),
            (self.method, self.seed, self.run, len(self.severities)),
            self.neighborhood,
        )

    @property
    def as_found(self) -> LoadScenario:
        """The worst attack before simplification."""
        return replace(self, shrunk=None, neighborhood=None).scenario


def _describe(
    adversary: Adversary,
    attack: Attack,
    duration_s: float,
    outcomes: tuple[str, str],
    search: tuple[Method, int, int, int],
    neighborhood: Neighborhood | None = None,
) -> LoadScenario:
    """Describe the result of a search.

    `outcomes` are those of the attack as found and as simplified; `search` contains method, seed,
    number of the run that found it, and runs.
    """
    method, seed, run, runs = search
    return LoadScenario(
        title=f"{adversary.title}: {outcomes[0]}"[:200],
        base=adversary.base,
        duration_s=duration_s,
        measure_from_s=adversary.measure_from_s,
        settings=dict(attack.settings),
        loads=attack.loads,
        found=Finding(
            law=adversary.law,
            cost=adversary.cost,
            outcome=outcomes[1],
            adversary=adversary.title,
            method=method,
            seed=seed,
            at_run=run,
            runs=runs,
            version=__version__,
            neighbors=neighborhood and neighborhood.runs,
            neighbors_failed=neighborhood and neighborhood.failed,
        ),
    )


class _EndedError(Exception):
    """Signal of the end of a search."""


class _Search:
    """The runs of a search, counted up to its limit; known ones are not repeated.

    `on_worse` is called with number and attack of each run that is worse than all previous ones.
    """

    def __init__(
        self,
        adversary: Adversary,
        runs: int,
        known: Sequence[float],
        on_worse: Callable[[int, Attack, float], None],
        journal: Journal,
    ) -> None:
        self.adversary, self.base = adversary, adversary.build_base()
        self.severities: list[float] = []
        self.worst: tuple[int, Attack] | None = None
        self._runs, self._known = runs, np.asarray(known, dtype=float)
        self._on_worse, self._journal = on_worse, journal

    def judge(self, shares: np.ndarray) -> np.ndarray:
        """Compute the severity of each attack of a generation.

        Raises:
            _EndedError: At the end of the search.
        """
        done = len(self.severities)
        if done >= self._runs:
            raise _EndedError
        shares = shares[: self._runs - done]
        attacks = [self.adversary.build_attack(self.base, row.tolist()) for row in shares]
        severity = self._known[done : done + len(attacks)]
        if len(severity) < len(attacks):
            severity = self.measure(attacks).severity
        worst = int(np.argmax(severity))
        if self.worst is None or severity[worst] > self.severities[self.worst[0]]:
            self.worst = done + worst, attacks[worst]
            self._on_worse(done + worst + 1, attacks[worst], float(severity[worst]))
        is_fault = bool(np.isposinf(severity[worst]))
        self.severities += severity.tolist()[: worst + 1 if is_fault else None]
        if len(self.severities) > len(self._known):
            self._journal.write([*map(repr, self.severities[max(done, len(self._known)) :])])
        if is_fault or len(self.severities) >= self._runs:
            raise _EndedError
        return severity

    def measure(self, attacks: Sequence[Attack]) -> Measured:
        return measure_attacks(self.adversary, self.base, attacks, self.adversary.duration_s)


def falsify(
    adversary: Adversary,
    *,
    runs: int = RUNS,
    seed: int = 0,
    method: Method = "cma",
    known: Sequence[float] | np.ndarray = (),
    on_generation: Callable[[int, float], None] = lambda done, worst: None,
    on_worse: Callable[[LoadScenario], None] = lambda scenario: None,
    is_cancelled: Callable[[], bool] = lambda: False,
    is_shrunk: bool = True,
    journal: Journal | None = None,
) -> Falsified:
    """Search for the attack with the largest cost, and simplify it with the same effect.

    The search ends at the first fault, which is the worst result. The same arguments give the same
    result. At Ctrl-C the worst attack so far is returned without simplification.

    Args:
        adversary: Law, cost and ranges.
        runs: Maximum number of runs of the search, without those of simplification and
            neighborhood.
        seed: Seed of the search.
        method: "cma", or "random" for a comparison.
        known: `Falsified.severities` of the same search, if it was interrupted.
        on_generation: Called after each generation with the number of runs and the largest
            severity.
        on_worse: Called with each attack that is worse than all previous ones, as a scenario.
        is_cancelled: Called before each generation; True ends the search as Ctrl-C does.
        is_shrunk: Whether the attack is simplified and its neighborhood is run.
        journal: File of the same search: its runs are known, and others are added to it.

    Returns:
        The worst attack of the search.

    Raises:
        ParameterError: If a number is out of range.
        FalsifierError: If the law ends in a fault without a load of the adversary.
        KeyboardInterrupt: At Ctrl-C before the first generation.
    """
    check_number("runs", runs, "", 1, MAX_RUNS)
    check_number("seed", seed, "", 0, 2**63 - 1)

    def report_worse(number: int, attack: Attack, severity: float) -> None:
        text = describe_worst(adversary.cost, severity)
        search = method, seed, number, number
        on_worse(_describe(adversary, attack, adversary.duration_s, (text, text), search))

    journal = journal or Journal(None)
    finished = [*known, *(float(text) for generation in journal.known for text in generation)]
    state = _Search(adversary, runs, finished, report_worse, journal)
    nothing = state.measure([Attack((), {})])
    if not np.isfinite(nothing.severity[0]):
        text = describe_outcome(nothing, 0, adversary.cost)
        raise FalsifierError(f"{adversary.law} needs no adversary: without any load, {text}.")
    is_complete = False

    def judge(shares: np.ndarray) -> np.ndarray:
        if state.worst is not None:
            on_generation(len(state.severities), state.severities[state.worst[0]])
            if is_cancelled():
                raise KeyboardInterrupt
        return state.judge(shares)

    try:
        search(method, adversary.size, seed, judge)
    except _EndedError:
        is_complete = True
    except KeyboardInterrupt:
        if state.worst is None:
            raise
    assert state.worst is not None  # noqa: S101  a generation was judged
    number, attack = state.worst
    measured = state.measure([attack])
    simple = neighborhood = None
    if is_complete and is_shrunk:
        simple = shrink(adversary, state.base, attack, measured)
        neighborhood = measure_neighborhood(adversary, state.base, simple.attack, measured, seed)
    return Falsified(
        adversary=adversary,
        method=method,
        seed=seed,
        runs=runs,
        severities=np.array(state.severities),
        nothing=float(nothing.severity[0]),
        run=number + 1,
        attack=attack,
        outcome=describe_outcome(measured, 0, adversary.cost),
        shrunk=simple,
        neighborhood=neighborhood,
        is_complete=is_complete,
    )
