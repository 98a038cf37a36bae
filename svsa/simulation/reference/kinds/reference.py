"""The description of a reference in its own file, read by the lab."""

import math
from abc import abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from svsa.inputs.checked import Checked
from svsa.simulation.reference.shape import Shape


class AnyReference(Checked):
    """A reference of q_d or σ_d.

    Each file of this folder has a class derived from `AnyPosition`, or one from `AnyStiffness`, or
    both, with its fields, a `kind: Literal["…"]` and a `transition_s`.

    Attributes:
        compute: Compiled, (a, b, c, d, e, f, time) -> `Derivatives`: the reference at its own time
            (s), from the numbers of its `Shape`. None for a curve, which is piecewise polynomial,
            and for a sine.
        first: Numeric fields of its form, with initial values; None if it has no form.
        hint: Help text of the form.
    """

    compute: ClassVar[Any] = None
    first: ClassVar[Mapping[str, float] | None] = None
    hint: ClassVar[str] = ""

    if TYPE_CHECKING:
        kind: Any
        transition_s: Any

    @abstractmethod
    def get_shape(self) -> Shape:
        """Build the reference's row of the stack.

        Returns:
            The numbers that the compiled loop reads.
        """

    def describe(self) -> str:
        """Describe the reference in a few words, for the name of a run.

        Returns:
            Text such as "60° 0.2 Hz".
        """
        return str(self.kind).replace("_", " ")


class AnyPosition(AnyReference):
    """A reference of q_d, rad."""


class AnyStiffness(AnyReference):
    """A reference of σ_d, N·m/rad, within the range of the limits."""

    def get_mean(self) -> float | None:
        """Return the mean of σ_d.

        Returns:
            Stiffness, N·m/rad; None for a reference without a mean.
        """
        return None


def format_degrees(angle_rad: float) -> str:
    """An angle in degrees, as in a list of runs."""
    return f"{math.degrees(angle_rad):.4g}°"
