"""Whether a run is another within tolerances: channel by channel, in value and in time."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from svsa.checked import Checked, Number, quantity
from svsa.errors import ParameterError, Violation
from svsa.records.header import RecordError
from svsa.records.reader import Record
from svsa.records.stream import TIME


class Tolerance(Checked):
    """By how much a channel may differ: |a − b| ≤ absolute + relative · |b|.

    b: any value that the other run has within `time_s` of that moment, and all between them.
    """

    absolute: Number = quantity("", "In the unit of the channel", ge=0, default=0.0)
    relative: Number = quantity("1", "As a share of the other run's value", ge=0, default=0.0)
    time_s: Number = quantity("s", "How much earlier or later", ge=0, le=60, default=0.0)


EXACT = Tolerance()


@dataclass(frozen=True)
class ChannelVerdict:
    """How a channel of a lane was judged. worst_s: the moment at which it leaves the band furthest,
    or comes nearest to leaving it; there `value`, and the band from `low` to `high`. excess: how
    far it is outside then, negative inside; NaN where one of both is not known.
    """

    lane: str
    channel: str
    unit: str
    held: bool
    worst_s: float
    value: float
    low: float
    high: float
    excess: float


@dataclass(frozen=True)
class Verdict:
    """A run judged against another. held: every channel, and both are as long. ticks: compared;
    own_ticks, other_ticks: how long they are.
    """

    held: bool
    ticks: int
    own_ticks: int
    other_ticks: int
    channels: tuple[ChannelVerdict, ...]


def judge(
    run: Record, other: Record, tolerances: Mapping[str, Tolerance], rest: Tolerance | None = EXACT
) -> Verdict:
    """Judge a run against another, lane by lane, from the first sample of each.

    tolerances: by channel. rest: of channels that are not among them; None leaves those out. Raises
    `ParameterError` for a channel that is not there, `RecordError` for runs of other lanes or
    periods, and where nothing can be compared.
    """
    own, others = run.header, other.header
    if own.period_s != others.period_s or len(own.lanes) != len(others.lanes):
        raise RecordError(
            f"Runs {own.run_id} and {others.run_id} cannot be compared: {len(own.lanes)} lanes at"
            f" {own.period_s:g} s, and {len(others.lanes)} at {others.period_s:g} s."
        )
    names = [name for name in own.channel_names if name in others.channel_names and name != TIME]
    for name in tolerances:
        if name not in names:
            bound = "a channel of both runs: " + ", ".join(names)
            raise ParameterError(Violation("channel", name, "", bound))
    ticks = min(run.tick_count, other.tick_count)
    chosen = {name: tolerances.get(name, rest) for name in names}
    asked = {name: tolerance for name, tolerance in chosen.items() if tolerance is not None}
    if not ticks or not asked:
        raise RecordError(f"Of runs {own.run_id} and {others.run_id} there is nothing to compare.")
    channels = tuple(_judge_channels(run, other, asked, ticks))
    is_as_long = run.tick_count == other.tick_count
    held = is_as_long and all(one.held for one in channels)
    return Verdict(held, ticks, run.tick_count, other.tick_count, channels)


def _judge_channels(
    run: Record, other: Record, asked: Mapping[str, Tolerance], ticks: int
) -> Iterator[ChannelVerdict]:
    header = run.header
    units = {channel.name: channel.unit for channel in header.channels}
    for name, tolerance in asked.items():
        values, wanted = (one.read_channels([name], 0, ticks)[:, :, 0] for one in (run, other))
        reach = round(tolerance.time_s / header.period_s)
        for number, lane in enumerate(header.lanes):
            value = values[:, number]
            low, high = build_band(wanted[:, number], tolerance, reach)
            excess = np.maximum(low - value, value - high)
            is_same = np.isnan(value) & np.isnan(wanted[:, number])
            excess = np.where(is_same, -np.inf, excess)
            missing = np.flatnonzero(np.isnan(excess))
            worst = int(missing[0]) if len(missing) else int(np.argmax(excess))
            yield ChannelVerdict(
                lane=lane,
                channel=name,
                unit=units[name],
                held=bool(excess[worst] <= 0.0),
                worst_s=(run.first_tick + worst) * header.period_s,
                value=float(value[worst]),
                low=float(low[worst]),
                high=float(high[worst]),
                excess=float(excess[worst]),
            )


def build_band(values: np.ndarray, tolerance: Tolerance, reach: int) -> tuple[np.ndarray, ...]:
    """Least and greatest value that a run may have beside one of these. reach: in samples."""
    room = tolerance.absolute + tolerance.relative * np.abs(values)
    low, high = values - room, values + room
    if not reach:
        return low, high
    size = 2 * reach + 1
    return (
        minimum_filter1d(low, size, mode="nearest"),
        maximum_filter1d(high, size, mode="nearest"),
    )
