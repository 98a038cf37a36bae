"""Data for identification from a record: measured angles, torques, usable segments.

Only quantities that a bench measures are used. The true angles of a simulated run are passed
through the encoders and noise of the run; those of a bench are already measured.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import build_actuator
from svsa.actuators.lever import compute_lever_ratio
from svsa.actuators.parameters import SVSA, get_mechanism_name
from svsa.analysis.identification.kernel import UNLOADED, Setting, Torques, measure
from svsa.errors import SvsaError
from svsa.numerics.exponential import exp
from svsa.runs.definition.command import Command, fold
from svsa.runs.definition.configuration import Configuration
from svsa.runs.records.reader import Record
from svsa.runs.records.resimulation import read_origin
from svsa.runs.timeline.loads import list_loads
from svsa.simulation.plant.effects import NO_EFFECTS, build_effect_constants

SEGMENT_S = 0.25
MIN_SEGMENTS = 24
_CHANNELS = (
    "motor1_position_rad",
    "motor2_position_rad",
    "deflection_rad",
    "torque1_nm",
    "torque2_nm",
    "lever_ratio",
)
_TRUTH = "disturbance_link_nm"
_CHANGES = {"actuator": "the plant's parameters", "effects": "the effects"}


class IdentificationError(SvsaError):
    """The parameters cannot be identified from a run; the message has the reason."""


class Evidence(NamedTuple):
    """The data of a record for identification.

    Attributes:
        configuration: Configuration of the run.
        setting: Known quantities.
        angles: Measured θ1, θ2, φ, rad, shape (rows, 3).
        torques: `Torques`.
        segments: First rows of the segments that are used.
        length: Number of rows in each segment.
        loaded: Number of rows under a load.
        lever_deviation: Standard deviation of the known lever ratio, 1.
    """

    configuration: Configuration
    setting: Setting
    angles: np.ndarray
    torques: Torques
    segments: np.ndarray
    length: int
    loaded: int
    lever_deviation: float = 0.0


def read_evidence(record: Record) -> Evidence:
    """Read the first lane of a record, without segments under load and missed ticks.

    Raises:
        IdentificationError: If too few samples are left, or the plant changed during the run.
    """
    configuration, commands = read_origin(record)
    configuration = _find_plant(record, configuration, commands)
    check_actuator(configuration, f"Run {record.header.run_id}")
    rows = record.read_channels(_CHANNELS)[:, 0]
    is_measured = bool(np.isnan(record.read_channels([_TRUTH], 0, 1)).all())
    missed = np.zeros(len(rows), bool)
    if is_measured:
        missed[:] = np.isnan(rows).all(axis=1)
    rows = _hold(rows, missed)
    if not np.isfinite(rows).all():
        raise IdentificationError(f"Run {record.header.run_id} has samples that are no numbers.")
    period = record.header.period_s
    length = round(SEGMENT_S / period)
    ticks = record.first_tick + np.arange(len(rows))
    loaded = np.zeros(len(rows), bool)
    for load in list_loads(configuration, commands):
        loaded[(ticks >= load.start_tick) & (ticks < load.end_tick)] = True
    segments = find_segments(~(loaded | missed), length)
    if len(segments) < MIN_SEGMENTS:
        raise IdentificationError(
            f"Run {record.header.run_id} has {len(segments) * SEGMENT_S:g} s without a load:"
            f" at least {MIN_SEGMENTS * SEGMENT_S:g} s are needed."
        )
    a = configuration.actuator
    mu0 = rows[0, 5] - compute_lever_ratio(rows[0, 1], 0.0, a.spiral_reduction)
    effects = configuration.effects
    setting, lag = build_setting(configuration, mu0, period)
    angles, torques = np.ascontiguousarray(rows[:, :3]), np.ascontiguousarray(rows[:, 3:5])
    if not is_measured:
        true = angles.copy()
        measure(
            build_effect_constants(effects, configuration.seed, a, period),
            record.first_tick,
            true,
            angles,
        )
    torques = build_torques(torques, is_measured, lag, period)
    return Evidence(configuration, setting, angles, torques, segments, length, int(np.sum(loaded)))


def check_actuator(configuration: Configuration, source: str) -> None:
    """Reject another actuator than the SVSA; the message begins with the source of the data.

    Raises:
        IdentificationError: If the actuator is another one.
    """
    name = get_mechanism_name(configuration.actuator)
    if name != SVSA:
        raise IdentificationError(
            f"{source} has the actuator {name}: only the spring of the SVSA (Eq 2) is identified."
        )


def build_setting(
    configuration: Configuration, mu0: float, period_s: float, sigma: float = 0.0
) -> tuple[Setting, float]:
    """Return the known quantities of the plant, and the time constant of its current loop, s.

    `mu0` and `sigma` are those of `Setting`.
    """
    known = build_actuator(configuration.actuator, mu0)
    lag = configuration.effects.current_lag
    constant = lag.time_constant_s if lag else 0.0
    effects = NO_EFFECTS._replace(current_lag=constant)
    setting = Setting(known.gamma, mu0, sigma, known.reaction, period_s, effects, UNLOADED)
    return setting, constant


def _hold(rows: np.ndarray, missed: np.ndarray) -> np.ndarray:
    """Fill rows that the loop missed with the previous ones: the drives hold their currents."""
    known = np.where(missed, 0, np.arange(len(rows)))
    return rows[np.maximum.accumulate(known)]


def build_torques(recorded: np.ndarray, is_measured: bool, lag: float, period: float) -> Torques:
    """Compute actual and commanded torques from the recorded ones (rows, 2), N·m.

    A bench records the commanded torque, a simulation the actual one: with the lag, each follows
    from the other (`compute_lagged_torque`). `lag` and `period` are in s.
    """
    rest = exp(-period / lag) if lag > 0.0 else 0.0
    if is_measured:
        from scipy.signal import lfilter  # imported here: the import is slow

        made = lfilter([0.0, 1.0 - rest], [1.0, -rest], recorded, axis=0)
        return Torques(np.ascontiguousarray(made), recorded)
    following = np.concatenate([recorded[1:], recorded[-1:]])
    asked = (following - rest * recorded) / (1.0 - rest) if rest else recorded
    return Torques(recorded, np.ascontiguousarray(asked))


def _find_plant(
    record: Record, configuration: Configuration, commands: Sequence[Command]
) -> Configuration:
    """Return the configuration with the actuator and effects of the record's samples."""
    for command in commands:
        if command.kind not in ("actuator", "effects"):
            continue
        if command.tick > record.first_tick:
            time = command.tick * record.header.period_s
            raise IdentificationError(
                f"Run {record.header.run_id} is not of one plant: {_CHANGES[command.kind]} were"
                f" changed at {time:g} s. Record a run in which they stay."
            )
        configuration = fold(configuration, command)
    return configuration


def find_segments(free: np.ndarray, length: int) -> np.ndarray:
    """Return first rows of the complete segments of `length` rows in the usable stretches."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], free, [False]]).astype(int)))
    stretches = zip(edges[::2], edges[1::2], strict=True)
    pieces = [np.arange(first, end - length + 1, length) for first, end in stretches]
    return np.concatenate([np.empty(0, int), *pieces])
