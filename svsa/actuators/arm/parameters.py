"""Parameters of a planar arm, and two arms with their sources."""

import re
from typing import Any, Self

import numpy as np
from pydantic import model_validator

from svsa.actuators.arm.dynamics import Arm, Link, add_tip_mass, build_arm
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, quantity

MAX_LINKS = 4
_OF_TWO_LINKS = re.compile(r"(length|mass|center|inertia)([12])(_\w+)")


def read_former_field(name: str) -> tuple[int, str] | None:
    """Read a field of arms of two links in earlier versions.

    Args:
        name: Name of the field, such as "length2_m".

    Returns:
        Number of the link from 0 and its field, such as (1, "length_m"); None for another name.
    """
    parts = _OF_TWO_LINKS.fullmatch(name)
    return parts and (int(parts[2]) - 1, parts[1] + parts[3])


class LinkParameters(Checked):
    """A rigid link; motors are part of it."""

    length_m: Number = quantity("m", "Length l", gt=0, le=3)
    mass_kg: Number = quantity("kg", "Mass m", gt=0, le=50)
    center_m: Number = quantity("m", "From its joint to its center of mass, c", ge=0, le=3)
    inertia_kg_m2: Number = quantity("kg·m²", "Inertia I about its center of mass", ge=0, le=10)


class ArmParameters(Checked):
    """Rigid links in a vertical plane, each of which hangs on the one before.

    The rotors of the joints turn about their own axes only (Spong, *Modeling and control of elastic
    joint robots*, 1987): their inertias are those of the actuators.
    """

    chain: tuple[LinkParameters, ...] = quantity(
        "", "Links from joint 1 on", title="Link", min_length=1, max_length=MAX_LINKS
    )
    tip_mass_kg: Number = quantity("kg", "Mass at the tip", ge=0, le=20, default=0.0)
    gravity_m_per_s2: Number = quantity("m/s²", "Gravity g", ge=0, le=30, default=9.81)

    @model_validator(mode="before")
    @classmethod
    def _read_two_links(cls, written: Any) -> Any:
        """Read the fields of two links of earlier versions, as records have them."""
        if not isinstance(written, dict) or "chain" in written:
            return written
        chain: list[dict[str, Any]] = [{}, {}]
        fields: dict[str, Any] = {}
        for name, value in written.items():
            if former := read_former_field(str(name)):
                number, field = former
                chain[number][field] = value
            else:
                fields[name] = value
        return fields | {"chain": chain} if any(chain) else written

    @model_validator(mode="after")
    def _check_inertia(self) -> Self:
        """M(q) is nearest to singular in the straight arm: there all velocities are parallel."""
        lengths = [link.length_m for link in self.chain]
        rows = [np.sqrt(self.tip_mass_kg) * np.array(lengths)]
        for number, link in enumerate(self.chain):
            center = np.array([*lengths[:number], link.center_m, *[0.0] * len(lengths)])
            rows.append(np.sqrt(link.mass_kg) * center[: len(lengths)])
            rows.append(np.sqrt(link.inertia_kg_m2) * np.eye(len(lengths))[number])
        if np.linalg.matrix_rank(np.array(rows)) < len(lengths):
            last = len(lengths) - 1
            bound = "greater than 0: otherwise M(q) of the straight arm has no inverse"
            name, value = f"chain[{last}].inertia_kg_m2", self.chain[last].inertia_kg_m2
            raise ParameterError(Violation(name, value, "kg·m²", bound))
        return self

    def change_link(self, number: int, **changes: float) -> Self:
        """Return the arm with changed fields of a link.

        Args:
            number: Number of the link, from 1.
            changes: New values by name of the field of `LinkParameters`.

        Returns:
            The changed arm.
        """
        at = number - 1
        link = self.chain[at].changed(**changes)
        return self.changed(chain=(*self.chain[:at], link, *self.chain[number:]))

    def build(self) -> Arm:
        """Build the constants of the compiled loop.

        Returns:
            `Arm`.
        """
        links = [
            Link(link.length_m, link.mass_kg, link.center_m, link.inertia_kg_m2)
            for link in self.chain
        ]
        return add_tip_mass(build_arm(links, self.gravity_m_per_s2), self.tip_mass_kg)


def build_rods(*rods: tuple[float, float]) -> ArmParameters:
    """Parameters of uniform rods. rods: mass (kg) and length (m) of each, from joint 1 on."""
    return ArmParameters(
        chain=tuple(
            LinkParameters(
                length_m=length,
                mass_kg=mass,
                center_m=length / 2.0,
                inertia_kg_m2=mass * length**2 / 12.0,
            )
            for mass, length in rods
        )
    )


RODS = build_rods((0.3, 0.3), (0.3, 0.3))
"""Two uniform rods of 0.3 kg and 0.3 m: assumed, for the SVSA in both joints."""
FOUR_RODS = build_rods(*[(0.3, 0.2)] * 4)
"""Four uniform rods of 0.3 kg and 0.2 m: assumed, for the SVSA in all joints."""
MACCEPA_ARM = (
    build_rods((0.42, 0.25), (0.23, 0.25))
    .change_link(1, center_m=0.135)
    .change_link(2, center_m=0.098)
)
"""The two-link arm with MACCEPA joints (Van Ham et al., 2007): masses, lengths and centers of mass.

Assumed: the inertias about the centers of mass are those of uniform rods.
"""
