"""The description of a load in its own file, read by the lab."""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

import numpy as np
from pydantic import Field

from svsa.inputs.checked import Checked, Number, quantity

MAX_TORQUE_NM = 50.0
_Torque = Annotated[Number, Field(ge=-MAX_TORQUE_NM, le=MAX_TORQUE_NM)]
TorqueTriple = tuple[_Torque, _Torque, _Torque]
TRIPLE = "(w2, w4, w6) on link, motor 1, motor 2, each from −50 to 50"
PARTS = ("Load on the link", "Load on motor 1", "Load on motor 2")

MASS, SERIES, TORQUE = range(3)
KIND, W2, W4, W6, START, END, A, B, C, D = range(10)


class AnyLoad(Checked):
    """A load with the session time at which it comes on; left out, it is now.

    A file of this folder has a class of this kind with its fields, a `kind: Literal["…"]`, and a
    first line of its docstring that says what it is. Its `fill` writes its numbers into a row of
    the `LoadTable`.

    Attributes:
        acts_as: TORQUE of a torque w2, w4, w6 (N·m), MASS of an inertia A (kg·m²) and a moment of
            gravity B (N·m), SERIES of the torques of `list_points`.
        factor: Compiled, (rows, i, since) -> float: what the torque is multiplied by, `since`
            seconds after the onset; it reads its numbers, A to D of row i, with `read`. None of a
            torque that stays the same.
        first: The numbers for which a form asks besides the torque, by field, and what stands there
            first; None where no form offers it.
    """

    acts_as: ClassVar[int] = TORQUE
    factor: ClassVar[Any] = None
    first: ClassVar[Mapping[str, float] | None] = None

    if TYPE_CHECKING:
        kind: Any

    start_s: Number | None = quantity("s", "Session time of onset", ge=0, le=1e6, default=None)

    def get_duration(self) -> float:
        """Return its duration, s; infinite by default."""
        return math.inf

    def get_hung_mass(self) -> float:
        """Return the hanging mass, kg."""
        return 0.0

    def describe(self) -> str:
        """Describe it in a few words, as in the name of a run."""
        return self.kind

    def name(self) -> str:
        """Return the beginning of its label."""
        words = self.describe()
        return words[:1].upper() + words[1:]

    def fill(self, row: np.ndarray) -> None:
        """Fill W2 … W6 and A … D of its row."""

    def list_points(self) -> np.ndarray:
        """Of a SERIES (m, 4): time since onset, s, and torques, N·m."""
        return np.zeros((0, 4))


class TorqueLoad(AnyLoad):
    """A load that is a torque on link and motors."""

    torque_nm: TorqueTriple = quantity("N·m", TRIPLE, symbol="Load", parts=PARTS)

    def fill(self, row: np.ndarray) -> None:
        """Fill its torque into its row."""
        row[W2 : W6 + 1] = self.torque_nm


def format_torque(torque_nm: Sequence[float]) -> str:
    """A torque on the link alone, or on link and motors."""
    link, *motors = (f"{value:.3g}" for value in torque_nm)
    return f"{link} N·m" if not any(torque_nm[1:]) else f"{', '.join((link, *motors))} N·m"
