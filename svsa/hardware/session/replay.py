"""Verification of a bench's record: its measurements are passed through the bench's own loop.

A bench run cannot be repeated. But its loop consists of functions of the measured and sent values,
so that all other values in the record must be identical when they are computed again.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.signals import (
    CHANNEL_INDEX,
    CHANNEL_NAMES,
    MEASURED,
    TORQUES,
    Disturbance,
    Measurement,
    State,
    Torque,
)
from svsa.hardware.bench.reading import Reading
from svsa.hardware.bench.real_motors import RealMotors
from svsa.hardware.realtime.loop import BenchLoop
from svsa.hardware.realtime.memory import SampleArray
from svsa.hardware.safety.machine import BenchStatus
from svsa.hardware.session.run import BenchRun
from svsa.runs.definition.command import Command, fold
from svsa.runs.execution.replay import play
from svsa.runs.records.header import PlantKind, RecordError
from svsa.runs.records.reader import Record
from svsa.runs.records.resimulation import (
    compare_channels,
    describe_not_compared,
    read_origin,
)
from svsa.simulation.loop.measured import Actuation

_HALF_STEP = 0.5 + 1e-6


class Verified(NamedTuple):
    """The result of verifying a bench's record.

    Attributes:
        plant: Plant of the record.
        ticks: Number of samples.
        missed: Number of samples that the loop missed.
        lanes: Number of simulated lanes in parallel.
        not_compared: Channels that only the record or only this version has.
        share_as_limited: Share of the samples in which the torque sent is the limited torque of the
            law, to a step of the drive's current; in the others the guard reduced it.
    """

    plant: PlantKind
    ticks: int
    missed: int
    lanes: int
    not_compared: tuple[str, ...]
    share_as_limited: float

    @property
    def description(self) -> str:
        """The result as a sentence."""
        what = "an emulator" if self.plant == "emulated" else "a bench"
        with_lane = {0: "", 1: ", and the simulated lane"}.get(
            self.lanes, f", and the {self.lanes} simulated lanes"
        )
        late = f" ({self.missed} of them were missed)" if self.missed else ""
        return (
            f"Recorded on {what}, which cannot be run again. From the angles measured and the"
            f" torques sent in its {self.ticks} samples{late} references, observer, estimate and"
            f" errors were computed again{with_lane}: the same, bit for bit. The torques sent are"
            f" those that its law commands, to a step of the drives, in"
            f" {100.0 * self.share_as_limited:.1f} % of the samples, and never beyond them."
            f"{describe_not_compared(self.not_compared)}"
        )


class RecordedPlant:
    """A plant with recorded measurements and torques. limited: the law's, (ticks, 2)."""

    status = BenchStatus.RUN

    def __init__(self, samples: np.ndarray) -> None:
        self._measured = samples[:, MEASURED].tolist()
        self.sent = samples[:, TORQUES]
        self.limited = np.full_like(self.sent, np.nan)
        self.tick = 0

    def start(self, now: float) -> None:
        """Do nothing: the plant runs."""

    def read(self, now: float, known: State) -> Reading:  # noqa: D102
        y = Measurement(*self._measured[self.tick])
        return Reading(y, (0.0, 0.0), (0.0, 0.0, 0.0), (0, 0, 0))

    def write(  # noqa: D102
        self, now: float, limited: Torque, known: State, estimate: Disturbance, missed: int
    ) -> Torque:
        self.limited[self.tick] = limited
        return Torque(*self.sent[self.tick].tolist())


def verify_bench_record(record: Record) -> Verified:
    """Compute a bench's record again from its measurements.

    Raises:
        RecordError: If it differs.
    """
    header, start = record.header, record.start
    if start is None or record.first_tick:
        raise RecordError(
            f"Run {header.run_id} was recorded on a bench, and not from the start of its run:"
            " nothing of it can be verified."
        )
    configuration, commands = read_origin(record)
    before, later = commands[: start.commands], commands[start.commands :]
    for command in before:
        configuration = fold(configuration, command, is_bench=True)
    common, not_compared = compare_channels(header.channel_names, CHANNEL_NAMES)
    if missing := [
        CHANNEL_NAMES[index]
        for index in (*MEASURED, *TORQUES)
        if CHANNEL_NAMES[index] not in common
    ]:
        raise RecordError(
            f"Run {header.run_id} cannot be verified: its record has no {', '.join(missing)}."
        )
    samples = record.read_channels(CHANNEL_NAMES).transpose(1, 0, 2)
    plant, rows = RecordedPlant(samples[0]), SampleArray(record.tick_count)
    actuation = Actuation(start.latency_s, start.lag_s)
    loop = BenchLoop(plant, actuation, start.mu0, configuration, rows)
    loop.know(start.motion)
    begun = loop.start(0.0)
    _follow(loop, plant, later, record)
    run, again = BenchRun(configuration, begun, rows), np.empty_like(samples)
    for _ in play(run, later, record.tick_count, again):
        pass
    _compare(record, again, samples, common)
    real = RealMotors.of(configuration.actuator)
    share = _compare_torques(record, real, plant, start.torque_step_nm)
    missed = int(np.isnan(plant.sent[:, 0]).sum())
    lanes = len(samples) - 1
    return Verified(header.plant, record.tick_count, missed, lanes, not_compared, share)


def _follow(loop: BenchLoop, plant: RecordedPlant, commands: list[Command], record: Record) -> None:
    """Run every tick of the bench again, with its commands."""
    later, end = list(commands), record.tick_count
    is_missed = np.isnan(plant.sent[:, 0])
    while loop.run.tick < end:
        first = tick = loop.run.tick
        while later and later[0].tick <= first:
            loop.change(later.pop(0))
        while tick < end and is_missed[tick]:
            tick += 1
        if tick == end or (tick > first == 0):
            raise RecordError(f"Run {record.header.run_id} has no samples from tick {first} on.")
        plant.tick = tick
        loop.tick(0.0, tick - first)


def _compare(
    record: Record, again: np.ndarray, samples: np.ndarray, common: tuple[str, ...]
) -> None:
    """Raise `RecordError` at the first different sample of the common channels.

    Both arrays (lanes, ticks, channels).
    """
    columns = [CHANNEL_INDEX[name] for name in common]
    differs = again[..., columns].view(np.uint64) != samples[..., columns].view(np.uint64)
    if not differs.any():
        return
    tick = int(np.argmax(differs.any(axis=(0, 2))))
    lane, channel = np.argwhere(differs[:, tick])[0]
    header = record.header
    raise RecordError(
        f"Run {header.run_id} does not follow from what it measured and sent: worked out again,"
        f" {header.lanes[lane]}.{common[channel]} differs at tick {tick}."
    )


def _compare_torques(
    record: Record, real: RealMotors, plant: RecordedPlant, torque_step_nm: tuple[float, float]
) -> float:
    """Return the share of samples whose torques are as limited.

    The torques are compared motor by motor, as the bench limits them.
    A torque that the bench reduces (limits, heat, rate of change, ramp, a drive that is not ready)
    lies between zero, the previous torque, and the limited one.

    Raises:
        RecordError: If a torque lies outside.
    """
    there = np.flatnonzero(np.isfinite(plant.sent[:, 0]))
    sent, limited = (
        np.stack(real.split(Torque(*torques[there].T)), axis=1)
        for torques in (plant.sent, plant.limited)
    )
    last = np.vstack([np.zeros(2), sent[:-1]])
    room = _HALF_STEP * np.array(torque_step_nm)
    least = np.minimum(np.minimum(limited, last), 0.0) - room
    most = np.maximum(np.maximum(limited, last), 0.0) + room
    beyond = ((sent < least) | (sent > most)).any(axis=1)
    if beyond.any():
        row = int(np.argmax(beyond))
        raise RecordError(
            f"Run {record.header.run_id} was not controlled by its law: at tick {there[row]} it"
            f" sent {sent[row].round(4).tolist()} N·m, and the law asks for"
            f" {limited[row].round(4).tolist()} N·m."
        )
    return float((np.abs(sent - limited) <= room).all(axis=1).mean())
