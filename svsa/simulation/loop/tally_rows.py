"""The `Tally` of samples: of a complete run, or incrementally."""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX, Reference, State, Torque
from svsa.numerics.compilation import compiled
from svsa.simulation.loop.lane import Blocks
from svsa.simulation.loop.tally import (
    Moment,
    Tally,
    Window,
    add_moment,
    build_window,
    follow_recovery,
    measure,
    start_tally,
)

MOMENT = (
    "position_error_rad",
    "stiffness_error_nm_per_rad",
    "stiffness_reference_nm_per_rad",
    "torque1_nm",
    "torque2_nm",
    "motor1_velocity_rad_per_s",
    "motor2_velocity_rad_per_s",
)
"""Names of the channels of a `Moment`, in its order."""

_REFERENCE = CHANNEL_INDEX["position_reference_rad"]
_SIGMA = CHANNEL_INDEX["stiffness_reference_nm_per_rad"]
_Q, _DQ = CHANNEL_INDEX["position_rad"], CHANNEL_INDEX["velocity_rad_per_s"]
_THETA1 = CHANNEL_INDEX["motor1_position_rad"]
_DTHETA1 = CHANNEL_INDEX["motor1_velocity_rad_per_s"]
_THETA2 = CHANNEL_INDEX["motor2_position_rad"]
_DTHETA2 = CHANNEL_INDEX["motor2_velocity_rad_per_s"]
_U1, _U2 = CHANNEL_INDEX["torque1_nm"], CHANNEL_INDEX["torque2_nm"]


class Recovery(NamedTuple):
    """The state of `follow_recovery`, and the newest size of the error, in the error's unit."""

    inside: float
    recovered: float
    size: float


class Followed(NamedTuple):
    """The incremental summary of a run's samples.

    Attributes:
        tally: `Tally` of the known samples.
        position: Recovery of the position error.
        stiffness: Recovery of the stiffness error.
        passed: Number of samples.
        known: Number of samples with values.
        stiffness_absolute: Sum of |σ_d − σ|, N·m/rad.
        torque2_variation: Sum of |Δu2|, N·m.
        torque2_last: u2 of the last sample, N·m.
    """

    tally: Tally
    position: Recovery
    stiffness: Recovery
    passed: float
    known: float
    stiffness_absolute: float
    torque2_variation: float
    torque2_last: float


def start_following() -> Followed:
    """Return `Followed` before the first sample."""
    outside = Recovery(0.0, -1.0, math.inf)
    return Followed(start_tally(0.0), outside, outside, 0.0, 0.0, 0.0, 0.0, 0.0)


@compiled
def follow_samples(followed: Followed, rows: np.ndarray, window: Window) -> Followed:
    """Update `Followed` with more samples.

    A sample that the loop of a bench missed is NaN. It is left out of sums and peaks; for the
    recovery the error keeps its last known value.

    Args:
        followed: Summary of the samples before.
        rows: Shape (ticks, channels), the first ones as in `MOMENT`, SI.
        window: Only its `settled` is used; the window has no end.

    Returns:
        The updated summary.
    """
    tally, position, stiffness = followed.tally, followed.position, followed.stiffness
    passed, known = followed.passed, followed.known
    absolute, variation = followed.stiffness_absolute, followed.torque2_variation
    last, settled = followed.torque2_last, float(window.settled)
    for i in range(rows.shape[0]):
        r = rows[i]
        e, s = position.size, stiffness.size
        passed += 1.0
        if not math.isnan(r[0]):
            moment = Moment(r[0], r[1], r[2], r[3], r[4], r[5], r[6])
            tally = add_moment(tally, True, window, False, moment, int(known))
            e, s = abs(moment.position), abs(moment.stiffness)
            absolute += s
            if known > 0.0:
                variation += abs(moment.u2 - last)
            last = moment.u2
            known += 1.0
        inside, recovered = position.inside, position.recovered
        peak = tally.position_peak
        found = follow_recovery(True, e, peak, passed, settled, inside, recovered)
        position = Recovery(found[0], found[1], e)
        inside, recovered = stiffness.inside, stiffness.recovered
        peak = tally.stiffness_peak
        found = follow_recovery(True, s, peak, passed, settled, inside, recovered)
        stiffness = Recovery(found[0], found[1], s)
    return Followed(tally, position, stiffness, passed, known, absolute, variation, last)


@compiled
def sum_up(samples: np.ndarray, blocks: Blocks, begin: int, end: int) -> Tally:
    """Compute the `Tally` of one run's samples (ticks, channels), bit-identical to a batch.

    `begin` and `end` bound the measured ticks. If there are fewer samples than ticks, the run ended
    early.
    """
    tally, window = start_tally(0.0), build_window(begin, end, blocks.period)
    for tick in range(samples.shape[0]):
        s = samples[tick]
        reference = Reference(s[_REFERENCE], 0.0, 0.0, 0.0, 0.0, s[_SIGMA], 0.0, 0.0)
        x = State(s[_Q], s[_DQ], s[_THETA1], s[_DTHETA1], s[_THETA2], s[_DTHETA2])
        tally = measure(tally, True, window, blocks, reference, x, Torque(s[_U1], s[_U2]), tick)
    return tally
