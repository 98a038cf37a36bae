"""The description of a reference in its own file, read by the lab."""

import math
from abc import abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from svsa.inputs.checked import Checked
from svsa.simulation.reference.shape import Shape


class AnyReference(Checked):
    """A reference of q_d or σ_d.

    A file of this folder has a class that derives from `AnyPosition`, or one from `AnyStiffness`,
    or both, with its fields, a `kind: Literal["…"]` and a `transition_s`.

    Attributes:
        compute: Compiled, (a, b, c, d, e, f, time) -> `Derivatives`: the reference at its own time
            (s), from the numbers of its `Shape`. None of a curve, which is piecewise polynomials,
            and of a sine.
        first: The numbers for which a form asks, by field, and what stands there first; None where
            no form offers it.
        hint: What the form says of it.
    """

    compute: ClassVar[Any] = None
    first: ClassVar[Mapping[str, float] | None] = None
    hint: ClassVar[str] = ""

    if TYPE_CHECKING:
        kind: Any
        transition_s: Any

    @abstractmethod
    def get_shape(self) -> Shape:
        """Build its row of the stack."""

    def describe(self) -> str:
        """A few words, as in the name of a run."""
        return str(self.kind).replace("_", " ")


class AnyPosition(AnyReference):
    """A reference of q_d, rad."""


class AnyStiffness(AnyReference):
    """A reference of σ_d, N·m/rad, within the range of the limits."""

    def get_mean(self) -> float | None:
        """Return the mean of σ_d, N·m/rad; None if it has none."""
        return None


def format_degrees(angle_rad: float) -> str:
    """An angle in degrees, as in a list of runs."""
    return f"{math.degrees(angle_rad):.4g}°"
