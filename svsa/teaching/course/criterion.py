"""A criterion of a run: a measure, and the range of its value that earns the points."""

from collections.abc import Sequence
from typing import Annotated, Self

from pydantic import Field, model_validator

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, quantity
from svsa.teaching.submission import StepName

MAX_POINTS = 100
FeedbackText = Annotated[str, Field(max_length=1000)]


class Criterion(Checked):
    """A measure, the range in which it earns its points, and the feedback below and above."""

    title: str = quantity("", "Text of the criterion", min_length=1, max_length=200)
    measure: StepName
    low: Number | None = quantity("", "Minimum value, in its unit", default=None)
    high: Number | None = quantity("", "Maximum value, in its unit", default=None)
    points: Number = quantity("", "Points", gt=0, le=MAX_POINTS, default=1.0)
    right: FeedbackText = quantity("", "Feedback if it is right", default="")
    too_low: FeedbackText = quantity("", "Feedback below the range", default="")
    too_high: FeedbackText = quantity("", "Feedback above the range", default="")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.low is None and self.high is None:
            raise ParameterError(Violation("low", None, "", "given, or else high"))
        if self.low is not None and self.high is not None and self.low > self.high:
            raise ParameterError(Violation("high", self.high, "", f"at least low, {self.low:g}"))
        return self


class CriterionResult(Checked):
    """The result of one criterion of a step.

    Attributes:
        channel: Channel of the step's run that shows the result; None if there is none.
        time_s: Time in the run, s; None if there is none.
    """

    step: str = quantity("", "Step of the criterion")
    name: str = quantity("", "Text of the criterion")
    points: Number = quantity("", "Points", ge=0)
    max_points: Number = quantity("", "Maximum points", ge=0)
    feedback: str = quantity("", "Feedback")
    channel: str | None = quantity("", "Channel that shows the result", default=None)
    time_s: Number | None = quantity("s", "Time in the run that shows the result", default=None)


class Judgement(Checked):
    """The judgement of a submission: all criteria of an exercise, in the order of its steps."""

    exercise: str = quantity("", "Name of the exercise")
    points: Number = quantity("", "Total points", ge=0)
    max_points: Number = quantity("", "Maximum points", ge=0)
    criteria: tuple[CriterionResult, ...] = quantity("", "Points by criterion")


def build_judgement(exercise: str, criteria: Sequence[CriterionResult]) -> Judgement:
    """Build a `Judgement` with the sums of these criteria."""
    return Judgement(
        exercise=exercise,
        points=sum(result.points for result in criteria),
        max_points=sum(result.max_points for result in criteria),
        criteria=tuple(criteria),
    )
