"""Parts of a mechanism's schematic in the plane of motion, as functions of s and φ.

Frame: that of motor 1, origin on the joint axis, x along the link at φ = 0. Lengths are those of
the scene: 0.9 is the radius of the link's ring, its arm ends at 1.4.
"""

import math
from typing import Literal, NamedTuple

Kind = Literal["rod", "leaf", "spring", "pin"]
Body = Literal["motor1", "motor2", "link", "lever"]
Point = tuple[float, float]


class Part(NamedTuple):
    """A part of a mechanism: rod, leaf, spring, or a pin, which is a disc at its start.

    Attributes:
        kind: Shape of the part.
        body: Body that the part belongs to, which determines its color.
        start: Start point (x, y), scene units.
        end: End point (x, y), scene units.
    """

    kind: Kind
    body: Body
    start: Point
    end: Point


def place(radius: float, angle: float) -> Point:
    """Return the point at a radius and an angle, rad, from x."""
    return radius * math.cos(angle), radius * math.sin(angle)


def draw_torsion_spring(p: object, s: float, phi: float) -> tuple[Part, ...]:
    """Draw springs between motor 1 and link: the schematic of a mechanism without `draw`.

    Args:
        p: Parameters, not used.
        s: Stiffness coordinate, not used.
        phi: φ, rad.

    Returns:
        Two springs from pins of the motor to the pin of the link.
    """
    pin = place(0.62, math.pi + phi)
    ends = [place(0.62, math.pi + side) for side in (1.1, -1.1)]
    return (
        Part("rod", "link", (0.0, 0.0), pin),
        *(Part("spring", "motor1", end, pin) for end in ends),
        Part("pin", "link", pin, pin),
        *(Part("pin", "motor1", end, end) for end in ends),
    )


def hold(value: float, least: float, most: float) -> float:
    """Limit a value to the range that can be drawn."""
    return min(max(value, least), most)
