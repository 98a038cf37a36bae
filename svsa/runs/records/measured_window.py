"""The measured window of a recorded run: one law per lane, without changes."""

import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace

from svsa.errors import SvsaError
from svsa.runs.metrics.metrics import MEASURED, Metrics, RunningMetrics
from svsa.runs.records.reader import Record
from svsa.runs.records.resimulation import read_origin
from svsa.runs.timeline.loads import list_loads
from svsa.runs.timeline.timeline import Timeline, Window, WindowKind, read_timeline


@dataclass(frozen=True)
class MeasuredWindow:
    """Ticks first … end − 1 of a recorded run, within the record.

    Attributes:
        kind: What began the window, as in `Window`.
        label: The same in words.
        is_whole: Whether no command and no onset of a load is in the record.
        lanes: Controller of each lane.
        load_ended: Whether the load that began it ended, so that the error at the end is no
            steady-state error under load.
    """

    kind: WindowKind
    label: str
    first_tick: int
    end_tick: int
    start_s: float
    end_s: float
    is_whole: bool
    lanes: tuple[str, ...]
    load_ended: bool = False


def trace_record(record: Record) -> Timeline | None:
    """Trace the timeline of a recorded run; None if its commands do not determine its lanes."""
    try:
        configuration, commands = read_origin(record)
        ticks = record.first_tick, record.first_tick + record.tick_count
        is_bench = record.header.plant != "simulated"
        timeline = read_timeline(configuration, commands, ticks, is_bench)
    except SvsaError:
        return None
    return timeline if len(timeline.lanes) == len(record.header.lanes) else None


def find_measured_window(record: Record) -> MeasuredWindow | None:
    """Find the window of the last load in the record; without a load, the last window.

    The ramp of a bench to zero torque, which no law commands, is measured only if there is no other
    window. If this version cannot read the commands, the window is the whole record without any
    command, otherwise None. None also for a record without samples.
    """
    if not record.tick_count:
        return None
    timeline = trace_record(record)
    if timeline is None:
        whole = Window("start", "", 0)
        # Without commands the whole record is one window.
        return None if record.commands else _build(record, whole, record.header.lanes)
    first, end = record.first_tick, record.first_tick + record.tick_count
    there = timeline.list_windows(first, end)
    loads = [window for window in there if window.kind == "load" and window.first_tick >= first]
    controlled = [window for window in there if window.kind != "stop"]
    window = (loads or controlled or there)[-1]
    measured = _build(record, window, _name_lanes(timeline, max(first, window.first_tick)))
    ends = [load.end_tick for load in list_loads(*read_origin(record))]
    load_ended = any(measured.first_tick < tick < measured.end_tick for tick in ends)
    return replace(measured, load_ended=window.kind == "load" and load_ended)


def summarize(
    lanes: Iterable[RunningMetrics], window: MeasuredWindow
) -> tuple[Metrics, ...] | None:
    """Compute the metrics of every lane over the window; None for lanes with NaN.

    If the load ended within the window, there is no steady-state error under load.
    """
    measured = tuple(metrics for lane in lanes if (metrics := lane.summarize()) is not None)
    if window.load_ended:
        unknown = {
            "steady_state_position_error_rad": None,
            "steady_state_stiffness_error_nm_per_rad": None,
        }
        measured = tuple(replace(metrics, **unknown) for metrics in measured)
    return measured if all(metrics.is_finite for metrics in measured) else None


def measure(record: Record, window: MeasuredWindow) -> tuple[Metrics, ...] | None:
    """Update the metrics of every lane over the window, slice by slice.

    None without the necessary channels, or if samples are NaN.
    """
    names = record.header.channel_names
    if not set(MEASURED) <= set(names):
        return None
    places = [names.index(name) for name in MEASURED]
    lanes = [RunningMetrics(record.header.period_s) for _ in record.header.lanes]
    for tick, samples in record.iterate():
        rows = samples[max(0, window.first_tick - tick) : max(0, window.end_tick - tick)]
        for lane, running in enumerate(lanes):
            running.update_measured(rows[:, lane, places])
    return summarize(lanes, window)


def write_metrics(record: Record) -> str:
    """Convert the measured window of a record and its metrics to JSON; "null" without a window."""
    window = find_measured_window(record)
    measured = None if window is None else measure(record, window)
    if window is None or measured is None:
        return "null"
    lanes = {
        name: metrics.to_dict() for name, metrics in zip(record.header.lanes, measured, strict=True)
    }
    return json.dumps({"window": asdict(window), "lanes": lanes})


def _build(record: Record, window: Window, lanes: tuple[str, ...]) -> MeasuredWindow:
    begin, end = record.first_tick, record.first_tick + record.tick_count
    first = max(begin, window.first_tick)
    last = end if window.end_tick is None else min(end, window.end_tick)
    period_s = record.header.period_s
    is_whole = window.kind == "start" and (first, last) == (begin, end)
    return MeasuredWindow(
        window.kind, window.label, first, last, first * period_s, last * period_s, is_whole, lanes
    )


def _name_lanes(timeline: Timeline, tick: int) -> tuple[str, ...]:
    """Name the controller of each lane at a tick."""
    lanes = timeline.list_segments()
    names = timeline.name_segments(lanes)
    present = [
        [segment for segment in lane if segment.first_tick <= tick] or lane for lane in lanes
    ]
    return tuple(names[lane[-1].number] for lane in present)
