"""Results of the ranking as a file: protocol, rows, ranks; the source of page and documents."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Self

import numpy as np

from svsa.actuators.parameters import SVSA
from svsa.control.installed import PAPERS_LAW
from svsa.errors import ParameterError, Violation
from svsa.evaluation.campaign.results_file import read_results_file
from svsa.evaluation.metrics import HELD
from svsa.evaluation.ranking.entry import build_entry
from svsa.evaluation.ranking.measure import TrialSet, measure_entry
from svsa.evaluation.ranking.row import Row
from svsa.evaluation.statistics import compute_mcnemar_p, correct_holm
from svsa.evaluation.trials import DURATION_S, FAMILIES, PROTOCOL
from svsa.inputs.checked import Checked, Number, Whole, quantity

PUBLISHED = Path(__file__).parent / "results.json"
SIGNIFICANT = 0.05


class Rank(Checked):
    """The rank of a row, and its comparison with the tuned NDOBC."""

    key: str = quantity("", "Name of the row")
    rank: Whole = quantity(
        "", "Rank from 1; rows without a significant difference have the same rank", ge=1
    )
    only_this: Whole = quantity("", "Trials in which only this row succeeded", ge=0)
    only_ndobc: Whole = quantity("", "Trials in which only the tuned NDOBC succeeded", ge=0)
    p_value: Number | None = quantity(
        "1", "McNemar's exact test against the tuned NDOBC, corrected by Holm", ge=0, le=1
    )


class Results(Checked):
    """Rows, and the protocol that they were measured with."""

    protocol: str = quantity("", "Version of the protocol")
    actuator: str = quantity(
        "", "Name of the actuator; trials of another than the SVSA are scaled to it", default=SVSA
    )
    criterion: str = quantity("", "Success criterion of a trial")
    seed: Whole = quantity("", "Seed of the test set", ge=0)
    trials: Whole = quantity("", "Trials of each family", ge=1)
    duration_s: Number = quantity("s", "Length of a trial")
    rows: tuple[Row, ...] = quantity("", "Rows in the order of their success rates")
    ranks: tuple[Rank, ...] = quantity("", "The rank of each row")

    @classmethod
    def build(cls, rows: Sequence[Row], seed: int, trials: int, actuator: str = SVSA) -> Self:
        """Build the results of rows that were measured on the same test set.

        Args:
            rows: The rows, in any order.
            seed: Seed of the test set.
            trials: Number of trials of each family.
            actuator: Name of the actuator that the trials were scaled to.

        Returns:
            The rows in the order of their success rates, with their ranks.
        """
        ordered = sorted(rows, key=lambda row: (-_read_held(row).mean(), row.key))
        return cls(
            protocol=PROTOCOL,
            actuator=actuator,
            criterion=HELD,
            seed=seed,
            trials=trials,
            duration_s=DURATION_S,
            rows=tuple(ordered),
            ranks=compute_ranks(ordered),
        )

    def get_row(self, key: str) -> Row:
        """Return the row of this key.

        Raises:
            ParameterError: If there is none.
        """
        for row in self.rows:
            if row.key == key:
                return row
        bound = "one of " + ", ".join(row.key for row in self.rows)
        raise ParameterError(Violation("row", key, "", bound))

    def get_rank(self, key: str) -> Rank:
        """Return the rank of the row of this key."""
        return next(rank for rank in self.ranks if rank.key == key)


def compute_ranks(rows: Sequence[Row]) -> tuple[Rank, ...]:
    """Compute the ranks of rows in the order of their success rates over both families."""
    held = {row.key: _read_held(row) for row in rows}
    ranks, p_values = rank_held(held)
    return tuple(
        Rank(
            key=row.key,
            rank=ranks[row.key],
            only_this=_count_only(held[row.key], held.get(PAPERS_LAW)),
            only_ndobc=_count_only(held.get(PAPERS_LAW), held[row.key]),
            p_value=p_values.get(row.key),
        )
        for row in rows
    )


def rank_held(held: Mapping[str, np.ndarray]) -> tuple[dict[str, int], dict[str, float]]:
    """Compute ranks, and p-values against NDOBC, of rows in the order of their success rates.

    The first row without a rank, and all later ones that do not differ significantly from it, share
    the next rank: McNemar's exact test on the same trials, at 5 % with Holm's correction over the
    rows compared.

    Args:
        held: Success of each trial, (trials,), by the key of the row.

    Returns:
        Ranks by key, from 1; p-values by key, empty without a row of NDOBC.
    """
    ranks: dict[str, int] = {}
    left = list(held)
    while left:
        first, *others = left
        values = correct_holm([_compute_p(held[first], held[key]) for key in others])
        shared = [key for key, p in zip(others, values, strict=True) if not p < SIGNIFICANT]
        rank = len(ranks) + 1
        ranks |= dict.fromkeys((first, *shared), rank)
        left = [key for key in others if key not in shared]
    compared = [key for key in held if key != PAPERS_LAW] if PAPERS_LAW in held else []
    values = correct_holm([_compute_p(held[key], held[PAPERS_LAW]) for key in compared])
    return ranks, dict(zip(compared, values, strict=True))


def _read_held(row: Row) -> np.ndarray:
    """Read the success of each trial, (trials,), family after family."""
    held = []
    for family in FAMILIES:
        outcome = row.families[family]
        packed = np.frombuffer(bytes.fromhex(outcome.held_bits), np.uint8)
        held.append(np.unpackbits(packed)[: outcome.trials])
    return np.concatenate(held).astype(bool)


def _count_only(held: np.ndarray | None, other: np.ndarray | None) -> int:
    """Count the trials, (trials,), in which only the first of two rows succeeded."""
    return 0 if held is None or other is None else int(np.sum(held & ~other))


def _compute_p(held: np.ndarray, other: np.ndarray) -> float:
    return compute_mcnemar_p(_count_only(held, other), _count_only(other, held))


def measure_entries(
    keys: Sequence[str],
    seed: int,
    trials: int,
    known: Sequence[Row] = (),
    report: Callable[[str, float], None] = lambda key, done: None,
    actuator: str = SVSA,
) -> Iterator[Results]:
    """Yield results after each entry, including `known` rows with the same parameters.

    `report` receives the key of an entry and its finished share; `actuator` is the name of the
    actuator that trials and scenarios are scaled to.
    """
    rows = {row.key: row for row in known}
    test_set = TrialSet(seed, trials, actuator)
    for key in keys:
        rows[key] = measure_entry(
            build_entry(key, actuator), test_set, lambda done, key=key: report(key, done)
        )
        yield Results.build(list(rows.values()), seed, trials, actuator)


def read_results(path: Path) -> Results:
    """Read the results of `svsa ranking run`; raises as `read_results_file`."""
    return read_results_file(Results, path, "svsa ranking run --save")


@cache
def load_published() -> Results:
    """Load the results that this version was published with: `results.json` in this folder."""
    return read_results(PUBLISHED)
