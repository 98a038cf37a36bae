"""Data of recorded runs: samples for a plot, metrics of a segment."""

from typing import Annotated

import msgspec
import numpy as np
from fastapi import Query
from fastapi.responses import Response

from svsa.actuators.signals import CHANNEL_NAMES, PLOTTED
from svsa.errors import ParameterError, Violation
from svsa.runs.metrics.metrics import MEASURED, Metrics, RunningMetrics
from svsa.runs.records.decimation import decimate
from svsa.runs.records.measured_window import trace_record
from svsa.runs.records.reader import Record
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import REFUSALS, RunId, Runs
from svsa_server.routing import build_router
from svsa_server.runs.lanes import build_window
from svsa_server.schemas.runs.run import RunMetrics, RunSamples

MAX_POINTS = 20_000
router = build_router(tags=["runs"], responses=REFUSALS)


RunTime = Annotated[
    float | None, Query(ge=0, allow_inf_nan=False, description="Time of the run, s")
]


@router.get("/runs/{run_id}/samples", response_model=RunSamples)
@allow(OBSERVER)
def read_samples(
    runs: Runs,
    run_id: RunId,
    channels: Annotated[
        str | None,
        Query(
            max_length=4000,
            description="Comma-separated channel names; by default those of the plots",
            examples=["position_rad,torque1_nm"],
        ),
    ] = None,
    start_s: RunTime = None,
    end_s: RunTime = None,
    points: Annotated[
        int, Query(ge=2, le=MAX_POINTS, description="Maximum number of points")
    ] = 2000,
) -> Response:
    """Read a segment of the run for a plot, decimated; minima and maxima are preserved."""
    record = runs.open(run_id)
    names = _choose_channels(record, channels)
    start, stop = _choose_rows(record, start_s, end_s)
    thinned = decimate(record.read_channels(names, start, stop), points)
    ticks = record.first_tick + start + thinned.rows
    answer = {
        "stride": thinned.stride,
        "first_tick": record.first_tick + start,
        "time_s": (ticks * record.header.period_s).tolist(),
        "lanes": {
            lane: {
                channel: thinned.values[:, number, index].tolist()
                for index, channel in enumerate(names)
            }
            for number, lane in enumerate(record.header.lanes)
        },
    }
    return Response(msgspec.json.encode(answer), media_type="application/json")


@router.get("/runs/{run_id}/metrics")
@allow(OBSERVER)
def read_metrics(
    runs: Runs, run_id: RunId, start_s: RunTime = None, end_s: RunTime = None
) -> RunMetrics:
    """Compute the metrics of every lane over a segment of the run, such as from its load on."""
    record = runs.open(run_id)
    start, stop = _choose_rows(record, start_s, end_s)
    measured = record.read_channels(MEASURED, start, stop)
    period, first = record.header.period_s, record.first_tick + start
    timeline = trace_record(record)
    windows = timeline.list_windows(first, first + len(measured)) if timeline else []
    return RunMetrics(
        start_s=first * period,
        end_s=(first + len(measured)) * period,
        windows=[build_window(window, period) for window in windows],
        lanes={
            lane: _measure(measured[:, number], period)
            for number, lane in enumerate(record.header.lanes)
        },
    )


def _measure(values: np.ndarray, period_s: float) -> Metrics | None:
    running = RunningMetrics(period_s)
    running.update_measured(values)
    metrics = running.summarize()
    return metrics if metrics is not None and metrics.is_finite else None


def _choose_channels(record: Record, channels: str | None) -> list[str]:
    there = record.header.channel_names
    if channels is None:
        return [name for name in PLOTTED if name in there] or list(there)
    names = list(dict.fromkeys(name.strip() for name in channels.split(",")))
    for name in names:
        # null where an older record lacks a channel of this version
        if name not in there and name not in CHANNEL_NAMES:
            raise ParameterError(Violation("channels", name, "", f"one of {', '.join(there)}"))
    return names


def _choose_rows(record: Record, start_s: float | None, end_s: float | None) -> tuple[int, int]:
    """Select the rows from start_s to end_s, limited to the record."""
    period, first = record.header.period_s, record.first_tick
    if start_s is not None and end_s is not None and end_s <= start_s:
        raise ParameterError(Violation("end_s", end_s, "s", f"greater than start_s, {start_s:g} s"))
    longest = (first + record.tick_count) * period
    start = 0 if start_s is None else round(min(start_s, longest) / period) - first
    stop = record.tick_count if end_s is None else round(min(end_s, longest) / period) - first
    return max(0, start), max(0, start, stop)
