"""Loads on the actuator, one kind per file."""

from typing import TYPE_CHECKING, Annotated, TypeAlias, Union

from svsa.inputs.checked import BY_KIND
from svsa.inputs.registration import find_kinds
from svsa.simulation.plant.loads.load import AnyLoad

LOADS: tuple[type[AnyLoad], ...] = find_kinds(__name__, AnyLoad)
"""Every kind of load of a file in this folder."""

if TYPE_CHECKING:
    Load: TypeAlias = AnyLoad
else:
    Load = Annotated[Union[LOADS], BY_KIND]  # noqa: UP007
