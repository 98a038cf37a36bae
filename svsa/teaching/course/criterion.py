"""What a run is judged by: a measure of it, and the range in which it has the points."""

from typing import Annotated, Self

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
