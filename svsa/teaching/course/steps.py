"""The steps of an exercise: read, predict, experiment, explain and submit."""

from typing import Annotated, Literal, Self

from pydantic import model_validator

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import BY_KIND, Checked, Flag, Number, quantity
from svsa.teaching.course.criterion import MAX_POINTS, Criterion, FeedbackText
from svsa.teaching.course.measure import Measure, read_number
from svsa.teaching.course.on_bench import check_for_bench
from svsa.teaching.course.setup import Setup
from svsa.teaching.submission import StepName


class _Step(Checked):
    """A step: its name, its title, and its text in Markdown with equations."""

    name: StepName
    title: str = quantity("", "Title", min_length=1, max_length=120)
    text: str = quantity("", "Text, from the body of the file", min_length=1)


class Read(_Step):
    """A step of text only."""

    kind: Literal["read"] = "read"


class Predict(_Step):
    """A number to be predicted before the run with which it is compared.

    Attributes:
        judged_by: Step and measure of that run, such as `fl.steady`.
        within: Maximum deviation for full points, as a share of the measured value.
        half_within: Maximum deviation for half of the points.
        by_factor: Whether the deviation is the ratio of the larger to the smaller value minus 1, so
            that 9 is an order of magnitude.
    """

    kind: Literal["predict"] = "predict"
    asks: str = quantity("", "Name of the predicted value", min_length=1, max_length=200)
    unit: str = quantity("", "Unit", max_length=20)
    low: Number = quantity("", "Least plausible value")
    high: Number = quantity("", "Greatest plausible value")
    judged_by: str = quantity(
        "", "STEP.MEASURE with which it is compared", pattern=r"^[a-z0-9-]+\.[a-z0-9-]+$"
    )
    within: Number = quantity("1", "Deviation for full points", gt=0, le=1000, default=0.1)
    half_within: Number = quantity("1", "Deviation for half points", gt=0, le=1000, default=0.5)
    by_factor: Flag = quantity("", "Whether the deviation is a ratio", default=False)
    points: Number = quantity("", "Points", gt=0, le=MAX_POINTS, default=2.0)
    feedback: FeedbackText = quantity("", "Explanation, shown with the assessment", default="")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if not self.low < self.high:
            bound = f"greater than low, {self.low:g}"
            raise ParameterError(Violation("high", self.high, self.unit, bound))
        if not self.within <= self.half_within:
            bound = f"at least within, {self.within:g}"
            raise ParameterError(Violation("half_within", self.half_within, "", bound))
        return self


class Experiment(_Step, Setup):
    """A run with a setup, its measures and its criteria."""

    kind: Literal["experiment"] = "experiment"
    measures: tuple[Measure, ...] = quantity("", "Measures", min_length=1, max_length=20)
    criteria: tuple[Criterion, ...] = quantity("", "Criteria", default=(), max_length=20)

    @model_validator(mode="after")
    def _check_measures(self) -> Self:
        names = [measure.name for measure in self.measures]
        for number, measure in enumerate(self.measures):
            where = f"measures[{number}]"
            if measure.name in names[:number]:
                raise ParameterError(Violation(f"{where}.name", measure.name, "", "given once"))
            if measure.per is not None and measure.per not in names[:number]:
                bound = "the name of a measure earlier in the list"
                raise ParameterError(Violation(f"{where}.per", measure.per, "", bound))
            if measure.lane > len(self.configuration.lanes) and "comparisons" not in self.free:
                bound = f"1 to {len(self.configuration.lanes)}, of the lanes that run"
                raise ParameterError(Violation(f"{where}.lane", measure.lane, "", bound))
            if measure.tip_direction_rad is not None and not self._is_tip(measure.lane):
                bound = "omitted, unless the run is of an arm and `lane` is joint 1"
                direction_rad = measure.tip_direction_rad
                raise ParameterError(
                    Violation(f"{where}.tip_direction_rad", direction_rad, "rad", bound)
                )
            if measure.to_s is not None and measure.to_s > self.duration_s:
                bound = f"at most duration_s, {self.duration_s:g} s"
                raise ParameterError(Violation(f"{where}.to_s", measure.to_s, "s", bound))
            if measure.setting:
                try:
                    read_number(self.configuration, measure.setting)
                except ParameterError as error:
                    raise error.within(where) from None
        self._check_criteria("criteria", self.criteria)
        if self.bench is not None:
            loads = self.bench_configuration.loads
            check_for_bench(self.base, self.comparisons, self.free, loads, self.measures)
            self._check_bench(self.bench.criteria, bool(loads) and not self.bench.by_hand)
        return self

    def _is_tip(self, lane: int) -> bool:
        return (
            self.configuration.arm is not None and (lane - 1) % len(self.configuration.joints) == 0
        )

    def _check_criteria(self, where: str, criteria: tuple[Criterion, ...]) -> None:
        names = [measure.name for measure in self.measures]
        for number, criterion in enumerate(criteria):
            if criterion.measure not in names:
                bound = f"one of {', '.join(names)}"
                name = f"{where}[{number}].measure"
                raise ParameterError(Violation(name, criterion.measure, "", bound))

    def _check_bench(self, criteria: tuple[Criterion, ...] | None, is_silent: bool) -> None:
        if is_silent:
            bound = "an instruction for the user at the bench, who adds the loads"
            raise ParameterError(Violation("bench.by_hand", "", "", bound))
        if criteria is None:
            return
        self._check_criteria("bench.criteria", criteria)
        points, simulated_points = (
            sum(criterion.points for criterion in each) for each in (criteria, self.criteria)
        )
        if points != simulated_points:
            bound = f"with {simulated_points:g} points in all, as in the simulation"
            raise ParameterError(Violation("bench.criteria", points, "", bound))

    def list_criteria(self, is_bench: bool) -> tuple[Criterion, ...]:
        """List the criteria of a run on a bench or of a simulated run."""
        own = self.bench.criteria if is_bench and self.bench is not None else None
        return self.criteria if own is None else own

    def find_measure(self, name: str) -> Measure | None:
        """Return the measure of this name."""
        return next((measure for measure in self.measures if measure.name == name), None)


class Option(Checked):
    """An answer that can be selected, with its feedback."""

    name: StepName
    text: str = quantity("", "The answer", min_length=1, max_length=500)
    right: Flag = quantity("", "Whether it is right", default=False)
    feedback: FeedbackText = quantity("", "Feedback if it was chosen", default="")


class Explain(_Step):
    """A multiple-choice question about the run; one option is correct."""

    kind: Literal["explain"] = "explain"
    options: tuple[Option, ...] = quantity("", "The answers", min_length=2, max_length=8)
    points: Number = quantity("", "Points", gt=0, le=MAX_POINTS, default=1.0)

    @model_validator(mode="after")
    def _check(self) -> Self:
        names = [option.name for option in self.options]
        if len(set(names)) < len(names):
            raise ParameterError(Violation("options", names, "", "of different names"))
        if sum(option.right for option in self.options) != 1:
            right = [option.name for option in self.options if option.right]
            raise ParameterError(Violation("options", right, "", "so that exactly one is right"))
        return self


class SubmitStep(_Step):
    """The last step: submit the exercise; `law` is whether a law's Python file is included."""

    kind: Literal["submit"] = "submit"
    law: Flag = quantity("", "Whether it includes the file of a law", default=False)


Step = Annotated[Read | Predict | Experiment | Explain | SubmitStep, BY_KIND]
