"""A recorded run compared with others: different settings, and a verdict with tolerances."""

from typing import Annotated

import numpy as np
from fastapi import Body, Query

from svsa.runs.records.decimation import decimate
from svsa.runs.records.difference import compare_settings
from svsa.runs.records.header import RecordError
from svsa.runs.records.measured_window import find_measured_window
from svsa.runs.records.reader import Record
from svsa.runs.records.verdict import FROM_THE_FIRST, Tolerance, build_band, judge, read_channel
from svsa_server.access.owned import Owned
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import REFUSALS, RunId, Runs
from svsa_server.routing import build_router
from svsa_server.schemas.runs.run import RunDifference
from svsa_server.schemas.runs.verdict import Band, RunVerdict, VerdictRequest

router = build_router(tags=["runs"], responses=REFUSALS)
EXAMPLE = {
    "other": "20260102-030405-9f8e7d6c",
    "tolerances": {"position_rad": {"absolute": 0.001}},
    "rest": None,
}


MAX_OTHERS = 7


@router.get("/runs/{run_id}/difference")
@allow(OBSERVER)
def read_difference(
    runs: Runs,
    run_id: RunId,
    other: Annotated[
        list[Annotated[str, Owned("run")]],
        Query(min_length=1, max_length=MAX_OTHERS, description="Ids of the other runs"),
    ],
) -> RunDifference:
    """List the settings that differ between a run and other runs."""
    ids = [run_id, *other]
    differences = compare_settings([runs.open(identifier) for identifier in ids])
    return RunDifference(
        runs=ids,
        titles=[runs.get(identifier).title for identifier in ids],
        differences=differences,
    )


@router.post("/runs/{run_id}/verdict")
@allow(OBSERVER)
def judge_run(
    runs: Runs,
    run_id: RunId,
    comparison: Annotated[VerdictRequest, Body(examples=[EXAMPLE])],
) -> RunVerdict:
    """Compare a run with another within tolerances: verdict and worst time of each channel."""
    run, other = runs.open(run_id), runs.open(comparison.other)
    begins = FROM_THE_FIRST if comparison.align == "start" else _align_windows(run, other)
    verdict = judge(run, other, comparison.tolerances, comparison.rest, begins)
    points = comparison.points
    return RunVerdict(
        **vars(verdict),
        compared_s=verdict.ticks * run.header.period_s,
        begin_s=(run.first_tick + begins[0]) * run.header.period_s,
        other_begin_s=(other.first_tick + begins[1]) * other.header.period_s,
        bands={
            name: _draw_bands(other, name, tolerance, begins[1], verdict.ticks, points)
            for name, tolerance in (comparison.tolerances if points else {}).items()
        },
    )


def _align_windows(run: Record, other: Record) -> tuple[int, int]:
    """Align two runs: their first samples at the same distance from their measured windows."""
    starts: list[int] = []
    for record in (run, other):
        window = find_measured_window(record)
        if window is None:
            text = "has no window to align: align them at the start."
            raise RecordError(f"Run {record.header.run_id} {text}")
        starts.append(window.first_tick - record.first_tick)
    before = min(starts)
    return starts[0] - before, starts[1] - before


def _draw_bands(
    run: Record, channel: str, tolerance: Tolerance, begin: int, ticks: int, points: int
) -> dict[str, Band]:
    """Compute the band about a channel for each lane, decimated without loss of peaks."""
    period = run.header.period_s
    values = read_channel(run, channel, begin, ticks)
    bounds = build_band(values, tolerance, round(tolerance.time_s / period))
    thinned = decimate(np.stack(bounds, axis=-1), points)
    time_s = ((run.first_tick + begin + thinned.rows) * period).tolist()
    return {
        lane: Band(time_s=time_s, low=low, high=high)
        for lane, (low, high) in zip(
            run.header.lanes, thinned.values.transpose(1, 2, 0).tolist(), strict=True
        )
    }
