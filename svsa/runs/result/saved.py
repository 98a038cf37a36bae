"""Conversion of results to records, so that simulated runs can be used like recorded ones."""

from pathlib import Path
from typing import Any

import numpy as np

from svsa.control.installed import OWN_LAW
from svsa.errors import StateError
from svsa.runs.records.catalogue.entry import RunEntry
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import build_header, is_run_id
from svsa.runs.records.reader import Record, build_record
from svsa.runs.records.writer import write_record
from svsa.runs.result.result import Result

SESSION = "script"
"""What a record of a script has in place of the name of its session."""


def build_result_record(result: Result, **known: Any) -> Record:
    """Build the record of a result, in memory.

    Args:
        result: A whole run. Its first lane's law is `OWN_LAW` in the record where a function
            controlled it.
        known: Fields of the header, as `name`, `tags` and `notes`.

    Returns:
        The record, with commands, fault and the samples (ticks, lanes, channels) of every lane.

    Raises:
        ParameterError: If a field of the header is out of range.
        StateError: If the result is one of several lanes of a run, or has no samples.
    """
    configuration = result.configuration
    if len(result.comparisons) != len(configuration.comparisons):
        raise StateError("This result is one lane of a run: save the run that it belongs to.")
    if not len(result.samples):
        raise StateError("This run has no samples: it ended before its first tick.")
    if result.law == OWN_LAW:
        configuration = configuration.changed(law=OWN_LAW)
    samples = np.stack([lane.samples for lane in (result, *result.comparisons)], axis=1)
    given = {"session": SESSION, "name": result.name, "plant": result.plant, "steps": result.steps}
    header = build_header(configuration, samples.shape[1], **(given | known))
    commands = [(command.tick, command.to_json()) for command in result.commands]
    first_tick = round(float(result.time_s[0]) / header.period_s)
    return build_record(header, commands, first_tick, samples, result.fault)


def save_run(
    result: Result,
    folder: Path | str | None = None,
    *,
    name: str = "",
    tags: tuple[str, ...] = (),
    notes: str = "",
) -> Path:
    """Write a result as a record with bit-identical samples.

    Args:
        result: What `simulate` returned, with its comparisons.
        folder: A new folder; left out, one among the recorded runs of this machine, which a
            lab of this machine lists.
        name: What the run is called; left out, by its settings.
        tags: Words to find it by.
        notes: Any text.

    Returns:
        The folder, which `open_run`, `resimulate`, `compare_runs` and `export_run` take; its name
        is the run's id.

    Raises:
        ParameterError: If name, tags or notes are too long.
        RecordError: If the folder exists or cannot be written.
        StateError: If the result is one of several lanes of a run, or has no samples.
    """
    known: dict[str, Any] = {"name": name or result.name, "tags": tuple(tags), "notes": notes}
    if folder is None:
        catalogue = Catalogue()
        return catalogue.find_folder(record_result(result, catalogue, **known).id)
    folder = Path(folder)
    if is_run_id(folder.name):
        known["run_id"] = folder.name
    _write(folder, build_result_record(result, **known))
    return folder


def record_result(result: Result, catalogue: Catalogue, **known: Any) -> RunEntry:
    """Add a result to a catalogue, where the lab shows it like any recorded run.

    known: as of `build_result_record`.
    """
    record = build_result_record(result, **known)
    _write(catalogue.folder / "runs" / record.header.run_id, record)
    catalogue.register(record.header)
    return catalogue.finish(record.header.run_id)


def _write(folder: Path, record: Record) -> None:
    write_record(
        folder, record.header, record.commands, record.first_tick, record.samples, record.fault
    )
