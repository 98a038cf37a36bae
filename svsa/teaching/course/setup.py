"""The setup of an experiment, and the comparison of a run with it."""

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any, Literal, NamedTuple, Self

from pydantic import model_validator

from svsa.control.installed import PAPERS_LAW, InstalledLaw
from svsa.errors import ParameterError
from svsa.evaluation.studies.setting import change_settings
from svsa.evaluation.studies.study import FIGURE, build_base
from svsa.inputs.checked import Checked, Number, quantity
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.definition.command import ApplyLoad, Command, RemoveLoad, Stop, fold
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import MAX_LANES, Lane
from svsa.runs.result.result import Result
from svsa.teaching.course.on_bench import SET_ON_BENCH, OnBench

LONGEST_S = 60.0
ARM = "arm"
"""Path of a base that is the name of an arm; the run is then one of an arm, not of a figure."""
Free = Literal[
    "law", "comparisons", "gains", "parameters", "observer", "stiffness", "position", "effects"
]
_COMPARED = (
    "law",
    "comparisons",
    "effects",
    "position",
    "stiffness",
    "loads",
    "gains",
    "parameters",
    "observer",
    "actuator",
    "nominal",
    "limits",
    "sampling",
)
_COMPARED_OF_ARM = ("links", "model", "feedforward", "adaptation", "tip")
_FIELDS: dict[str, str] = {"laws": "law", "lane": "comparisons", "load": "loads", "unload": "loads"}
"""Field of a configuration that a kind of command changes, if its name differs."""


class Difference(NamedTuple):
    """A difference of a run from the required one; `time_s` is its beginning, or None."""

    message: str
    time_s: float | None = None


class Setup(Checked):
    """The configuration that a run starts from: a figure, and changed settings.

    Attributes:
        free: Settings that the student may choose before the run.
        bench: Differences on a bench; None for an experiment that can only be simulated.
    """

    base: dict[str, Any] = quantity("", "Settings of the run", default={FIGURE: "4a"})
    law: InstalledLaw = quantity("", "Law of lane 1", default=PAPERS_LAW)
    comparisons: tuple[InstalledLaw, ...] = quantity(
        "", "Laws of the comparison lanes", default=(), max_length=MAX_LANES - 1
    )
    duration_s: Number = quantity("s", "Duration of the run", gt=0, le=LONGEST_S, default=20.0)
    free: tuple[Free, ...] = quantity("", "Settings that the student may choose", default=())
    bench: OnBench | None = quantity("", "Setup on a bench", default=None)

    @model_validator(mode="after")
    def _check_base(self) -> Self:
        _ = self.configuration
        return self

    @property
    def arm(self) -> str:
        """Name of the arm; "" for a single joint."""
        return str(self.base.get(ARM, ""))

    @cached_property
    def configuration(self) -> Configuration:
        """The required run, with the free fields at their start values."""
        comparisons = tuple(Lane(law=law) for law in self.comparisons)
        if not self.arm:
            return build_base(self.base, self.law).changed(comparisons=comparisons)
        settings = {path: value for path, value in self.base.items() if path != ARM}
        both = {"law": self.law, "comparisons": comparisons}
        try:
            return change_settings(build_arm_experiment(self.arm, {}, both), settings)
        except ParameterError as error:
            raise error.within("base") from None

    @property
    def bench_configuration(self) -> Configuration:
        """The required run on a bench, which has its own plant, effects and limits."""
        loads = self.bench.loads if self.bench is not None else None
        asked = self.configuration
        return asked if loads is None else asked.changed(loads=loads)

    def find_difference(self, result: Result) -> Difference | None:
        """Find how a run differs from the required one in fields that are not free; None if not."""
        is_bench = result.plant != "simulated"
        if is_bench and self.bench is None:
            return Difference("it was recorded on a bench, and this step is simulated")
        expected = self.bench_configuration if is_bench else self.configuration
        begun = _give_first(result.configuration, result.commands)
        if (expected.arm is None) != (begun.arm is None):
            kind = "a single joint" if begun.arm is None else "an arm"
            return Difference(f"it is a run of {kind}")
        fields = [
            field for field in (SET_ON_BENCH if is_bench else _COMPARED) if field not in self.free
        ]
        for field, asked, had in _list_compared(expected, begun, fields):
            if asked != had:
                return Difference(
                    f"{field} was not as the step sets it ({_describe_difference(asked, had)})", 0.0
                )
        return self._find_change(result)

    def _find_change(self, result: Result) -> Difference | None:
        """Find a change made during the run; stopping a bench at the end of its time is allowed."""
        for command in result.commands:
            time_s = command.tick * result.configuration.sampling.period_s
            if isinstance(command, Stop):
                if time_s < self.duration_s:
                    message = f"the bench was stopped at {time_s:.3g} s, before its end"
                    return Difference(message, time_s)
            elif command.tick > 0:
                field = _FIELDS.get(command.kind, command.kind)
                return Difference(f"{field} was changed at {time_s:.3g} s, during the run", time_s)
        return None


def _list_compared(
    expected: Configuration, begun: Configuration, fields: Sequence[str]
) -> Iterator[tuple[str, Any, Any]]:
    """Yield name, wanted and actual value of the fields of each joint, and of those of an arm."""
    for number, (asked, had) in enumerate(zip(expected.joints, begun.joints, strict=True), start=1):
        for field in fields:
            name = field if number == 1 else f"{field} of joint {number}"
            yield name, getattr(asked, field), getattr(had, field)
    for field in _COMPARED_OF_ARM if expected.arm is not None else ():
        yield f"arm.{field}", getattr(expected.arm, field), getattr(begun.arm, field)


def _give_first(configuration: Configuration, commands: Sequence[Command]) -> Configuration:
    """Apply the commands that were given before the first sample."""
    for command in commands:
        if command.tick > 0:
            break
        configuration = fold(configuration, command)
        if isinstance(command, ApplyLoad):
            loads = (*configuration.loads, command.argument)
            configuration = configuration.changed(loads=loads)
        elif isinstance(command, RemoveLoad):
            configuration = _remove_load(configuration, command.argument - 1)
    return configuration


def _remove_load(configuration: Configuration, index: int) -> Configuration:
    """Remove a planned load; those of each joint of an arm follow those of the joint before."""
    changes: list[dict[str, Any]] = []
    for joint in configuration.joints:
        loads = joint.loads
        is_here = 0 <= index < len(loads)
        changes.append({"loads": (*loads[:index], *loads[index + 1 :])} if is_here else {})
        index -= len(loads)
    return configuration.change_joints(changes)


def _describe_difference(asked: Any, had: Any) -> str:
    """Describe the first field that differs, if the values have fields."""
    if isinstance(asked, Checked) and isinstance(had, Checked):
        if type(asked) is not type(had):
            return "another kind"
        for name in type(asked).model_fields:
            if getattr(asked, name) != getattr(had, name):
                return f"{name} is {getattr(had, name)!r}, asked {getattr(asked, name)!r}"[:200]
    if isinstance(asked, str):
        return f"it is {had!r}, asked {asked!r}"
    return "it differs"
