"""The setup of an experiment, and the comparison of a run with it."""

from collections.abc import Sequence
from functools import cached_property
from typing import Any, Literal, NamedTuple, Self

from pydantic import model_validator

from svsa.control.installed import PAPERS_LAW, InstalledLaw
from svsa.evaluation.studies.study import FIGURE, build_base
from svsa.inputs.checked import Checked, Number, quantity
from svsa.runs.command import ApplyLoad, Command, RemoveLoad, Stop, fold
from svsa.runs.configuration import MAX_LANES, Configuration, Lane
from svsa.runs.result.result import Result
from svsa.teaching.course.on_bench import SET_ON_BENCH, OnBench

LONGEST_S = 60.0
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
_FIELDS: dict[str, str] = {"laws": "law", "lane": "comparisons", "load": "loads", "unload": "loads"}
"""The field of a configuration that a kind of command changes, where it is called otherwise."""


class Difference(NamedTuple):
    """How a run differs from the required one; time_s: since when, or None."""

    message: str
    time_s: float | None = None


class Setup(Checked):
    """The configuration that a run starts from: a figure, and settings that replace its own.

    free: what the student may choose before the run. bench: how it is run on a bench; None for one
    that is simulated and nothing else.
    """

    base: dict[str, Any] = quantity("", "Settings of the run", default={FIGURE: "4a"})
    law: InstalledLaw = quantity("", "Law of lane 1", default=PAPERS_LAW)
    comparisons: tuple[InstalledLaw, ...] = quantity(
        "", "Laws of the comparison lanes", default=(), max_length=MAX_LANES - 1
    )
    duration_s: Number = quantity("s", "How long the run is", gt=0, le=LONGEST_S, default=20.0)
    free: tuple[Free, ...] = quantity("", "What the student may choose", default=())
    bench: OnBench | None = quantity("", "How it is run on a bench", default=None)

    @model_validator(mode="after")
    def _check_base(self) -> Self:
        _ = self.configuration
        return self

    @cached_property
    def configuration(self) -> Configuration:
        """The required run, with the free fields at their start values."""
        comparisons = tuple(Lane(law=law) for law in self.comparisons)
        return build_base(self.base, self.law).changed(comparisons=comparisons)

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
        wanted = self.bench_configuration if is_bench else self.configuration
        begun = _give_first(result.configuration, result.commands)
        for field in SET_ON_BENCH if is_bench else _COMPARED:
            if field in self.free:
                continue
            asked, had = getattr(wanted, field), getattr(begun, field)
            if asked != had:
                return Difference(f"{field} was not as the step sets it ({_tell(asked, had)})", 0.0)
        return self._find_change(result)

    def _find_change(self, result: Result) -> Difference | None:
        """Find a change made during the run; stopping a bench at the end of its time is allowed."""
        for command in result.commands:
            time_s = command.tick * result.configuration.sampling.period_s
            if isinstance(command, Stop):
                if time_s < self.duration_s:
                    reported = f"the bench was stopped at {time_s:.3g} s, before its end"
                    return Difference(reported, time_s)
            elif command.tick > 0:
                field = _FIELDS.get(command.kind, command.kind)
                return Difference(f"{field} was changed at {time_s:.3g} s, during the run", time_s)
        return None


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
            kept = list(configuration.loads)
            del kept[command.argument - 1]
            configuration = configuration.changed(loads=tuple(kept))
    return configuration


def _tell(asked: Any, had: Any) -> str:
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
