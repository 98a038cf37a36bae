"""The actuators that are installed, and their datasheets."""

from typing import Annotated

from fastapi import Depends, Path

from svsa.actuators.installed import get_mechanism
from svsa.actuators.mechanism import Mechanism
from svsa.errors import ParameterError
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.problems import UnknownError
from svsa_server.routes.depends import REFUSALS
from svsa_server.routing import build_router
from svsa_server.schemas.lab.actuator import ActuatorState, describe_actuator, list_actuators

router = build_router("/actuators", tags=["lab"], responses=REFUSALS)


def _find(name: Annotated[str, Path(max_length=40, examples=["qbmove"])]) -> Mechanism:
    try:
        return get_mechanism(name)
    except ParameterError as error:
        raise UnknownError(str(error)) from None


NamedActuator = Annotated[Mechanism, Depends(_find)]


@router.get("")
@allow(OBSERVER)
async def read_actuators() -> list[ActuatorState]:
    """List the installed actuators, the SVSA first, with parameters, limits and sources."""
    return list_actuators()


@router.get("/{name}")
@allow(OBSERVER)
async def read_actuator(mechanism: NamedActuator) -> ActuatorState:
    """Read an installed actuator: parameters, limits and sources."""
    return describe_actuator(mechanism)
