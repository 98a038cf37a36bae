"""Comparison of a run with a reference run: tolerances per channel, in value and time."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, FiniteOrNull, Number, quantity
from svsa.runs.records.header import RecordError
from svsa.runs.records.reader import Record
from svsa.runs.records.resimulation import compare_channels
from svsa.runs.records.stream import TIME


class Tolerance(Checked):
    """Tolerance of a channel: |a − b| ≤ absolute + relative · |b|.

    b is any value of the other run within `time_s` of that moment, or between two such values.
    """

    absolute: Number = quantity(
        "", "Absolute tolerance, in the unit of the channel", ge=0, default=0.0
    )
    relative: Number = quantity(
        "1", "Relative tolerance, as a share of the reference value", ge=0, default=0.0
    )
    time_s: Number = quantity("s", "Time tolerance", ge=0, le=60, default=0.0)


EXACT = Tolerance()
MAX_OUTSIDE = 500
FROM_THE_FIRST = (0, 0)


@dataclass(frozen=True)
class ChannelVerdict:
    """The verdict of a channel of a lane; times are those of the run under test.

    Attributes:
        held: Whether all samples are within the band.
        worst_s: Time of the largest deviation outside the band, or of the smallest distance to its
            bounds inside.
        value: Value at that time; null in JSON if not finite.
        low: Lower bound of the band at that time, as `value`.
        high: Upper bound of the band at that time, as `value`.
        excess: Distance outside the band at that time, negative inside; NaN if one of both values
            is unknown.
        outside: Intervals outside the band, s, in order; intervals closer than 1/500 of the
            compared time are joined.
        outside_s: Total time outside the band, s, counting every tick.
    """

    lane: str
    channel: str
    unit: str
    held: bool
    worst_s: float
    value: FiniteOrNull
    low: FiniteOrNull
    high: FiniteOrNull
    excess: FiniteOrNull
    outside: tuple[tuple[float, float], ...]
    outside_s: float


@dataclass(frozen=True)
class Verdict:
    """Result of comparing a run with a reference run.

    Attributes:
        held: Whether every channel is within its band, and both runs have the same length.
        ticks: Number of compared ticks.
        own_ticks: Length of the run, ticks.
        other_ticks: Length of the reference run, ticks.
        channels: Results by channel.
        not_compared: Channels that only one of both runs has.
    """

    held: bool
    ticks: int
    own_ticks: int
    other_ticks: int
    channels: tuple[ChannelVerdict, ...]
    not_compared: tuple[str, ...]


def judge(
    run: Record,
    other: Record,
    tolerances: Mapping[str, Tolerance],
    rest: Tolerance | None = EXACT,
    begins: tuple[int, int] = FROM_THE_FIRST,
) -> Verdict:
    """Compare a run with a reference run, lane by lane.

    Args:
        run: The run.
        other: The reference run.
        tolerances: Tolerances by channel.
        rest: Tolerance of all other channels; None leaves them out.
        begins: Samples of both runs that are aligned, and from which on they are compared. The
            lengths are those of the remaining samples.

    Returns:
        The verdict.

    Raises:
        ParameterError: If there is no such channel.
        RecordError: If lanes or periods differ, or nothing can be compared.
    """
    own, others = run.header, other.header
    if own.period_s != others.period_s or len(own.lanes) != len(others.lanes):
        raise RecordError(
            f"Runs {own.run_id} and {others.run_id} cannot be compared: {len(own.lanes)} lanes at"
            f" {own.period_s:g} s, and {len(others.lanes)} at {others.period_s:g} s."
        )
    common, not_compared = compare_channels(own.channel_names, others.channel_names)
    names = [name for name in common if name != TIME]
    for name in tolerances:
        if name not in names:
            bound = "a channel of both runs: " + ", ".join(names)
            raise ParameterError(Violation("channel", name, "", bound))
    left, others_left = run.tick_count - begins[0], other.tick_count - begins[1]
    ticks = max(0, min(left, others_left))
    chosen = {name: tolerances.get(name, rest) for name in names}
    asked = {name: tolerance for name, tolerance in chosen.items() if tolerance is not None}
    if not ticks or not asked:
        raise RecordError(f"Runs {own.run_id} and {others.run_id} have nothing to compare.")
    channels = tuple(_judge_channels(run, other, asked, ticks, begins))
    held = left == others_left and all(channel.held for channel in channels)
    return Verdict(held, ticks, run.tick_count, other.tick_count, channels, not_compared)


def _judge_channels(
    run: Record,
    other: Record,
    asked: Mapping[str, Tolerance],
    ticks: int,
    begins: tuple[int, int],
) -> Iterator[ChannelVerdict]:
    header, first = run.header, run.first_tick + begins[0]
    units = {channel.name: channel.unit for channel in header.channels}
    for name, tolerance in asked.items():
        values = read_channel(run, name, begins[0], ticks)
        reference = read_channel(other, name, begins[1], ticks)
        low, high = build_band(reference, tolerance, round(tolerance.time_s / header.period_s))
        # Unknown in both runs is no difference; unknown in one of them is.
        unknown = np.isnan(values) & np.isnan(reference)
        excesses = np.where(unknown, -np.inf, np.maximum(low - values, values - high))
        for number, lane in enumerate(header.lanes):
            excess = excesses[:, number]
            missing = np.flatnonzero(np.isnan(excess))
            worst = int(missing[0]) if len(missing) else int(np.argmax(excess))
            # Not `excess > 0`, which is false for NaN: a value that only one run has is outside.
            is_outside = ~(excess <= 0.0)
            yield ChannelVerdict(
                lane=lane,
                channel=name,
                unit=units[name],
                held=bool(excess[worst] <= 0.0),
                worst_s=(first + worst) * header.period_s,
                value=float(values[worst, number]),
                low=float(low[worst, number]),
                high=float(high[worst, number]),
                excess=float(excess[worst]),
                outside=tuple(
                    ((first + begin) * header.period_s, (first + end) * header.period_s)
                    for begin, end in _find_segments(is_outside)
                ),
                outside_s=float(is_outside.sum() * header.period_s),
            )


def _find_segments(is_outside: np.ndarray) -> list[tuple[int, int]]:
    """Find first and last tick of each segment; see `ChannelVerdict.outside`."""
    ticks = np.flatnonzero(is_outside)
    if not len(ticks):
        return []
    apart = np.flatnonzero(np.diff(ticks) > max(1, len(is_outside) // MAX_OUTSIDE))
    begins, ends = ticks[[0, *(apart + 1)]], ticks[[*apart, -1]]
    return list(zip(begins.tolist(), ends.tolist(), strict=True))


def read_channel(run: Record, name: str, begin: int, ticks: int) -> np.ndarray:
    """Read samples of a channel from the sample `begin` on, (ticks, lanes)."""
    return run.read_channels([name], begin, begin + ticks)[:, :, 0]


def build_band(
    values: np.ndarray, tolerance: Tolerance, reach: int
) -> tuple[np.ndarray, np.ndarray]:
    """Compute lower and upper bound of the band at each of these values (ticks, …).

    `reach` is the tolerance in time, in samples. The band is NaN if no value within reach is known.
    """
    room = tolerance.absolute + tolerance.relative * np.abs(values)
    low, high = values - room, values + room
    if not reach:
        return low, high
    from scipy.ndimage import (
        maximum_filter1d,
        minimum_filter1d,
    )  # imported here: the import is slow

    is_unknown, size = np.isnan(values), 2 * reach + 1
    low, high = np.where(is_unknown, np.inf, low), np.where(is_unknown, -np.inf, high)
    low = minimum_filter1d(low, size, axis=0, mode="nearest")
    high = maximum_filter1d(high, size, axis=0, mode="nearest")
    return np.where(low <= high, low, np.nan), np.where(low <= high, high, np.nan)
