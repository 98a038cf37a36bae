"""The lanes of a session or a recorded run on every page, in 3D and in a replay: who controlled
them, from when on, under which name and in which line style.
"""

from collections.abc import Sequence
from typing import Any

from svsa.control.installed import get_law, list_law_names
from svsa.runs.records.reader import Record
from svsa.runs.session.journal import KEPT_S
from svsa.runs.session.session import Session
from svsa.runs.timeline.timeline import Segment, Timeline, Window
from svsa_server.schemas.runs.lane import EndedWindowState, SegmentState, WindowState

MAX_STRETCHES = 200


def list_kept_segments(session: Session) -> list[list[Segment]]:
    """Return each lane's segments of the last `KEPT_S`; the last one is present."""
    first_tick = session.run.tick - KEPT_S / session.run.period_s
    return session.journal.timeline.list_segments(first_tick, MAX_STRETCHES)


def list_session_segments(session: Session, since_tick: int = 0) -> list[list[SegmentState]]:
    """List the segments of the last `KEPT_S` that are present or ended at since_tick or later."""
    kept = list_kept_segments(session)
    return _build(session.journal.timeline, kept, session.run.period_s, since_tick)


def list_record_segments(record: Record, timeline: Timeline | None) -> list[list[SegmentState]]:
    """List each lane's segments in the record; without a timeline, one with the lane's name."""
    period_s = record.header.period_s
    if timeline is not None:
        return _build(timeline, timeline.list_segments(), period_s)
    whole = {"start_tick": 0, "start_s": 0.0, "end_tick": None, "end_s": None}
    return [
        [SegmentState(number=lane + 1, name=name, line_style=lane, has_estimate=True, **whole)]
        for lane, name in enumerate(record.header.lanes)
    ]


def _has_estimate(law: str) -> bool:
    return law not in list_law_names() or get_law(law).estimate != "none"


def name_lanes(segments: Sequence[Sequence[SegmentState]]) -> list[str]:
    """Name each lane over the run: NDOBC → FL if its controller changed."""
    return [" → ".join(dict.fromkeys(segment.name for segment in lane)) for lane in segments]


def build_window(window: Window, period_s: float) -> WindowState:
    """Build the description of a measured window, with its ticks and times."""
    return WindowState(**_describe_window(window, period_s))


def _describe_window(window: Window, period_s: float) -> dict[str, Any]:
    end = window.end_tick
    return {
        "kind": window.kind,
        "label": window.label,
        "start_tick": window.first_tick,
        "start_s": window.first_tick * period_s,
        "end_tick": end,
        "end_s": None if end is None else end * period_s,
    }


def list_ended_windows(session: Session, since_tick: int = 0) -> list[EndedWindowState]:
    """List the ended windows of the last `KEPT_S`, each with its metrics.

    Only those that ended at `since_tick` or later.
    """
    journal, period_s = session.journal, session.run.period_s
    ended = {window.first_tick: window.lanes for window in journal.metrics.ended}
    first_tick = max(0, session.run.tick - round(KEPT_S / period_s))
    windows = journal.timeline.list_windows(first_tick, session.run.tick + 1)
    return [
        EndedWindowState(**_describe_window(window, period_s), lanes=ended[window.first_tick])
        for window in windows
        if window.end_tick is not None
        and window.end_tick >= since_tick
        and window.first_tick in ended
    ]


def _build(
    timeline: Timeline, lanes: Sequence[Sequence[Segment]], period_s: float, since_tick: int = 0
) -> list[list[SegmentState]]:
    names = timeline.name_segments(lanes)
    return [
        [
            SegmentState(
                number=segment.number,
                name=names[segment.number],
                line_style=segment.line_style,
                has_estimate=_has_estimate(segment.controller.law),
                start_tick=segment.first_tick,
                start_s=segment.first_tick * period_s,
                end_tick=segment.end_tick,
                end_s=None if segment.end_tick is None else segment.end_tick * period_s,
            )
            for segment in lane
            if segment.end_tick is None or segment.end_tick >= since_tick
        ]
        for lane in lanes
    ]
