"""Replay of a study's row: every sample of its run, with the same metrics to the bit."""

import struct
from typing import Any, NamedTuple

import numpy as np

from svsa.evaluation.metrics import METRICS, summarize_result
from svsa.evaluation.studies.outcome import Success, build_outcome
from svsa.evaluation.studies.rows import read_rows, select_rows
from svsa.evaluation.studies.samples import build_configurations, draw
from svsa.evaluation.studies.stored import StoredStudy, StudyError
from svsa.evaluation.studies.work import ROW
from svsa.inputs.checked import check_number
from svsa.runs.definition.configuration import Configuration
from svsa.runs.records.catalogue.entry import RunEntry
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.result.result import Result
from svsa.runs.result.saved import record_result
from svsa.runs.result.simulate import simulate


class Replay(NamedTuple):
    """A row and its run.

    Attributes:
        row: Number of the row.
        kept: Row of the table.
        configuration: Configuration of the run.
        result: The run.
        metrics: Metrics of the replayed samples.
    """

    row: int
    kept: dict[str, Any]
    configuration: Configuration
    result: Result
    metrics: dict[str, float]

    @property
    def differing(self) -> list[str]:
        """The metrics, and the fault, that differ from the table in any bit."""
        kept = [name for name in METRICS if name in self.kept]
        names = [name for name in kept if not _is_same(self.kept[name], self.metrics[name])]
        fault = self.result.fault
        ended = (fault.code, fault.tick) if fault else (None, None)
        if ended != (self.kept["fault"], self.kept["fault_tick"]):
            names.append("fault")
        return names


def replay_row(stored: StoredStudy, row: int) -> Replay:
    """Run a row again, alone and with all its samples.

    Raises:
        ParameterError: If the study has no such row.
        StudyError: If the row is not finished, or its settings were rejected.
    """
    study = stored.study
    check_number("row", row, "", 0, study.row_count - 1)
    kept_rows = select_rows(read_rows(stored), ROW, row).to_pylist()
    if not kept_rows:
        raise StudyError(f"Row {row} of study {stored.name} is not done yet.")
    index, law = divmod(row, len(study.laws))
    (configuration,) = build_configurations(study, study.laws[law], draw(study, index, 1))
    if configuration is None:
        raise StudyError(
            f"Row {row} of study {stored.name} was not run: its settings are incompatible."
        )
    result = simulate(configuration, duration_s=study.duration_s)
    metrics = measure_samples(result, study.measure_from_s, study.duration_s)
    return Replay(row, kept_rows[0], configuration, result, metrics)


def measure_samples(result: Result, begin_s: float, end_s: float) -> dict[str, float]:
    """Compute the metrics of a run's samples between two times, bit-identical to a batch.

    `end_s` is the planned end; a fault may have ended the run before.
    """
    period = result.configuration.sampling.period_s
    summary = summarize_result(result, begin_s, end_s)
    outcome = build_outcome(summary, np.array([period]), begin_s, Success())
    return {name: float(outcome[name][0]) for name in METRICS}


def record_replay(
    stored: StoredStudy, replay: Replay, catalogue: Catalogue, owner: str = ""
) -> RunEntry:
    """Add the run to the catalogue, so that the lab shows it like any recorded run.

    `owner` is the id of the user who requested it, in a class.
    """
    varied = {variation.column: replay.kept[variation.column] for variation in stored.study.vary}
    lines = [
        f"{name}: {value:g}" if isinstance(value, float) else f"{name}: {value}"
        for name, value in varied.items()
    ]
    return record_result(
        replay.result,
        catalogue,
        session=f"study {stored.name}",
        name=f"Study {stored.name}, row {replay.row}",
        tags=("study", stored.name[:50]),
        notes="\n".join((stored.study.title, *lines)),
        owner=owner,
    )


def _is_same(a: float, b: float) -> bool:
    return struct.pack("<d", a) == struct.pack("<d", b) or (a != a and b != b)
