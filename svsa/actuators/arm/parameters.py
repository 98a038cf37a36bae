"""Parameters of the two-link arm, and two arms with their sources."""

from typing import Self

from pydantic import model_validator

from svsa.actuators.arm.dynamics import Arm, add_tip_mass
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, quantity


class ArmParameters(Checked):
    """Two rigid links in a vertical plane; link 2 hangs on link 1. Motors are part of the links.

    The rotors of both joints turn about their own axes only (Spong, *Modeling and control of
    elastic joint robots*, 1987): their inertias are those of the actuators.
    """

    length1_m: Number = quantity("m", "Length l1 of link 1", gt=0, le=3)
    length2_m: Number = quantity("m", "Length l2 of link 2", gt=0, le=3)
    mass1_kg: Number = quantity("kg", "Mass m1 of link 1", gt=0, le=50)
    mass2_kg: Number = quantity("kg", "Mass m2 of link 2", gt=0, le=50)
    center1_m: Number = quantity("m", "From joint 1 to the center of mass of link 1", ge=0, le=3)
    center2_m: Number = quantity("m", "From joint 2 to the center of mass of link 2", ge=0, le=3)
    inertia1_kg_m2: Number = quantity(
        "kg·m²", "Inertia I1 of link 1 about its center of mass", ge=0, le=10
    )
    inertia2_kg_m2: Number = quantity(
        "kg·m²", "Inertia I2 of link 2 about its center of mass", ge=0, le=10
    )
    tip_mass_kg: Number = quantity("kg", "Mass at the tip", ge=0, le=20, default=0.0)
    gravity_m_per_s2: Number = quantity("m/s²", "Gravity g", ge=0, le=30, default=9.81)

    @model_validator(mode="after")
    def _check_inertia(self) -> Self:
        """M(q) is nearest to singular at q2 = 0, where det M = a1 a2 − a3² is the sum below."""
        m2, tip, l1, l2 = self.mass2_kg, self.tip_mass_kg, self.length1_m, self.length2_m
        c2, inertia2 = self.center2_m, self.inertia2_kg_m2
        link1 = self.inertia1_kg_m2 + self.mass1_kg * self.center1_m**2
        link2 = inertia2 + m2 * c2**2 + tip * l2**2
        about_elbow = (m2 + tip) * inertia2 + m2 * tip * (c2 - l2) ** 2
        if not link1 * link2 + l1**2 * about_elbow > 0.0:
            bound = "greater than 0: otherwise M(q) of the straight arm has no inverse"
            raise ParameterError(Violation("inertia2_kg_m2", inertia2, "kg·m²", bound))
        return self

    def build(self) -> Arm:
        """Build the constants of the compiled loop.

        Returns:
            `Arm`.
        """
        c1, c2, m1, m2 = self.center1_m, self.center2_m, self.mass1_kg, self.mass2_kg
        l1, l2, g = self.length1_m, self.length2_m, self.gravity_m_per_s2
        links = Arm(
            inertia1=self.inertia1_kg_m2 + m1 * c1**2 + m2 * l1**2,
            inertia2=self.inertia2_kg_m2 + m2 * c2**2,
            coupling=m2 * l1 * c2,
            weight1=g * (m1 * c1 + m2 * l1),
            weight2=g * m2 * c2,
            length1=l1,
            length2=l2,
            gravity=g,
        )
        return add_tip_mass(links, self.tip_mass_kg)


def build_rods(mass1: float, mass2: float, length1: float, length2: float) -> ArmParameters:
    """Parameters of two uniform rods. mass1, mass2: kg. length1, length2: m."""
    return ArmParameters(
        length1_m=length1,
        length2_m=length2,
        mass1_kg=mass1,
        mass2_kg=mass2,
        center1_m=length1 / 2.0,
        center2_m=length2 / 2.0,
        inertia1_kg_m2=mass1 * length1**2 / 12.0,
        inertia2_kg_m2=mass2 * length2**2 / 12.0,
    )


RODS = build_rods(0.3, 0.3, 0.3, 0.3)
"""Two uniform rods of 0.3 kg and 0.3 m: assumed, for the SVSA in both joints."""
MACCEPA_ARM = build_rods(0.42, 0.23, 0.25, 0.25).changed(center1_m=0.135, center2_m=0.098)
"""The two-link arm with MACCEPA joints (Van Ham et al., 2007): masses, lengths and centers of mass.

Assumed: the inertias about the centers of mass are those of uniform rods.
"""
