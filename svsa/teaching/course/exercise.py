"""An exercise as a value: its topic and its ordered steps."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Whole, quantity
from svsa.teaching.course.measure import Measure
from svsa.teaching.course.steps import Experiment, Explain, Predict, Step, SubmitStep
from svsa.teaching.submission import MAX_STEPS, StepName


class Exercise(Checked):
    """The steps of one exercise: predict, experiment, explain, submit.

    Attributes:
        name: Name of its file.
        number: Number in the course.
        title: Title.
        goal: Learning goal.
        minutes: Expected duration, minutes.
        text: Introduction.
        steps: The steps.

    Raises:
        ParameterError: If the steps are inconsistent.
    """

    name: StepName
    number: Whole = quantity("", "Position in the course", ge=1, le=1000)
    title: str = quantity("", "Title", min_length=1, max_length=120)
    goal: str = quantity("", "Learning goal", min_length=1, max_length=400)
    minutes: Whole = quantity("min", "Duration", ge=1, le=600, default=10)
    text: str = quantity("", "Text before its first step, in Markdown", default="")
    steps: Annotated[tuple[Step, ...], Field(min_length=1, max_length=MAX_STEPS)]

    @model_validator(mode="after")
    def _check(self) -> Self:
        ends = [number for number, step in enumerate(self.steps) if isinstance(step, SubmitStep)]
        if ends != [len(self.steps) - 1]:
            bound = "one step of kind submit, at the end"
            raise ParameterError(Violation("steps", [step.kind for step in self.steps], "", bound))
        for number, step in enumerate(self.steps):
            if isinstance(step, Predict):
                self._check_prediction(number, step)
        return self

    def _check_prediction(self, number: int, step: Predict) -> None:
        experiment_name, _, name = step.judged_by.partition(".")
        later = [step for step in self.steps[number + 1 :] if isinstance(step, Experiment)]
        judge = next(
            (experiment for experiment in later if experiment.name == experiment_name), None
        )
        measure = judge.find_measure(name) if judge is not None else None
        if measure is None:
            known = [
                f"{experiment.name}.{two.name}"
                for experiment in later
                for two in experiment.measures
            ]
            bound = f"one of {', '.join(known) or 'those of an experiment after it'}"
            raise ParameterError(Violation(f"steps[{number}].judged_by", step.judged_by, "", bound))
        if measure.shown_unit != step.unit:
            bound = f"{measure.shown_unit!r}, the unit of {step.judged_by}"
            raise ParameterError(Violation(f"steps[{number}].unit", step.unit, "", bound))

    def find_step(self, name: str) -> Step:
        """Return the step of this name.

        Raises:
            ParameterError: If there is none.
        """
        for step in self.steps:
            if step.name == name:
                return step
        bound = f"one of {', '.join(step.name for step in self.steps)}"
        raise ParameterError(Violation("step", name, "", bound))

    def find_judge(self, step: Predict) -> tuple[Experiment, Measure]:
        """Find the experiment and the measure that judge a prediction."""
        experiment_name, _, name = step.judged_by.partition(".")
        judge = self.find_step(experiment_name)
        assert isinstance(judge, Experiment)  # noqa: S101
        measure = judge.find_measure(name)
        assert measure is not None  # noqa: S101
        return judge, measure

    @property
    def takes_law(self) -> bool:
        """Whether a submission of this exercise includes the file of a control law."""
        return any(isinstance(step, SubmitStep) and step.law for step in self.steps)

    @property
    def max_points(self) -> float:
        """The largest possible number of points."""
        points = 0.0
        for step in self.steps:
            if isinstance(step, Experiment):
                points += sum(criterion.points for criterion in step.criteria)
            elif isinstance(step, Predict | Explain):
                points += step.points
        return points
