"""A run of the emulator in virtual time, recorded like that of a session."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from svsa.actuators.signals import CHANNELS
from svsa.hardware.realtime.configuration import build_bench_configuration, read_actuation
from svsa.hardware.realtime.loop import BenchLoop
from svsa.hardware.realtime.memory import SampleArray
from svsa.hardware.safety.machine import BenchStatus
from svsa.hardware.session.run import BenchRun, describe_start
from svsa.runs.definition.command import Command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.replay import play
from svsa.runs.records.bench_start import BenchStart, write_start
from svsa.runs.records.writer import write_record
from tests.hardware.wired_bench import WiredBench
from tests.runs.records.records import build_header


def run_bench(
    wanted: Configuration,
    ticks: int,
    before: Sequence[Command] = (),
    later: Sequence[Command] = (),
    late: Mapping[int, int] | None = None,
) -> tuple[Configuration, np.ndarray, BenchStart]:
    """Return its initial configuration, its samples (lanes, ticks, channels), and its start.

    before: commands before the start. late: the number of missed ticks, by the tick of the loop at
    which they are missed.
    """
    with WiredBench() as wired:
        bench, plant = wired.bench, wired.plant
        configuration = build_bench_configuration(bench, wanted)
        actuation, mu0 = read_actuation(bench), bench.home.lever_ratio
        rows = SampleArray(ticks)
        loop = BenchLoop(plant, actuation, mu0, configuration, rows)
        plant.arm(wired.now)
        while plant.status is not BenchStatus.READY:
            wired.drive(loop)
        while (step := plant.homing_step) is not None:
            plant.confirm_home(step, "a test")
        wired.drive(loop, 50)
        for command in before:
            loop.change(command)
        motion = loop.read_motion()
        begun = loop.start(wired.now)
        configured, left = loop.run.configuration, list(later)
        while loop.run.tick < ticks:
            while left and left[0].tick <= loop.run.tick:
                loop.change(left.pop(0))
            missed = (late or {}).get(loop.run.tick, 0)
            wired.skip(missed * bench.timing.period_s)
            wired.drive(loop, missed=missed)
        assert plant.fault is None, plant.fault
        run, samples = BenchRun(configured, begun, rows), np.empty((2, ticks, len(CHANNELS)))
        for _ in play(run, later, ticks, samples):
            pass
        return configuration, samples, describe_start(bench, mu0, motion, len(before))


def write_bench_record(
    folder: Path,
    run: tuple[Configuration, np.ndarray, BenchStart],
    commands: Sequence[Command] = (),
) -> None:
    """Write the record of `run_bench`. commands: all its commands."""
    configuration, samples, start = run
    header = build_header(
        folder.name,
        lanes=("Bench", "Twin")[: len(samples)],
        plant="emulated",
        configuration=configuration.model_dump(mode="json"),
        seed=configuration.seed,
    )
    lines = [(command.tick, command.to_json()) for command in commands]
    write_record(folder, header, lines, 0, samples.transpose(1, 0, 2))
    write_start(folder, start)
