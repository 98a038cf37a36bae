"""The actuators that are installed: found by the entry points `svsa.actuators` of packages."""

from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Annotated, Any

from pydantic import SerializerFunctionWrapHandler, ValidatorFunctionWrapHandler
from pydantic.functional_serializers import WrapSerializer
from pydantic.functional_validators import WrapValidator

from svsa.actuators.mechanism import Mechanism
from svsa.actuators.parameters import (
    SVSA,
    ActuatorParameters,
    MechanismParameters,
    get_mechanism_name,
)
from svsa.errors import ParameterError, Violation
from svsa.inputs.nearest import suggest
from svsa.inputs.registration import load_entry

GROUP = "svsa.actuators"


@cache
def _find_entries() -> dict[str, EntryPoint]:
    entries = entry_points(group=GROUP)
    names = sorted(entries.names, key=lambda name: (name != SVSA, name))
    return {name: next(iter(entries.select(name=name))) for name in names}


@cache
def list_mechanism_names() -> tuple[str, ...]:
    """The names of the actuators that are installed and load: the SVSA first."""
    return tuple(name for name in _find_entries() if isinstance(_load(name), Mechanism))


@cache
def _load(name: str) -> Mechanism | str:
    """Import an actuator once per process; return the error if it fails."""
    return load_entry(_find_entries()[name], Mechanism, "actuator")


@cache
def get_mechanism(name: str, field: str = "actuator") -> Mechanism:
    """Return an installed actuator by its name.

    Args:
        name: Name of its entry point.
        field: Name of the value in the error message.

    Returns:
        The actuator.

    Raises:
        ParameterError: If no such actuator is installed, its package does not load, or defines
            another name.
    """
    if name not in _find_entries():
        known = list_mechanism_names()
        bound = f"an installed actuator: {', '.join(known)}{suggest(name, known)}"
        raise ParameterError(Violation(field, name, "", bound))
    mechanism = _load(name)
    if isinstance(mechanism, str):
        raise ParameterError(Violation(field, name, "", "", finding=mechanism))
    return mechanism


def find_mechanism(parameters: MechanismParameters) -> Mechanism:
    """Return the installed actuator that parameters belong to.

    Raises:
        ParameterError: If it is not installed.
    """
    return get_mechanism(get_mechanism_name(parameters))


def _read(written: Any, read_svsa: ValidatorFunctionWrapHandler) -> Any:
    """Parameters of any actuator; those that name no mechanism are of the SVSA."""
    if isinstance(written, MechanismParameters):
        return written
    if isinstance(written, dict) and isinstance(name := written.get("mechanism"), str):
        values = {key: value for key, value in written.items() if key != "mechanism"}
        return get_mechanism(name, "mechanism").parameters(**values)
    return read_svsa(written)


def _write(parameters: Any, write_svsa: SerializerFunctionWrapHandler, info: Any) -> Any:
    is_svsa = isinstance(parameters, ActuatorParameters)
    return write_svsa(parameters) if is_svsa else parameters.model_dump(mode=info.mode)


InstalledActuator = Annotated[ActuatorParameters, WrapValidator(_read), WrapSerializer(_write)]
"""Parameters of an actuator; a field `mechanism` selects an actuator other than the SVSA."""
