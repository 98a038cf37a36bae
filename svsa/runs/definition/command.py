"""Commands: changes of a run, as values that can be stored and repeated.

A change of a setting is one command, `Set(field, value)`, and only `fold` defines its effect on a
configuration: for a run, its timeline, its record and a script that repeats it. In a record, in
REST, and in messages to a bench a command is an object of `tick`, `kind` (for a `Set` its field)
and `argument` (its value), for an arm also `joint`.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Annotated, Any, Literal, Self, TypeAlias, get_args

from pydantic import BaseModel, Field, ValidationError, create_model

from svsa.control.installed import LawName
from svsa.errors import ParameterError, StateError, Violation
from svsa.inputs.checked import BY_KIND, Checked, Whole, quantity
from svsa.inputs.explanation import explain
from svsa.runs.definition.configuration import MAX_JOINTS, ArmSetup, Configuration
from svsa.runs.definition.design import Lane, LaneSetting
from svsa.simulation.plant.loads import Load

Settable = Literal[
    "position",
    "stiffness",
    "law",
    "laws",
    "gains",
    "parameters",
    "observer",
    "spring",
    "actuator",
    "nominal",
    "effects",
    "comparisons",
    "lane",
    "feedforward",
    "adaptation",
]
"""The fields of a `Configuration` that a run may change; `laws` sets the laws of the first lanes in
order, and `lane` one of the comparisons, whose plant keeps its state. The last two are those of an
arm.
"""
OF_ARM = ("feedforward", "adaptation")
NO_ARM = "This run is of a single joint: joint 2, loads at the tip and feedforward need an arm."

COMMANDS: dict[str, str] = {
    "position": "Motion changed",
    "stiffness": "Stiffness changed",
    "law": "Law changed",
    "laws": "Laws changed",
    "gains": "Gains changed",
    "parameters": "Parameters changed",
    "observer": "Observer changed",
    "spring": "Spring estimator changed",
    "actuator": "Plant changed",
    "nominal": "Nominal model changed",
    "effects": "Effects changed",
    "comparisons": "Lanes changed",
    "lane": "A lane changed",
    "feedforward": "Arm feedforward changed",
    "adaptation": "Adaptive payload changed",
    "load": "Load applied",
    "unload": "Load removed",
    "stop": "Stop",
}
"""Every kind of command, and the label of its event."""


_OF_LANES: dict[str, Any] = {
    "laws": Annotated[tuple[LawName, ...], Field(min_length=1)],
    "lane": LaneSetting,
}


def _build_value(field: str) -> type[BaseModel]:
    """Build a model with a settable field as its only `argument`."""
    known = (ArmSetup if field in OF_ARM else Configuration).model_fields.get(field)
    value: Any = (_OF_LANES[field], ...) if known is None else (known.annotation, known)
    return create_model(field, argument=value)


_VALUES = {field: _build_value(field) for field in get_args(Settable)}


JointNumber: TypeAlias = int
"""From 1 to the number of joints."""


class _Command(Checked):
    """A command, which takes effect at the beginning of a tick."""

    tick: Whole = quantity(
        "",
        "Tick at whose beginning the command takes effect; a session sets its own",
        ge=0,
        default=0,
    )
    kind: Any
    argument: Any
    joint: Whole | None = quantity(
        "",
        "Joint of an arm; None for a single joint, and for a command to the whole arm",
        ge=1,
        le=MAX_JOINTS,
        default=None,
    )

    def __init__(self, /, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ParameterError as error:
            kind = values.get("kind", type(self).model_fields["kind"].default)
            raise ParameterError(
                *(_rename(violation, kind) for violation in error.violations)
            ) from None

    @property
    def label(self) -> str:
        """Label of its event."""
        return COMMANDS[self.kind]

    def at(self, tick: int) -> Self:
        """Return the same command at another tick."""
        return self.model_copy(update={"tick": tick})

    def of_joint(self, joint: int | None) -> Self:
        """Return the same command for a joint of an arm."""
        return self.model_copy(update={"joint": joint})

    def to_json(self) -> dict[str, Any]:
        """Convert to a dict for JSON; see `read_command`."""
        return self.model_dump(mode="json", exclude={"joint"} if self.joint is None else None)


class Set(_Command):
    """A new value of a field of the configuration; references are faded in."""

    kind: Settable
    argument: Any = Field(description="New value of the field")

    def __init__(
        self, kind: str, argument: Any, tick: int = 0, joint: JointNumber | None = None
    ) -> None:
        read = _read_value(kind, argument) if kind in _VALUES else argument
        super().__init__(tick=tick, kind=kind, argument=read, joint=joint)


class ApplyLoad(_Command):
    """A load, now or at its `start_s`; its number in the run is that of its command."""

    kind: Literal["load"] = "load"
    argument: Load


class RemoveLoad(_Command):
    """The removal of the load of this number."""

    kind: Literal["unload"] = "unload"
    argument: Whole


class Stop(_Command):
    """Ramp of a bench's torque to zero; simulated lanes continue."""

    kind: Literal["stop"] = "stop"
    argument: None = None


Command = Annotated[Set | ApplyLoad | RemoveLoad | Stop, BY_KIND]
_OTHERS: dict[str, type[Any]] = {"load": ApplyLoad, "unload": RemoveLoad, "stop": Stop}


def fold(configuration: Configuration, command: Command, is_bench: bool = False) -> Configuration:
    """Compute the configuration after a command.

    Args:
        configuration: The configuration before.
        command: The command. A load or a stop is not part of the configuration and changes nothing.
        is_bench: Whether the first comparison is a bench's twin, which has the law of the bench.

    Returns:
        The configuration after it; the same object if nothing changes.

    Raises:
        ParameterError: If the value is invalid for the configuration.
        StateError: If it is a command of an arm, and the configuration of a single joint.
    """
    if not isinstance(command, Set):
        return configuration
    c, arm = configuration, configuration.arm
    if arm is not None and command.kind in OF_ARM:
        return c.changed(arm=arm.changed(**{command.kind: command.argument}))
    if command.kind in OF_ARM:
        raise StateError(NO_ARM)
    check_joint(c, command.joint)
    return c.change_joints(
        [
            list_changes(command, joint.comparisons, is_bench)
            if command.joint in (None, number)
            else {}
            for number, joint in enumerate(c.joints, start=1)
        ]
    )


def check_joint(configuration: Configuration, joint: JointNumber | None) -> None:
    """Raise `StateError` if a configuration does not have the joint of this number."""
    joints = len(configuration.joints)
    if joint is None or joint <= joints:
        return
    if configuration.arm is None:
        raise StateError(NO_ARM)
    raise StateError(f"This arm has no joint {joint}: its joints are 1 to {joints}.")


def list_changes(
    command: Command, comparisons: tuple[Lane, ...], is_bench: bool = False
) -> dict[str, Any]:
    """List the fields of a configuration that a command replaces, as `fold` does.

    Args:
        command: Any command.
        comparisons: The comparisons of the configuration before.
        is_bench: As in `fold`.

    Returns:
        The new values by name of the field.

    Raises:
        ParameterError: If there is no such lane.
    """
    if not isinstance(command, Set):
        return {}
    match command.kind:
        case "law" | "laws":
            names = (command.argument,) if command.kind == "law" else command.argument
            laws = (names[0], names[0], *names[2:]) if is_bench and comparisons else names
            others = _replace_laws(laws, comparisons)
            return {"law": laws[0]} | ({"comparisons": others} if len(laws) > 1 else {})
        case "lane":
            return {"comparisons": _replace_lane(command.argument, comparisons)}
    return {command.kind: command.argument}


def is_held(configuration: Configuration, command: Command) -> bool:
    """Return whether the configuration already has the values of a command; raises as `fold`.

    Always false for a load or a stop, which can be repeated.
    """
    return isinstance(command, Set) and fold(configuration, command) == configuration


def list_joint_commands(
    configuration: Configuration,
    build: Callable[[Configuration], Command],
    joint: JointNumber | None,
) -> list[Command]:
    """List the commands that change joints in the same way.

    Args:
        configuration: The configuration before.
        build: Builds the command from the configuration of a joint.
        joint: Joint of an arm; None: all, or the single joint.

    Returns:
        One command for a single joint, otherwise one for each of these joints.

    Raises:
        StateError: If there is no such joint.
    """
    check_joint(configuration, joint)
    if configuration.arm is None:
        return [build(configuration)]
    joints = enumerate(configuration.joints, start=1)
    return [build(own).of_joint(number) for number, own in joints if joint in (None, number)]


def _replace_laws(laws: tuple[str, ...], comparisons: tuple[Lane, ...]) -> tuple[Lane, ...]:
    """Replace the laws of the first lanes; gains and observers are kept."""
    lanes = 1 + len(comparisons)
    if len(laws) > lanes:
        bound = f"1 to {lanes} laws, one a lane from the first on"
        raise ParameterError(Violation("laws", list(laws), "", bound))
    changed = [lane.controlled_by(law) for lane, law in zip(comparisons, laws[1:], strict=False)]
    return (*changed, *comparisons[len(changed) :])


def _replace_lane(setting: LaneSetting, comparisons: tuple[Lane, ...]) -> tuple[Lane, ...]:
    """Replace the controller of one comparison lane."""
    lanes, at = 1 + len(comparisons), setting.lane - 2
    if setting.lane > lanes:
        bound = f"2 to {lanes}, of the lanes that run" if lanes > 1 else "none: one lane runs"
        raise ParameterError(Violation("lane", setting.lane, "", bound))
    return (*comparisons[:at], setting.setting, *comparisons[at + 1 :])


def build_command(tick: int, kind: str, argument: Any, joint: JointNumber | None = None) -> Command:
    """Build a validated command. joint: of an arm.

    Raises:
        ParameterError: If the kind is unknown or the argument is invalid.
    """
    if not isinstance(kind, str) or kind not in COMMANDS:
        raise ParameterError(Violation("kind", kind, "", "one of " + ", ".join(COMMANDS)))
    return _OTHERS.get(kind, Set)(tick=tick, kind=kind, argument=argument, joint=joint)


def read_command(written: Any) -> Command:
    """Read a command from its `to_json`.

    Raises:
        ParameterError: If it is not a command.
    """
    if not isinstance(written, dict):
        raise ParameterError(Violation("command", written, "", "an object with named fields"))
    fields: dict[str, Any] = {"tick": None, "kind": None, "argument": None} | written
    return build_command(fields["tick"], fields["kind"], fields["argument"], fields.get("joint"))


def _read_value(field: str, value: Any) -> Any:
    """Validate the value of a settable field.

    Raises:
        ParameterError: If it is invalid; the message contains the field.
    """
    model = _VALUES[field]
    try:
        return model.model_validate({"argument": value}).argument  # pyright: ignore[reportAttributeAccessIssue]
    except ValidationError as error:
        raise ParameterError(
            *(_rename(violation, field) for violation in explain(error, model))
        ) from None


def _rename(violation: Violation, kind: str) -> Violation:
    """Name the violations of an argument by its parts, and of the complete argument by `kind`."""
    name = violation.name.removeprefix("argument.")
    return replace(violation, name=kind if name == "argument" else name)
