"""The paper's bench figures under any law on the emulator, as a file and next to a comparison.

The runs use CAN in lockstep: twelve reproducible numbers per law.
"""

from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any, Self

from svsa.errors import ParameterError, Violation
from svsa.evaluation.campaign.results_file import read_results_file
from svsa.evaluation.ranking.row import RecoveryErrors
from svsa.inputs.checked import Checked, quantity
from svsa.runs.definition.paper import BENCH_FIGURES

PUBLISHED = Path(__file__).parent / "bench_results.json"
NUMBERS = tuple(RecoveryErrors.model_fields)
"""For each figure: error before, peak, steady-state error, and recovery time."""


class BenchRun(Checked):
    """The result of a law in one figure; a number is missing if the bench stopped with a fault."""

    law: str = quantity("", "Name of the law")
    figure: str = quantity("", "Key of the figure: 6a, 6b or 7")
    version: str = quantity("", "Version of the lab that measured it")
    fault: str | None = quantity("", "Code of the fault that ended the run")
    errors: RecoveryErrors = quantity("", "Position errors")

    def is_no_worse(self, comparison: "BenchRun", number: str) -> bool:
        """Return whether a number is not greater than the baseline's.

        Args:
            comparison: The run of the baseline in the same figure.
            number: A field of `RecoveryErrors`.

        Returns:
            False if this run has no such number, True if only the baseline has none.
        """
        mine, theirs = (getattr(run.errors, number) for run in (self, comparison))
        return mine is not None and (theirs is None or mine <= theirs)


class BenchRuns(Checked):
    """Runs of laws in the paper's bench figures on the emulator."""

    runs: tuple[BenchRun, ...] = quantity("", "One run per law and figure")

    @property
    def laws(self) -> tuple[str, ...]:
        """Names of the laws, in the order of their runs."""
        return tuple(dict.fromkeys(run.law for run in self.runs))

    def list_runs(self, law: str) -> tuple[BenchRun, ...]:
        """Return the runs of a law in the order of the figures.

        Raises:
            ParameterError: If the law has none.
        """
        runs = {run.figure: run for run in self.runs if run.law == law}
        if not runs:
            raise ParameterError(Violation("law", law, "", "one of " + ", ".join(self.laws)))
        return tuple(runs[key] for key in BENCH_FIGURES if key in runs)

    def choose(self, laws: Sequence[str]) -> Self:
        """Return the runs of these laws, in this order."""
        return self.changed(runs=tuple(run for law in laws for run in self.list_runs(law)))

    def renew(self, newer: Self) -> Self:
        """Return the runs with those of `newer` replacing the same law and figure."""
        runs = {(run.law, run.figure): run for run in (*self.runs, *newer.runs)}
        return self.changed(runs=tuple(runs.values()))

    def to_json(self, comparison: str) -> dict[str, Any]:
        """Convert to the JSON of `svsa ranking bench --json`."""
        return {
            "comparison": comparison,
            "laws": [self._describe_law(law, comparison) for law in self.laws],
        }

    def _describe_law(self, law: str, comparison: str) -> dict[str, Any]:
        no_worse, count = self.count_no_worse(law, comparison)
        figures = {
            run.figure: {**run.errors.model_dump(), "fault": run.fault}
            for run in self.list_runs(law)
        }
        return {"law": law, "figures": figures, "no_worse": no_worse, "numbers": count}

    def count_no_worse(self, law: str, comparison: str) -> tuple[int, int]:
        """Count in how many numbers a law is not worse than its baseline, and of how many."""
        pairs = self.pair(law, comparison)
        verdicts = [run.is_no_worse(baseline, n) for run, baseline in pairs for n in NUMBERS]
        return sum(verdicts), len(verdicts)

    def pair(self, law: str, comparison: str) -> tuple[tuple[BenchRun, BenchRun], ...]:
        """Pair the runs of a law with its baseline's, in the figures that both have."""
        theirs = {run.figure: run for run in self.list_runs(comparison)}
        mine = self.list_runs(law)
        return tuple((run, theirs[run.figure]) for run in mine if run.figure in theirs)


def read_bench_runs(path: Path) -> BenchRuns:
    """Read the runs of `svsa ranking bench`; raises as `read_results_file`."""
    return read_results_file(BenchRuns, path, "svsa ranking bench --save")


@cache
def load_published_bench_runs() -> BenchRuns:
    """Load the runs that this version was published with: `bench_results.json`."""
    return read_bench_runs(PUBLISHED)
