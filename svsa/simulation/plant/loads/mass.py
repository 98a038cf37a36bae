"""A hanging mass."""

from typing import ClassVar, Literal

import numpy as np

from svsa.inputs.checked import Number, quantity
from svsa.simulation.plant.loads.load import MASS, A, AnyLoad, B

GRAVITY_M_PER_S2 = 9.81
PAPER_MASS_KG = 3.0
PAPER_ARM_M = 0.068


class MassLoad(AnyLoad):
    """A mass on an arm of the link: adds inertia m r² and gravity m g r sin q."""

    acts_as: ClassVar[int] = MASS

    kind: Literal["mass"] = quantity("", "Mass", default="mass")
    mass_kg: Number = quantity("kg", "Mass m", gt=0, le=20, default=PAPER_MASS_KG)
    arm_m: Number = quantity("m", "Arm r", gt=0, le=1, default=PAPER_ARM_M)

    def get_hung_mass(self) -> float:
        """Return the mass, kg."""
        return self.mass_kg

    def describe(self) -> str:
        """Describe the load by mass and arm."""
        arm = "" if self.arm_m == PAPER_ARM_M else f" at {1000 * self.arm_m:g} mm"
        return f"{self.mass_kg:g} kg mass{arm}"

    def fill(self, row: np.ndarray) -> None:
        """Write inertia and gravity moment into its row."""
        row[A] = self.mass_kg * self.arm_m**2
        row[B] = self.mass_kg * GRAVITY_M_PER_S2 * self.arm_m
