"""Requests and answers about comparisons of recorded runs."""

from typing import Annotated, Literal

from pydantic import BaseModel, Field

from svsa.inputs.checked import Checked, FiniteOrNull, quantity
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


class Band(BaseModel):
    """The tolerance band of a channel, in the time of the reference run; null: unknown."""

    time_s: list[float]
    low: list[FiniteOrNull]
    high: list[FiniteOrNull]


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
    channels: tuple[ChannelVerdict, ...]
    not_compared: tuple[str, ...] = Field(description="Channels that only one of both runs has")
    bands: dict[str, dict[str, Band]] = Field(description="Verdicts by channel and lane")
