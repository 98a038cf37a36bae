"""All references of q_d and σ_d, one kind per file."""

from typing import TYPE_CHECKING, Annotated, TypeAlias, Union

from svsa.inputs.checked import BY_KIND
from svsa.inputs.registration import find_kinds
from svsa.simulation.reference.kinds.reference import AnyPosition, AnyReference, AnyStiffness

POSITIONS: tuple[type[AnyPosition], ...] = find_kinds(__name__, AnyPosition)
STIFFNESSES: tuple[type[AnyStiffness], ...] = find_kinds(__name__, AnyStiffness)

if TYPE_CHECKING:
    PositionReference: TypeAlias = AnyPosition
    StiffnessReference: TypeAlias = AnyStiffness
else:
    PositionReference = Annotated[Union[POSITIONS], BY_KIND]  # noqa: UP007
    StiffnessReference = Annotated[Union[STIFFNESSES], BY_KIND]  # noqa: UP007


def get_range(reference: AnyReference) -> tuple[float, float]:
    """Return minimum and maximum of a reference, in its own unit."""
    return reference.get_shape().range


def compute_start_value(reference: AnyReference) -> float:
    """Return the value at t = 0, in the reference's own unit."""
    return reference.get_shape().start
