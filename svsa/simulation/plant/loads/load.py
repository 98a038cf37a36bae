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

TIP, MASS, SERIES, TORQUE = range(-1, 3)
KIND, W2, W4, W6, START, END, A, B, C, D = range(10)


class AnyLoad(Checked):
    """A load with the session time of its onset; left out, it is the current time.

    Each file of this folder has a class derived from this one with its fields and a `kind:
    Literal["…"]`; the first line of its docstring is its description. Its `fill` writes its numbers
    into a row of the `LoadTable`.

    Attributes:
        acts_as: TORQUE for a torque w2, w4, w6 (N·m), MASS for an inertia A (kg·m²) and a gravity
            moment B (N·m), SERIES for the torques of `list_points`, TIP for a load at the tip of an
            arm, which is not in the table.
        is_push: Whether an operator holds it: sent again while it acts, it is changed and extended.
        factor: Compiled, (rows, i, since) -> float: factor of the torque, `since` seconds after the
            onset; it reads its numbers, A to D of row i, with `read`. None for a constant torque.
        first: Numeric fields of its form besides the torque, with initial values; None if it has no
            form.
        start_s: Session time of the onset, s.
    """

    acts_as: ClassVar[int] = TORQUE
    factor: ClassVar[Any] = None
    first: ClassVar[Mapping[str, float] | None] = None
    is_push: ClassVar[bool] = False

    if TYPE_CHECKING:
        kind: Any

    start_s: Number | None = quantity("s", "Session time of the onset", ge=0, le=1e6, default=None)

    def get_duration(self) -> float:
        """Return the duration of the load.

        Returns:
            Duration, s; infinite by default.
        """
        return math.inf

    def get_hung_mass(self) -> float:
        """Return the hanging mass.

        Returns:
            Mass, kg; 0 for a load without one.
        """
        return 0.0

    def describe(self) -> str:
        """Describe the load in a few words, for the name of a run.

        Returns:
            Text such as "2 N·m".
        """
        return self.kind

    def name(self) -> str:
        """Return the beginning of the load's label.

        Returns:
            Text such as "3 kg load".
        """
        words = self.describe()
        return words[:1].upper() + words[1:]

    def fill(self, row: np.ndarray) -> None:
        """Write the numbers of the load into its row of the `LoadTable`.

        Args:
            row: The row; columns W2, W4, W6 (N·m) and A to D are to be filled.
        """

    def list_points(self) -> np.ndarray:
        """Return the points of a SERIES.

        Returns:
            Time since onset (s) and torques w2, w4, w6 (N·m), shape (m, 4); empty for other loads.
        """
        return np.zeros((0, 4))


class TorqueLoad(AnyLoad):
    """A load that is a torque on link and motors."""

    torque_nm: TorqueTriple = quantity("N·m", TRIPLE, symbol="Load", parts=PARTS)

    def fill(self, row: np.ndarray) -> None:
        """Write the torque into its row."""
        row[W2 : W6 + 1] = self.torque_nm


def format_torque(torque_nm: Sequence[float]) -> str:
    """A torque on the link alone, or on link and motors."""
    link, *motors = (f"{value:.3g}" for value in torque_nm)
    return f"{link} N·m" if not any(torque_nm[1:]) else f"{', '.join((link, *motors))} N·m"
