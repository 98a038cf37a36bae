"""Loads at the tip of an arm: a mass, a force, an impulse, a push, a wall."""

import math
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from svsa.inputs.checked import Number, quantity
from svsa.simulation.plant.loads.load import TIP, AnyLoad

MASS, FORCE_X, FORCE_Y, NORMAL_X, NORMAL_Y, DISTANCE, STIFFNESS, DAMPING = range(2, 10)
"""Columns of a row of the table of the loads at the tip, after onset and end (ticks)."""
MAX_FORCE_N = 500.0

_Force = Annotated[Number, Field(ge=-MAX_FORCE_N, le=MAX_FORCE_N)]
_Impulse = Annotated[Number, Field(ge=-10, le=10)]
XY = "(x horizontal, y up)"


class AnyTipLoad(AnyLoad):
    """A load at the tip of an arm. `fill_tip` writes its numbers into its row of the table."""

    acts_as: ClassVar[int] = TIP

    def fill_tip(self, row: np.ndarray, duration: float) -> None:
        """Write its numbers.

        Args:
            row: Its row of `svsa.simulation.arm.tip_loads.build_tip_table`.
            duration: How long it acts in whole ticks, s.
        """
        raise NotImplementedError


class TipMass(AnyTipLoad):
    """A mass at the tip. It comes with the velocity of the tip: no impact."""

    kind: Literal["tip_mass"] = quantity("", "Tip mass", default="tip_mass")
    mass_kg: Number = quantity("kg", "Mass", gt=0, le=20)

    def get_hung_mass(self) -> float:
        """Return the mass, kg."""
        return self.mass_kg

    def describe(self) -> str:
        """Describe the load by its mass."""
        return f"{self.mass_kg:g} kg at the tip"

    def fill_tip(self, row: np.ndarray, duration: float) -> None:
        """Write the mass."""
        row[MASS] = self.mass_kg


class _Force2D(AnyTipLoad):
    force_n: tuple[_Force, _Force] = quantity("N", f"Force {XY}")

    def fill_tip(self, row: np.ndarray, duration: float) -> None:
        """Write the force."""
        row[FORCE_X : FORCE_Y + 1] = self.force_n


class TipForce(_Force2D):
    """A force at the tip that keeps its direction."""

    kind: Literal["tip_force"] = quantity("", "Tip force", default="tip_force")
    duration_s: Number | None = quantity("s", "Duration", gt=0, le=3600, default=None)

    def get_duration(self) -> float:
        """Return the duration, s."""
        return math.inf if self.duration_s is None else self.duration_s

    def describe(self) -> str:
        """Describe the load by its components."""
        return f"{_list(self.force_n)} N at the tip"


class TipPush(_Force2D):
    """A force at the tip held by an operator: repeated requests change and extend it."""

    is_push: ClassVar[bool] = True

    kind: Literal["tip_push"] = quantity("", "Tip push", default="tip_push")
    hold_s: Number = quantity("s", "Duration after it was last sent", gt=0, le=60, default=0.5)

    def get_duration(self) -> float:
        """Return the time until the push ends, s, unless it is sent again."""
        return self.hold_s

    def describe(self) -> str:
        """Describe the load without its force, which changes."""
        return "push at the tip"


class TipImpulse(AnyTipLoad):
    """An impulse at the tip: a constant force over a few ticks with exactly this integral."""

    kind: Literal["tip_impulse"] = quantity("", "Tip impulse", default="tip_impulse")
    impulse_ns: tuple[_Impulse, _Impulse] = quantity("N·s", f"Impulse {XY}")
    DURATION_S: ClassVar[float] = 0.005

    def get_duration(self) -> float:
        """Return how long the force acts, s."""
        return self.DURATION_S

    def describe(self) -> str:
        """Describe the load by its components."""
        return f"impulse {_list(self.impulse_ns)} N·s at the tip"

    def fill_tip(self, row: np.ndarray, duration: float) -> None:
        """Write the force."""
        row[FORCE_X : FORCE_Y + 1] = np.array(self.impulse_ns) / duration


class Wall(AnyTipLoad):
    """A wall that pushes on the tip behind it: n · (k depth + d rate of depth), never a pull.

    The wall is the line of points r with n · r = distance; n points away from it, towards the arm.
    """

    kind: Literal["wall"] = quantity("", "Wall", default="wall")
    normal_rad: Number = quantity(
        "rad", "Direction of n from horizontal, counterclockwise", ge=-2 * math.pi, le=2 * math.pi
    )
    distance_m: Number = quantity("m", "n · r of the points r of the wall", ge=-6, le=6)
    stiffness_n_per_m: Number = quantity("N/m", "Contact stiffness k", gt=0, le=1e5)
    damping_ns_per_m: Number = quantity("N·s/m", "Contact damping d", ge=0, le=1e3, default=0.0)

    def fill_tip(self, row: np.ndarray, duration: float) -> None:
        """Write normal, distance, stiffness and damping."""
        row[NORMAL_X], row[NORMAL_Y] = math.cos(self.normal_rad), math.sin(self.normal_rad)
        row[DISTANCE : DAMPING + 1] = (
            self.distance_m, self.stiffness_n_per_m, self.damping_ns_per_m,
        )  # fmt: skip


def _list(components: tuple[float, float]) -> str:
    return "({:g}, {:g})".format(*components)
