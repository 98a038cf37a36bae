"""Comparison of a record with its own simulation: same configuration, seed and commands."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX, CHANNEL_NAMES
from svsa.control.installed import OWN_LAW
from svsa.runs.definition.command import Command, read_command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.replay import simulate_again
from svsa.runs.records.header import RecordError
from svsa.runs.records.reader import Record


@dataclass(frozen=True)
class Comparison:
    """Result of comparing a record with its simulation, bit for bit.

    Attributes:
        identical: Whether every sample of every lane is identical.
        ticks: Number of ticks compared.
        first_difference: Tick and channel ("lane.channel") of the first sample that differs, or
            None.
        not_compared: Channels that only the record or only this version has.
    """

    identical: bool
    ticks: int
    first_difference: tuple[int, str] | None
    not_compared: tuple[str, ...] = ()


def read_origin(record: Record) -> tuple[Configuration, list[Command]]:
    """Read the configuration at tick 0 and the commands of a record.

    Raises:
        ParameterError: If this version does not support them.
    """
    commands = [read_command(written) for _, written in record.commands]
    return Configuration(**record.header.configuration), commands


def check_simulated(record: Record) -> None:
    """Raise `RecordError` for a bench's run, a Python controller, or other integration steps."""
    header = record.header
    if header.plant != "simulated":
        raise RecordError(
            f"Run {header.run_id} was recorded on a bench (plant: {header.plant}): only a"
            " simulated run can be simulated again."
        )
    if header.configuration.get("law") == OWN_LAW:
        raise RecordError(
            f"Run {header.run_id} was controlled by a function of a script, which its record does"
            " not contain: only a run of installed laws can be simulated again."
        )
    if header.steps != 1:
        raise RecordError(
            f"Run {header.run_id} was integrated with {header.steps} steps a control period: only"
            " a run with one step can be simulated again."
        )


def compare_with_simulation(record: Record) -> Comparison:
    """Simulate a recorded run again from its record, and compare every bit of the common channels.

    Raises:
        RecordError: If the run was not simulated (see `check_simulated`), or has other lanes.
    """
    check_simulated(record)
    configuration, commands = read_origin(record)
    names = record.header.channel_names
    common, not_compared = compare_channels(names, CHANNEL_NAMES)
    recorded = [names.index(name) for name in common]
    again = _iterate_rows(
        simulate_again(configuration, commands, record.first_tick, record.tick_count),
        [CHANNEL_INDEX[name] for name in common],
    )
    compared = 0
    for tick, rows in record.iterate():
        for offset, row in enumerate(rows[:, :, recorded]):
            simulated = next(again, None)
            if simulated is None:
                ended = tick + offset, "the simulation ended"
                return Comparison(False, compared, ended, not_compared)
            if simulated.shape != row.shape:
                raise RecordError(f"Record {record.header.run_id} has other lanes.")
            # Compare bytes, not values: NaN then equals NaN, and −0.0 differs from 0.0.
            if simulated.tobytes() != row.tobytes():
                lane, channel = np.argwhere(simulated.view(np.uint64) != row.view(np.uint64))[0]
                different = tick + offset, f"{record.header.lanes[lane]}.{common[channel]}"
                return Comparison(False, compared, different, not_compared)
            compared += 1
    return Comparison(True, compared, None, not_compared)


def _iterate_rows(stretches: Iterator[np.ndarray], channels: list[int]) -> Iterator[np.ndarray]:
    for samples in stretches:
        yield from np.ascontiguousarray(samples.transpose(1, 0, 2)[:, :, channels])


def compare_channels(
    own: Sequence[str], others: Sequence[str]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the channels that both have, in the order of `own`, and those that one of them lacks.

    Args:
        own: Names of channels.
        others: Names of channels to compare with.

    Returns:
        Common channels, and channels that cannot be compared.
    """
    common = tuple(name for name in own if name in others)
    rest = tuple(name for name in dict.fromkeys((*own, *others)) if name not in common)
    return common, rest


def describe_not_compared(channels: Sequence[str]) -> str:
    """Return a sentence that names channels without comparison; "" without any."""
    if not channels:
        return ""
    return f" Not compared, since they are not in both versions: {', '.join(channels)}."
