"""Requests and answers about comparisons of recorded runs."""

import math
from dataclasses import asdict
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import BaseModel, Field

from svsa.inputs.checked import Checked, quantity
from svsa.runs.records.verdict import EXACT, ChannelVerdict, Tolerance
from svsa_server.access.owned import Owned

MAX_TOLERANCES = 100
MAX_POINTS = 20_000


class VerdictRequest(Checked):
    """The reference run of a comparison, and the tolerance of each channel."""

    other: Annotated[str, Owned("run")] = quantity(
        "", "Id of the reference run", min_length=1, max_length=200
    )
    tolerances: dict[str, Tolerance] = quantity(
        "", "By channel", default_factory=dict, max_length=MAX_TOLERANCES
    )
    rest: Tolerance | None = quantity(
        "", "Tolerance of every other channel; null: not judged", default=EXACT
    )
    align: Literal["start", "window"] = quantity(
        "",
        "Alignment: the first samples, or the starts of the measured windows, such as the last "
        "load",
        default="start",
    )
    points: Annotated[int, Field(ge=0, le=MAX_POINTS)] = quantity(
        "", "Maximum number of points of each bound of a band; 0: no bands", default=0
    )


class ChannelJudged(BaseModel):
    """The verdict of a channel of a lane; times are those of the run under test."""

    lane: str
    channel: str
    unit: str
    held: bool
    worst_s: float = Field(description="Time of the largest deviation from the band")
    value: float | None = Field(description="Value at that time; null if not finite")
    low: float | None
    high: float | None
    excess: float | None = Field(
        description="Distance outside the band at that time, negative inside; null if unknown"
    )
    outside: list[tuple[float, float]] = Field(
        description="Time segments outside the band; neighbouring ones are merged"
    )
    outside_s: float = Field(description="Total time outside the band")


class Band(BaseModel):
    """The tolerance band of a channel, in the time of the reference run; null: unknown."""

    time_s: list[float]
    low: list[float | None]
    high: list[float | None]

    @classmethod
    def build(cls, time_s: list[float], bounds: np.ndarray) -> Self:
        """Build the band; `bounds` are lower and upper, (times, 2)."""
        low, high = (
            [_replace_nonfinite(value) for value in column] for column in bounds.T.tolist()
        )
        return cls(time_s=time_s, low=low, high=high)


class RunVerdict(BaseModel):
    """A run compared with a reference run.

    held: every channel is within tolerance, and both runs have the same length.
    """

    held: bool
    ticks: int = Field(description="Number of ticks compared")
    compared_s: float = Field(description="The same as a time")
    own_ticks: int
    other_ticks: int
    begin_s: float = Field(description="Time of the first sample compared")
    other_begin_s: float = Field(description="The same of the other run")
    channels: list[ChannelJudged]
    not_compared: list[str] = Field(description="Channels that only one of both runs has")
    bands: dict[str, dict[str, Band]] = Field(description="Verdicts by channel and lane")


def build_channel_state(verdict: ChannelVerdict) -> ChannelJudged:
    """Build the answer for a channel's verdict."""
    numbers = ("value", "low", "high", "excess")
    fields: dict[str, Any] = asdict(verdict) | {
        name: _replace_nonfinite(getattr(verdict, name)) for name in numbers
    }
    return ChannelJudged(**fields)


def _replace_nonfinite(value: float) -> float | None:
    """Return a value for JSON: None in place of infinity or NaN."""
    return value if math.isfinite(value) else None
