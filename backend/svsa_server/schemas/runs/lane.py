"""Answers about lanes: their controllers over time, and their metrics."""

from pydantic import BaseModel, Field

from svsa.runs.metrics.metrics import Metrics
from svsa.runs.timeline.timeline import WindowKind


class Period(BaseModel):
    """A part of a run, from start to before end."""

    start_tick: int
    start_s: float
    end_tick: int | None = Field(description="Null: until now")
    end_s: float | None


class SegmentState(Period):
    """A controller (a law with its gains and observer) on a lane, from start to before end."""

    number: int = Field(description="Number of the controller, in order of appearance in the run")
    name: str = Field(
        description="Law, with the parameters that distinguish it from others of the same law"
    )
    line_style: int = Field(description="Line style of its curves, from 0; unique on screen")
    has_estimate: bool = Field(
        description="Whether its law uses an estimate of the disturbance; true if unknown"
    )


class WindowState(Period):
    """A part of the run without changes, from start to before end."""

    kind: WindowKind = Field(description="Kind of the event that started the window")
    label: str = Field(description="Event that started the window; empty for the start of the run")


class EndedWindowState(WindowState):
    """An ended window, and the metrics of the lanes in it."""

    lanes: list[Metrics | None] = Field(
        description="Metrics of the current lanes, in order; null for a lane that did not exist"
    )


class LaneState(BaseModel):
    """A lane; lane 1 is the session's own controller.

    Metrics are null if the lane did not exist at the beginning of the window, and half a second
    after it ended (a twin of a bench that left the domain of the model).
    """

    since_start: Metrics | None = Field(description="Metrics of the whole run, including changes")
    in_window: Metrics | None = Field(description="Metrics of `window`, since the last change")
    since_load: Metrics | None = Field(
        description="Metrics of `load_window`: of the current controller, on its lane at the onset"
        " of the load; its recovery time is that after the load"
    )
    lane: int
    joint: int | None = Field(description="Joint of an arm; null for a single joint")
    id: int = Field(
        description="Unique during the run: a lane keeps its id if lanes before it are removed, and"
        " no lane gets the id of a removed one"
    )
    law: str
    name: str = Field(description="Name of its current controller")
    segments: list[SegmentState] = Field(
        description="Its controllers in the last 60 s, the current one last"
    )
