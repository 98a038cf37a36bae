"""What a judgement is: points by criterion, what differs, and where in the run to look."""

from typing import NamedTuple


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
