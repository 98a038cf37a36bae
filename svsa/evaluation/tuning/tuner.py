"""Tuning by CMA-ES from the current parameters; the best candidates run on validation trials."""

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from svsa.control.installed import check_installed
from svsa.evaluation.campaign.journal import Journal
from svsa.evaluation.search import search
from svsa.evaluation.trials import build_set
from svsa.evaluation.tuning.judge import Judgment, TrialSet, judge
from svsa.evaluation.tuning.search_space import Space, build_space
from svsa.inputs.checked import check_number
from svsa.runs.definition.design import Design
from svsa.runs.definition.design_file import load_prototype

BUDGET, MAX_BUDGET = 128, 100_000
TRIALS, VALIDATION = 128, 512
GENERATION, STEP = 16, 0.2
FINALISTS = 10
WORKERS = 2

Stage = Literal["present", "search", "validation"]


class Candidate(NamedTuple):
    """Evaluated parameters, in the order of the space's axes, with results."""

    number: int
    stage: Stage
    values: tuple[float, ...]
    judgment: Judgment


def describe_candidate(candidate: Candidate) -> dict[str, Any]:
    """Convert a candidate to JSON; infinite values, as after a fault, are None."""
    judged = {
        name: None if value is not None and abs(value) == float("inf") else value
        for name, value in candidate.judgment._asdict().items()
    }
    values = list(candidate.values)
    return {"number": candidate.number, "stage": candidate.stage, "values": values} | judged


def read_candidate(written: dict[str, Any]) -> Candidate:
    """Read a candidate before validation in the JSON of `describe_candidate`."""
    judged = {name: written[name] for name in Judgment._fields}
    if judged["torque_variation_nm_per_s"] is None:
        judged["torque_variation_nm_per_s"] = float("inf")
    values = tuple(written["values"])
    return Candidate(written["number"], written["stage"], values, Judgment(**judged))


class Problem(NamedTuple):
    """What is tuned on what.

    Attributes:
        build: Builds trials from the name of their set, a seed and their number.
        judge: Evaluates a law with a design on such trials.
    """

    build: Callable[[str, int, int], Any]
    judge: Callable[[Any, str, Design], Judgment]


JOINT = Problem(
    lambda name, seed, count: TrialSet(build_set(name, seed, count)),
    lambda trials, law, design: judge(trials, law, design),
)
"""A single joint."""


@dataclass(frozen=True)
class Tuned:
    """The result of a search.

    Attributes:
        space: The search space.
        budget: Number of candidates after the current parameters.
        trials: Number of training trials of each candidate.
        validation: Number of validation trials of the finals.
        seed: Seed of search and trials.
        present: Initial design of the search.
        candidates: The current parameters, then the other candidates.
        finals: The current parameters and the best candidates on the validation trials.
        is_complete: Whether the budget was used up.
    """

    space: Space
    budget: int
    trials: int
    validation: int
    seed: int
    present: Design
    candidates: tuple[Candidate, ...]
    finals: tuple[Candidate, ...]
    is_complete: bool

    @property
    def start(self) -> Candidate:
        """Cost of the initial parameters."""
        return self.candidates[0]

    @property
    def best(self) -> Candidate:
        """Minimum cost on the validation trials, or on the training trials without those."""
        return min(self.finals or self.candidates, key=lambda candidate: candidate.judgment.cost)

    @property
    def design(self) -> Design:
        """The initial design with the best parameters of the law."""
        return self.space.set_design(self.present, self.best.values)


class _EndedError(Exception):
    """Signal of the end of a search."""


def tune(
    law: str,
    *,
    budget: int = BUDGET,
    trials: int = TRIALS,
    validation: int = VALIDATION,
    seed: int = 0,
    held: Mapping[str, Any] | None = None,
    present: Design | None = None,
    known: Iterable[Candidate] = (),
    on_candidate: Callable[[Candidate], None] = lambda _: None,
    is_cancelled: Callable[[], bool] = lambda: False,
    problem: Problem = JOINT,
    journal: Journal | None = None,
) -> Tuned:
    """Search a law's parameters for the minimum cost, see `svsa.evaluation.tuning.judge`.

    The method is the same for every law: CMA-ES from the current parameters, generations of 16,
    restarted at random parameters after convergence. Then the ten best candidates and the current
    parameters are evaluated on the validation trials. The same arguments give the same result.

    Args:
        law: Name of an installed law.
        budget: Number of candidates after the current parameters.
        trials: Number of training trials of each candidate, half of each family.
        validation: Number of validation trials.
        seed: Seed of search, training and validation trials.
        held: Parameters of the law by name that are not searched, such as {"estimate_share": 0.0}.
        present: Initial design; by default the prototype's.
        known: Candidates of the same interrupted search, which are not evaluated again.
        on_candidate: Called with each candidate, and with those on the validation trials.
        is_cancelled: Called before each candidate but the first; if it returns True, and at Ctrl-C,
            the best so far is returned.
        problem: Trials and cost; by default those of a single joint.
        journal: File of the same search: its candidates are known, and others are added to it.

    Returns:
        The candidates with their costs, and the design with the best parameters.

    Raises:
        ParameterError: If a law is not installed or has nothing to tune, or a number is out of
            range.
        KeyboardInterrupt: At Ctrl-C before the first candidate.
    """
    check_installed(law)
    check_number("budget", budget, "", 1, MAX_BUDGET)
    check_number("trials", trials, "", 1, MAX_BUDGET)
    check_number("validation", validation, "", 1, MAX_BUDGET)
    check_number("seed", seed, "", 0, 2**63 - 1)
    space, design = build_space(law, held), present or load_prototype()
    if held:
        design = space.set_design(design, space.read_values(design))
    journal = journal or Journal(None)
    journal.known = [line for line in journal.known if line["stage"] != "validation"]
    finished = [*known, *map(read_candidate, journal.known)]

    def note(candidate: Candidate) -> None:
        if candidate.stage == "validation" or candidate.number >= len(finished):
            journal.write(describe_candidate(candidate))
        on_candidate(candidate)

    state = _Search(space, design, budget, trials, finished, note, is_cancelled, problem)
    finals: list[Candidate] = []
    try:
        state.run(seed)
        finals = state.validate(seed, validation)
    except _EndedError:
        pass
    except KeyboardInterrupt:
        if not state.candidates:
            raise
    tried = tuple(state.candidates)
    return Tuned(
        space, budget, trials, validation, seed, design, tried, tuple(finals), bool(finals)
    )


class _Search:
    """The candidates of a search, counted against its budget."""

    def __init__(
        self,
        space: Space,
        design: Design,
        budget: int,
        trials: int,
        known: list[Candidate],
        on_candidate: Callable[[Candidate], None],
        is_cancelled: Callable[[], bool],
        problem: Problem,
    ) -> None:
        self.candidates: list[Candidate] = []
        self._space, self._design, self._budget, self._trials = space, design, budget, trials
        self._known, self._on_candidate = known, on_candidate
        self._is_cancelled, self._problem = is_cancelled, problem

    def run(self, seed: int) -> None:
        """Evaluate the current parameters, then search until the budget is used up."""
        training = self._problem.build("training", seed, self._trials)
        present = self._space.read_values(self._design)
        self._try(training, "present", [present])

        def judge_generation(shares: np.ndarray) -> np.ndarray:
            left = self._budget + 1 - len(self.candidates)
            values = [self._space.place(row) for row in shares[:left]]
            costs = self._try(training, "search", values)
            if len(self.candidates) > self._budget:
                raise _SpentError
            return -np.array(costs)

        start = self._space.compute_shares(present)
        with suppress(_SpentError):
            search("cma", len(start), seed, judge_generation, GENERATION, STEP, start)

    def validate(self, seed: int, count: int) -> list[Candidate]:
        """Evaluate the current parameters and the best candidates on the validation trials."""
        trials = self._problem.build("validation", seed, count)
        best = sorted(self.candidates[1:], key=lambda candidate: candidate.judgment.cost)
        chosen = list(
            {candidate.values: candidate for candidate in (self.candidates[0], *best)}.values()
        )
        finals = []
        for candidate in chosen[: FINALISTS + 1]:
            self._end_if_cancelled()
            finals.append(self._judge(trials, candidate.number, "validation", candidate.values))
            self._on_candidate(finals[-1])
        return finals

    def _try(self, trials: Any, stage: Stage, values: list[tuple[float, ...]]) -> list[float]:
        """Evaluate candidates in order.

        Raises:
            _EndedError: At the end of the search.
        """
        costs = []
        with ThreadPoolExecutor(WORKERS) as pool:
            first = len(self.candidates)
            jobs = [
                pool.submit(self._judge, trials, first + n, stage, values_tried)
                for n, values_tried in enumerate(values)
            ]
            try:
                for job in jobs:
                    if self.candidates:
                        self._end_if_cancelled()
                    candidate = job.result()
                    self.candidates.append(candidate)
                    costs.append(candidate.judgment.cost)
                    self._on_candidate(candidate)
            finally:
                pool.shutdown(cancel_futures=True)
        return costs

    def _judge(
        self, trials: Any, number: int, stage: Stage, values: tuple[float, ...]
    ) -> Candidate:
        if stage != "validation" and number < len(self._known):
            return self._known[number]
        design = self._space.set_design(self._design, values)
        judgment = self._problem.judge(trials, self._space.law, design)
        return Candidate(number, stage, values, judgment)

    def _end_if_cancelled(self) -> None:
        if self._is_cancelled():
            raise _EndedError


class _SpentError(Exception):
    """The budget is used up."""
