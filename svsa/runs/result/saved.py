"""Conversion of results to records, so that simulated runs can be used like recorded ones."""

from pathlib import Path
from typing import Any

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.control.installed import OWN_LAW
from svsa.errors import StateError
from svsa.runs.definition.configuration import Configuration
from svsa.runs.records.catalogue.entry import RunEntry
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import RecordHeader, build_header, is_run_id
from svsa.runs.records.reader import Record, build_record
from svsa.runs.records.writer import write_record
from svsa.runs.result.arm import ArmResult
from svsa.runs.result.result import Result

SESSION = "script"
"""Name of the session in the record of a script."""


def build_result_record(result: Result, **known: Any) -> Record:
    """Build the record of a result, in memory.

    Args:
        result: A whole run. If a function controlled its first lane, the law is `OWN_LAW` in the
            record.
        **known: Fields of the header, such as `name`, `tags` and `notes`.

    Returns:
        The record, with commands, fault and the samples (ticks, lanes, channels) of every lane.

    Raises:
        ParameterError: If a field of the header is out of range.
        StateError: If the result is one of several lanes of a run or one joint of an arm, or has no
            samples.
    """
    if result.joint is not None:
        raise StateError("This result is one joint of an arm: use the result of the arm.")
    configuration = result.configuration
    if len(result.comparisons) != len(configuration.comparisons):
        raise StateError("This result is one lane of a run: save the run that it belongs to.")
    if not len(result.samples):
        raise StateError("This run has no samples: it ended before its first tick.")
    if result.law == OWN_LAW:
        configuration = configuration.changed(law=OWN_LAW)
    samples = np.stack([lane.samples for lane in (result, *result.comparisons)], axis=1)
    fields = {"session": SESSION, "name": result.name, "plant": result.plant, "steps": result.steps}
    header = _build_header(configuration, samples, fields | known)
    commands = [(command.tick, command.to_json()) for command in result.commands]
    first_tick = round(float(result.time_s[0]) / header.period_s)
    return build_record(header, commands, first_tick, _select(header, samples), result.fault)


def build_arm_result_record(result: ArmResult, **known: Any) -> Record:
    """Build the record of an arm's result, in memory.

    Args:
        result: A whole run.
        known: Fields of the header, as `name`, `tags` and `notes`.

    Returns:
        The record, with two lanes for each arm.

    Raises:
        ParameterError: If a field of the header is out of range.
        StateError: If the result is one of two arms of a run, or has no samples.
    """
    arms = (result, *result.comparisons)
    if len(arms) != len(result.configuration.controllers):
        raise StateError("This result is one arm of a run: save the run that it belongs to.")
    if not result.samples.shape[1]:
        raise StateError("This run has no samples: it ended before its first tick.")
    samples = np.concatenate([arm.samples for arm in arms]).transpose(1, 0, 2)
    fields = {"session": SESSION, "steps": result.steps}
    header = _build_header(result.configuration, samples, fields | known)
    commands = [(command.tick, command.to_json()) for command in result.commands]
    return build_record(header, commands, 0, _select(header, samples), result.fault)


def _build_header(
    configuration: Configuration, samples: np.ndarray, fields: dict[str, Any]
) -> RecordHeader:
    """Build the header of samples without the channels that are unknown everywhere.

    `open_run` reads a channel that a record lacks as NaN: saved again, it is missing again.
    """
    channels = [
        channel
        for index, channel in enumerate(CHANNELS)
        if not np.isnan(samples[:, :, index]).all()
    ]
    return build_header(configuration, samples.shape[1], channels=channels, **fields)


def _select(header: RecordHeader, samples: np.ndarray) -> np.ndarray:
    return samples[:, :, [CHANNEL_INDEX[name] for name in header.channel_names]]


def save_run(
    result: Result | ArmResult,
    folder: Path | str | None = None,
    *,
    name: str = "",
    tags: tuple[str, ...] = (),
    notes: str = "",
) -> Path:
    """Write a result as a record with bit-identical samples.

    Args:
        result: Result of `simulate`, with its comparisons, or of `simulate_arm`.
        folder: A new folder; by default one among the recorded runs of this machine, which a lab on
            this machine lists.
        name: Name of the run; by default its settings.
        tags: Tags to find it by.
        notes: Any text.

    Returns:
        The folder, which `open_run`, `resimulate`, `compare_runs` and `export_run` accept; its name
        is the run's id.

    Raises:
        ParameterError: If name, tags or notes are too long.
        RecordError: If the folder exists or cannot be written.
        StateError: If the result is one of several lanes or arms of a run, or one joint of an arm,
            or has no samples.
    """
    called = name or ("" if isinstance(result, ArmResult) else result.name)
    known: dict[str, Any] = {"name": called, "tags": tuple(tags), "notes": notes}
    if folder is None:
        catalogue = Catalogue()
        return catalogue.find_folder(record_result(result, catalogue, **known).id)
    folder = Path(folder)
    if is_run_id(folder.name):
        known["run_id"] = folder.name
    _write(folder, _build_record(result, known))
    return folder


def record_result(result: Result | ArmResult, catalogue: Catalogue, **known: Any) -> RunEntry:
    """Add a result to a catalogue, so that the lab shows it like any recorded run.

    `known` are the fields of `build_result_record`.
    """
    record = _build_record(result, known)
    _write(catalogue.folder / "runs" / record.header.run_id, record)
    catalogue.register(record.header)
    return catalogue.finish(record.header.run_id)


def _build_record(result: Result | ArmResult, known: dict[str, Any]) -> Record:
    if isinstance(result, ArmResult):
        return build_arm_result_record(result, **known)
    return build_result_record(result, **known)


def _write(folder: Path, record: Record) -> None:
    write_record(
        folder, record.header, record.commands, record.first_tick, record.samples, record.fault
    )
