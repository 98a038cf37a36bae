"""Replay of a run from configuration and commands: every sample."""

from collections.abc import Iterable, Iterator

import numpy as np

from svsa.actuators.signals import CHANNELS
from svsa.errors import StateError
from svsa.runs.definition.command import Command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.arm_run import build_run
from svsa.runs.execution.run import Run

STRETCH_TICKS = 10_000


def replay(
    configuration: Configuration, commands: Iterable[Command], end_tick: int
) -> Iterator[tuple[Run, np.ndarray]]:
    """Simulate a run again from its start; see `play`."""
    return play(build_run(configuration), commands, end_tick)


def play(
    run: Run,
    commands: Iterable[Command],
    end_tick: int,
    room: np.ndarray | None = None,
    stretch_ticks: int = STRETCH_TICKS,
) -> Iterator[tuple[Run, np.ndarray]]:
    """Continue a run, with each command at its tick; bit-identical for the same arguments.

    Args:
        run: The run.
        commands: Commands with their ticks.
        end_tick: Tick at which to stop.
        room: Array (lanes, ticks, channels) for the samples.
        stretch_ticks: Maximum length of a slice.

    Yields:
        The run after every slice, and the slice's samples (lanes, ticks, channels), until
        `end_tick` or a fault.
    """
    later, first = list(commands), run.tick
    while True:
        while later and later[0].tick <= run.tick:
            run.change(later.pop(0))
        end = min([end_tick, run.tick + stretch_ticks, *(command.tick for command in later[:1])])
        if run.fault is not None or run.tick >= end:
            return
        if room is None:
            samples = np.empty((len(run.lanes), end - run.tick, len(CHANNELS)))
        else:
            samples = room[:, run.tick - first : end - first]
        yield run, samples[:, : run.advance(samples)]


def build_run_at(configuration: Configuration, commands: Iterable[Command], tick: int) -> Run:
    """Build the run at the beginning of `tick`, before the commands of that tick.

    Raises:
        StateError: If the run ended before.
    """
    run = build_run(configuration)
    for reached, _ in replay(configuration, [c for c in commands if c.tick < tick], tick):
        run = reached
    if run.tick < tick:
        raise StateError(f"The run ended before tick {tick}, at tick {run.tick}.")
    return run


def simulate_again(
    configuration: Configuration, commands: Iterable[Command], first_tick: int, ticks: int
) -> Iterator[np.ndarray]:
    """Simulate a recorded run again, bit-identical.

    Args:
        configuration: Configuration at tick 0.
        commands: Commands with their ticks.
        first_tick: First tick of the record.
        ticks: Number of its ticks.

    Yields:
        Samples in slices (lanes, ticks, channels).
    """
    for run, samples in replay(configuration, commands, first_tick + ticks):
        skipped = max(0, first_tick - (run.tick - samples.shape[1]))
        if skipped < samples.shape[1]:
            yield samples[:, skipped:]
