"""Commands: what may change a run, as values that can be written down and given again.

A command is an object of `tick`, `kind` and `argument` in a record, over REST, and on its way to a
bench alike.
"""

from dataclasses import replace
from typing import Annotated, Any, ClassVar, Literal, Self, get_args

from pydantic import Field

from svsa.actuators.parameters import ActuatorParameters
from svsa.control.gains import Gains
from svsa.control.installed import LawName, ParametersByLaw
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import BY_KIND, Checked, Whole, quantity
from svsa.runs.configuration import Configuration, Lane, LaneSetting
from svsa.runs.run import Run
from svsa.simulation.plant.effects import Effects
from svsa.simulation.plant.loads import Load, ScheduledLoad
from svsa.simulation.reference.trajectories import PositionReference, StiffnessReference


class _Command(Checked):
    """A change of a run at the beginning of a tick.

    label: how its event reads. `apply` does it to a run that has reached the tick, and raises
    `ParameterError` or `StateError` where the run refuses it; `configure` says what becomes of a
    configuration.
    """

    tick: Whole = quantity(
        "", "Tick at whose beginning it holds; a session gives it its own", ge=0, default=0
    )
    kind: Any
    argument: Any
    label: ClassVar[str]

    def __init__(self, /, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ParameterError as error:
            kind = type(self).model_fields["kind"].default
            raise ParameterError(*(_rename(one, kind) for one in error.violations)) from None

    def at(self, tick: int) -> Self:
        """The same command at another tick."""
        return self.model_copy(update={"tick": tick})

    def to_json(self) -> dict[str, Any]:
        """As a dict that JSON can hold; see `read_command`."""
        return self.model_dump(mode="json")

    def configure(self, configuration: Configuration) -> Configuration:
        """The configuration with the field that the command is called after."""
        return configuration.changed(**{self.kind: self.argument})

    def is_held_by(self, configuration: Configuration) -> bool:
        """Whether everything that it sets is so already; raises as `configure`."""
        return self.configure(configuration) == configuration


class SetPosition(_Command):
    """Another position reference, faded over."""

    kind: Literal["position"] = "position"
    argument: PositionReference
    label: ClassVar[str] = "Motion changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_position(self.argument)


class SetStiffness(_Command):
    """Another stiffness reference, faded over."""

    kind: Literal["stiffness"] = "stiffness"
    argument: StiffnessReference
    label: ClassVar[str] = "Stiffness changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_stiffness(self.argument)


class SetLaw(_Command):
    """Another law for the first lane."""

    kind: Literal["law"] = "law"
    argument: LawName
    label: ClassVar[str] = "Law changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_law(self.argument)


class SetLaws(_Command):
    """Other laws for the first lanes, in their order."""

    kind: Literal["laws"] = "laws"
    argument: Annotated[tuple[LawName, ...], Field(min_length=1)]
    label: ClassVar[str] = "Laws changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_laws(self.argument)

    def configure(self, configuration: Configuration) -> Configuration:
        """The configuration with these laws; raises `ParameterError` where lanes are fewer."""
        return configuration.controlled_by(self.argument)


class SetGains(_Command):
    """Other gains."""

    kind: Literal["gains"] = "gains"
    argument: Gains
    label: ClassVar[str] = "Gains changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_gains(self.argument)


class SetParameters(_Command):
    """Other parameters of laws that have their own, by the law's name."""

    kind: Literal["parameters"] = "parameters"
    argument: ParametersByLaw
    label: ClassVar[str] = "Parameters changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_parameters(self.argument)


class SetObserver(_Command):
    """Other bandwidths of the observer."""

    kind: Literal["observer"] = "observer"
    argument: ObserverBandwidth
    label: ClassVar[str] = "Observer changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_observer(self.argument)


class SetActuator(_Command):
    """Another true plant."""

    kind: Literal["actuator"] = "actuator"
    argument: ActuatorParameters
    label: ClassVar[str] = "Plant changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_actuator(self.argument)


class SetNominal(_Command):
    """Another model that controller and observer believe in."""

    kind: Literal["nominal"] = "nominal"
    argument: ActuatorParameters
    label: ClassVar[str] = "Nominal model changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_nominal(self.argument)


class SetEffects(_Command):
    """Other effects."""

    kind: Literal["effects"] = "effects"
    argument: Effects
    label: ClassVar[str] = "Effects changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_effects(self.argument)


class SetComparisons(_Command):
    """Other controllers beside the first, in their order."""

    kind: Literal["comparisons"] = "comparisons"
    argument: tuple[Lane, ...]
    label: ClassVar[str] = "Lanes changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_comparisons(self.argument)


class SetLane(_Command):
    """Another controller of one lane beside the first."""

    kind: Literal["lane"] = "lane"
    argument: LaneSetting
    label: ClassVar[str] = "A lane changed"

    def apply(self, run: Run) -> None:  # noqa: D102
        run.set_lane(self.argument)

    def configure(self, configuration: Configuration) -> Configuration:
        """The configuration with it; raises `ParameterError` where there is no such lane."""
        return configuration.with_lane(self.argument)


class _PassingCommand(_Command):
    """What is no part of the configuration: a load, but for those planned in it, and a stop."""

    def configure(self, configuration: Configuration) -> Configuration:
        """The configuration as it is."""
        return configuration

    def is_held_by(self, configuration: Configuration) -> bool:
        """Never: each one is another load, or another stop."""
        return False


class ApplyLoad(_PassingCommand):
    """A load now, or at its `start_s`; its number in the run is that of its command."""

    kind: Literal["load"] = "load"
    argument: Load
    label: ClassVar[str] = "Load applied"

    def apply(self, run: Run) -> ScheduledLoad:  # noqa: D102
        return run.add_load(self.argument)


class RemoveLoad(_PassingCommand):
    """The load of this number off."""

    kind: Literal["unload"] = "unload"
    argument: Whole
    label: ClassVar[str] = "Load taken off"

    def apply(self, run: Run) -> ScheduledLoad:  # noqa: D102
        return run.remove_load(self.argument)


class Stop(_PassingCommand):
    """A bench's torque goes to zero on a ramp from here on; a simulation knows no such stop."""

    kind: Literal["stop"] = "stop"
    argument: None = None
    label: ClassVar[str] = "Stop"

    def apply(self, run: Run) -> None:
        """Nothing: the bench stops, while its twins go on."""


Command = Annotated[
    SetPosition
    | SetStiffness
    | SetLaw
    | SetLaws
    | SetGains
    | SetParameters
    | SetObserver
    | SetActuator
    | SetNominal
    | SetEffects
    | SetComparisons
    | SetLane
    | ApplyLoad
    | RemoveLoad
    | Stop,
    BY_KIND,
]
COMMANDS: dict[str, type[_Command]] = {
    one.model_fields["kind"].default: one for one in get_args(get_args(Command)[0])
}
"""Every kind of command, by its `kind`."""


def build_command(tick: int, kind: str, argument: Any) -> Command:
    """A checked command; raises `ParameterError` for an unknown kind or a wrong argument."""
    if not isinstance(kind, str) or kind not in COMMANDS:
        raise ParameterError(Violation("kind", kind, "", "one of " + ", ".join(COMMANDS)))
    return COMMANDS[kind](tick=tick, kind=kind, argument=argument)  # pyright: ignore[reportReturnType]


def _rename(violation: Violation, kind: str) -> Violation:
    """What is wrong with a part of the argument has its own name, the whole is called `kind`."""
    name = violation.name.removeprefix("argument.")
    return replace(violation, name=kind if name == "argument" else name)


def read_command(written: Any) -> Command:
    """A command from its `to_json`; raises `ParameterError` for anything else."""
    if not isinstance(written, dict):
        raise ParameterError(Violation("command", written, "", "an object with named fields"))
    given: dict[str, Any] = {"tick": None, "kind": None, "argument": None} | written
    return build_command(given["tick"], given["kind"], given["argument"])
