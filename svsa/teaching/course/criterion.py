"""A criterion of a run: a measure, the range that earns its points, and the judgement by it."""

from typing import Annotated, NamedTuple, Self

from pydantic import Field, model_validator

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, quantity
from svsa.teaching.course.submission import StepName

MAX_POINTS = 100
FeedbackText = Annotated[str, Field(max_length=1000)]


class Criterion(Checked):
    """A measure and the range in which it has the points, with what is told beyond each end."""

    title: str = quantity("", "What is asked", min_length=1, max_length=200)
    measure: StepName
    low: Number | None = quantity("", "Least value, in its unit", default=None)
    high: Number | None = quantity("", "Greatest value, in its unit", default=None)
    points: Number = quantity("", "Points", gt=0, le=MAX_POINTS, default=1.0)
    right: FeedbackText = quantity("", "Told where it is right", default="")
    too_low: FeedbackText = quantity("", "Told below", default="")
    too_high: FeedbackText = quantity("", "Told above", default="")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.low is None and self.high is None:
            raise ParameterError(Violation("low", None, "", "given, or else high"))
        if self.low is not None and self.high is not None and self.low > self.high:
            raise ParameterError(Violation("high", self.high, "", f"at least low, {self.low:g}"))
        return self


class CriterionResult(NamedTuple):
    """One criterion of a step.

    name: what is asked. feedback: what differs, or that it is right. channel, time_s: where in
    the step's run to look, in the run's time, s; None where it is about no sample.
    """

    step: str
    name: str
    points: float
    max_points: float
    feedback: str
    channel: str | None = None
    time_s: float | None = None


class Judgement(NamedTuple):
    """All criteria of an exercise, in the order of its steps."""

    exercise: str
    criteria: tuple[CriterionResult, ...]

    @property
    def points(self) -> float:
        """Points in all."""
        return sum(one.points for one in self.criteria)

    @property
    def max_points(self) -> float:
        """Points that there are."""
        return sum(one.max_points for one in self.criteria)
