"""Results of the ranking as a file: what the page, the README and the laws' pages show."""

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import as_completed
from functools import cache
from pathlib import Path
from typing import Self

from pydantic import ValidationError

from svsa.errors import ParameterError, Violation
from svsa.evaluation.ranking.measure import Entry, measure_law
from svsa.evaluation.ranking.row import Row
from svsa.evaluation.ranking.trials import PUBLIC_SEED, SUITE_VERSION
from svsa.evaluation.workers import start_workers
from svsa.inputs.checked import Checked, quantity

PUBLISHED = Path(__file__).parent / "results.json"


class Results(Checked):
    """Rows, and the suite and the trials that they were measured on."""

    suite: str = quantity("", "Version of the suite")
    is_public: bool = quantity("", "Whether the trials are those of the public seed")
    seed: str = quantity("", "Seed of the trials, in hexadecimal")
    rows: tuple[Row, ...] = quantity("", "A row a law")

    @classmethod
    def build(cls, rows: Sequence[Row], seed: int) -> Self:
        """Of rows that were measured with this suite and trials of this seed."""
        return cls(
            suite=SUITE_VERSION,
            is_public=seed == PUBLIC_SEED,
            seed=f"{seed:016x}",
            rows=tuple(rows),
        )

    def get_row(self, law: str) -> Row:
        """The row of a law; raises `ParameterError` where it has none."""
        for row in self.rows:
            if row.law == law:
                return row
        bound = "one of " + ", ".join(row.law for row in self.rows)
        raise ParameterError(Violation("law", law, "", bound))

    def renew(self, newer: Self) -> Self:
        """With the rows of `newer` in place of those of the same laws, others behind them.

        Raises `ParameterError` where one of them has another suite or other trials: numbers of
        different runs do not stand in one table.
        """
        for name in ("suite", "seed"):
            kept, found = getattr(self, name), getattr(newer, name)
            if kept != found:
                bound = f"{kept}, as the rows that stay were measured with"
                raise ParameterError(Violation(name, found, "", bound))
        rows = {row.law: row for row in (*self.rows, *newer.rows)}
        return self.changed(rows=tuple(rows.values()))


def write_results(path: Path, results: Results) -> None:
    """Write results as JSON."""
    path.write_text(results.model_dump_json(indent=1) + "\n", encoding="utf-8")


def read_results(path: Path) -> Results:
    """Read what `write_results` wrote; raises `ParameterError` for anything else."""
    try:
        return Results.model_validate_json(path.read_bytes())
    except (OSError, ValidationError) as error:
        bound = f"a file that svsa ranking run --save writes ({error})"
        raise ParameterError(Violation("results", path, "", bound)) from None


@cache
def load_published() -> Results:
    """The results that this version was published with: `svsa/evaluation/ranking/results.json`."""
    return read_results(PUBLISHED)


def measure_laws(
    laws: Sequence[str],
    seed: int = PUBLIC_SEED,
    report: Callable[[float], None] = lambda done: None,
) -> Results:
    """The rows of laws in the order given, by as many processes as there are processors.

    report: is given the share that is done.
    """
    rows: dict[str, Row] = {}
    if len(laws) == 1:
        rows[laws[0]] = measure_law(Entry(laws[0]), report, seed)
    else:
        for row in _measure_side_by_side(laws, seed):
            rows[row.law] = row
            report(len(rows) / len(laws))
    return Results.build([rows[law] for law in laws], seed)


def _measure_side_by_side(laws: Sequence[str], seed: int) -> Iterator[Row]:
    workers = min(len(laws), os.cpu_count() or 1)
    with start_workers(workers) as pool:
        asked = [pool.submit(_measure, law, seed) for law in laws]
        try:
            for answer in as_completed(asked):
                yield answer.result()
        finally:
            pool.shutdown(cancel_futures=True)


def _measure(law: str, seed: int) -> Row:
    return measure_law(Entry(law), seed=seed)
