"""Commands: changes of a run, as values that can be stored and repeated.

A change of a setting is one command, `Set(field, value)`, and `fold` alone says what becomes of a
configuration: for a run, its timeline, its record and a script that repeats it. In a record, over
REST, and on its way to a bench a command is an object of `tick`, `kind` (of a `Set` its field) and
`argument` (its value).
"""

from dataclasses import replace
from typing import Annotated, Any, Literal, Self, get_args

from pydantic import BaseModel, Field, ValidationError, create_model

from svsa.control.installed import LawName
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import BY_KIND, Checked, Whole, quantity
from svsa.inputs.explanation import explain
from svsa.runs.configuration import Configuration, Lane, LaneSetting
from svsa.simulation.plant.loads import Load

Settable = Literal[
    "position",
    "stiffness",
    "law",
    "laws",
    "gains",
    "parameters",
    "observer",
    "actuator",
    "nominal",
    "effects",
    "comparisons",
    "lane",
]
"""The fields of a `Configuration` that a run may change; `laws` sets the laws of the first lanes,
in their order, and `lane` one of the comparisons, whose plant stays as it is.
"""

COMMANDS: dict[str, str] = {
    "position": "Motion changed",
    "stiffness": "Stiffness changed",
    "law": "Law changed",
    "laws": "Laws changed",
    "gains": "Gains changed",
    "parameters": "Parameters changed",
    "observer": "Observer changed",
    "actuator": "Plant changed",
    "nominal": "Nominal model changed",
    "effects": "Effects changed",
    "comparisons": "Lanes changed",
    "lane": "A lane changed",
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
    known = Configuration.model_fields.get(field)
    value: Any = (_OF_LANES[field], ...) if known is None else (known.annotation, known)
    return create_model(field, argument=value)


_VALUES = {field: _build_value(field) for field in get_args(Settable)}


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

    def __init__(self, /, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ParameterError as error:
            kind = values.get("kind", type(self).model_fields["kind"].default)
            raise ParameterError(*(_rename(one, kind) for one in error.violations)) from None

    @property
    def label(self) -> str:
        """Label of its event."""
        return COMMANDS[self.kind]

    def at(self, tick: int) -> Self:
        """Return the same command at another tick."""
        return self.model_copy(update={"tick": tick})

    def to_json(self) -> dict[str, Any]:
        """Convert to a dict for JSON; see `read_command`."""
        return self.model_dump(mode="json")


class Set(_Command):
    """A new value of a field of the configuration; references are faded in."""

    kind: Settable
    argument: Any = Field(description="New value of the field")

    def __init__(self, kind: str, argument: Any, tick: int = 0) -> None:
        read = _read_value(kind, argument) if kind in _VALUES else argument
        super().__init__(tick=tick, kind=kind, argument=read)


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
        configuration: The one before.
        command: A load or a stop, which is no part of the configuration, changes nothing.
        is_bench: Whether the first comparison is a bench's twin, which has the law of the bench.

    Returns:
        The configuration after it; the same object where nothing is changed.

    Raises:
        ParameterError: If the configuration cannot have the value.
    """
    return configuration.changed(**list_changes(command, configuration.comparisons, is_bench))


def list_changes(
    command: Command, comparisons: tuple[Lane, ...], is_bench: bool = False
) -> dict[str, Any]:
    """List the fields of a configuration that a command replaces, as `fold` does.

    Args:
        command: Any.
        comparisons: Those of the configuration before.
        is_bench: As in `fold`.

    Returns:
        The new values by the names of the fields.

    Raises:
        ParameterError: If there is no such lane.
    """
    if not isinstance(command, Set):
        return {}
    match command.kind:
        case "law" | "laws":
            given = (command.argument,) if command.kind == "law" else command.argument
            laws = (given[0], given[0], *given[2:]) if is_bench and comparisons else given
            others = _replace_laws(laws, comparisons)
            return {"law": laws[0]} | ({"comparisons": others} if len(laws) > 1 else {})
        case "lane":
            return {"comparisons": _replace_lane(command.argument, comparisons)}
    return {command.kind: command.argument}


def is_held(configuration: Configuration, command: Command) -> bool:
    """Whether the configuration already has the values of a command; raises as `fold`.

    Never of a load or a stop: each one is another.
    """
    return isinstance(command, Set) and fold(configuration, command) == configuration


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


def build_command(tick: int, kind: str, argument: Any) -> Command:
    """A checked command; raises `ParameterError` for an unknown kind or a wrong argument."""
    if not isinstance(kind, str) or kind not in COMMANDS:
        raise ParameterError(Violation("kind", kind, "", "one of " + ", ".join(COMMANDS)))
    return _OTHERS.get(kind, Set)(tick=tick, kind=kind, argument=argument)


def read_command(written: Any) -> Command:
    """Read a command from its `to_json`; raises `ParameterError` for anything else."""
    if not isinstance(written, dict):
        raise ParameterError(Violation("command", written, "", "an object with named fields"))
    given: dict[str, Any] = {"tick": None, "kind": None, "argument": None} | written
    return build_command(given["tick"], given["kind"], given["argument"])


def _read_value(field: str, given: Any) -> Any:
    """The checked value of a settable field; raises `ParameterError` with the field's name."""
    model = _VALUES[field]
    try:
        return model.model_validate({"argument": given}).argument  # pyright: ignore[reportAttributeAccessIssue]
    except ValidationError as error:
        raise ParameterError(*(_rename(one, field) for one in explain(error, model))) from None


def _rename(violation: Violation, kind: str) -> Violation:
    """Name the violations of an argument by its parts, and of the whole argument by `kind`."""
    name = violation.name.removeprefix("argument.")
    return replace(violation, name=kind if name == "argument" else name)
