"""The curves and numbers of a run for its page, from samples at full rate."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from svsa.actuators.signals import ESTIMATED, PLOTTED
from svsa.runs.metrics.metrics import MEASURED, RunningMetrics
from svsa.runs.records.measured_window import MeasuredWindow, summarize
from svsa_scene.replay_packing import ArrayPack

Array = npt.NDArray[np.float64]

MAX_POINTS = 120_000
"""Maximum number of points of a curve in all lanes together: a minute of two lanes at 1 kHz has
every sample.
"""

_AXIS_PARTS = 4000
_MIN_AXES = {
    "stiffness_estimate_nm_per_rad": 2.0,
    "stiffness_deviation_nm_per_rad": 2.0,
    "spring_misfit": 1.0,
    "position_error_rad": math.radians(0.004),
    "position_rad": math.radians(2.0),
    "position_reference_rad": math.radians(2.0),
    "stiffness_nm_per_rad": 2.0,
    "stiffness_reference_nm_per_rad": 2.0,
}
_MIN_TORQUE_AXIS_NM = 1.0


def decimate(values: Array, stride: int) -> Array:
    """One value for every `stride` samples: the first of them, or the one that sticks out most
    from between the first and the next segment's first, so that no peak is lost.
    """
    if stride == 1:
        return values
    count = -(-len(values) // stride)
    padded = np.append(values, np.full(count * stride - len(values), values[-1]))
    segments = padded.reshape(count, stride)
    first = segments[:, 0]
    following = np.append(first[1:], values[-1])
    top, bottom = np.fmax.reduce(segments, axis=1), np.fmin.reduce(segments, axis=1)
    above = top - np.fmax(first, following)
    below = np.fmin(first, following) - bottom
    kept = np.where((above > 0) & (above >= below), top, first)
    return np.where((below > 0) & (below > above), bottom, kept)


def resolve(channel: str) -> float:
    """Step to which a drawn channel is rounded, in its SI unit: a 4000th of the least height that
    the page gives its axis at any zoom, thus finer than a pixel.
    """
    return _MIN_AXES.get(channel, _MIN_TORQUE_AXIS_NM) / _AXIS_PARTS


def was_estimated(samples: Array, channels: Sequence[str]) -> bool:
    """Whether the spring estimator was on in some sample (ticks, lanes, channels)."""
    name = ESTIMATED[-1]
    return name in channels and bool(np.any(samples[:, :, channels.index(name)] > 0.0))


def pack_curves(
    samples: Array, channels: Sequence[str], period_s: float, pack: ArrayPack
) -> dict[str, Any]:
    """Pack every drawn channel of the run: for each lane the number of its array.

    Every sample, or for a run of more than `MAX_POINTS` one of several, with the peaks between.
    """
    ticks, lanes, _ = samples.shape
    stride = -(-ticks * lanes // MAX_POINTS)
    return {
        "step_s": stride * period_s,
        "stride": stride,
        "channels": {
            name: [
                pack.add_curve(
                    decimate(samples[:, lane, channels.index(name)], stride), resolve(name)
                )
                for lane in range(lanes)
            ]
            for name in (*PLOTTED, *(ESTIMATED if was_estimated(samples, channels) else ()))
            if name in channels
        },
    }


def compute_metrics(
    samples: Array, channels: Sequence[str], period_s: float, window: MeasuredWindow
) -> list[dict[str, float | None]]:
    """For each lane its metrics over these samples of a window, in SI, as
    `svsa.runs.metrics.metrics.Metrics`; none without the channels for it, or without numbers.
    """
    if not set(MEASURED) <= set(channels):
        return []
    columns = [channels.index(name) for name in MEASURED]
    lanes = [RunningMetrics(period_s) for _ in range(samples.shape[1])]
    for lane, running in enumerate(lanes):
        running.update_measured(samples[:, lane, columns])
    return [metrics.to_dict() for metrics in summarize(lanes, window) or ()]
