"""Positions of pivot, lever and springs for a given pose.

The arrangement drawn is the one whose small-angle stiffness is Eq 3 at φ = 0, K_s R² (μ/(1−μ))²:
the lever is hinged on the output link at radius R, passes through the pivot at radius a = μR on the
principal motor, and its inner end moves a block between two springs on a line through the joint
center.

Frames: z along the joint axis towards the viewer, x along the link at q = 0 (straight down). The
lever's hinge is at (−R, 0) of the link, opposite to the arm. Lengths are scene units.
"""

import math
from typing import NamedTuple

from svsa.simulation.plant.loads.mass import PAPER_ARM_M
from svsa_scene.pose import ActuatorPose

UNITS_PER_METRE = 10.0
RADIUS = 0.075 * UNITS_PER_METRE
LOAD_ARM = PAPER_ARM_M * UNITS_PER_METRE

SPRING_ANCHOR = 0.64
BLOCK_HALF_WIDTH = 0.07
_BLOCK_TRAVEL = 0.46
_RATIO_DRAWN = (0.22, 0.86)


class Linkage(NamedTuple):
    """Positions of the moving parts, angles in rad about z, lengths in scene units.

    Attributes:
        plate_angle: Angle of the spiral plate relative to the connector; one turn moves the pivot
            by R.
        pivot_radius: a.
        deflection: φ = q − θ1.
        lever_angle: Angle of the lever relative to the link's hinge line.
        block_offset: y of the spring block on the link.
        spring_left: Length of the left spring.
        spring_right: Length of the right spring.
    """

    plate_angle: float
    pivot_radius: float
    deflection: float
    lever_angle: float
    block_offset: float
    spring_left: float
    spring_right: float


def compute_linkage(pose: ActuatorPose) -> Linkage:
    """Compute the positions for a pose: tan ψ = a sin φ / (R − a cos φ), block at R tan ψ.

    μ is limited to the range of the spiral and the block to its travel, so that a run that has left
    the model's domain is still drawn as a mechanism.
    """
    ratio = min(max(pose.lever_ratio, _RATIO_DRAWN[0]), _RATIO_DRAWN[1])
    pivot_radius = ratio * RADIUS
    deflection = pose.position_rad - pose.motor1_position_rad
    lever_angle = math.atan2(
        pivot_radius * math.sin(deflection), RADIUS - pivot_radius * math.cos(deflection)
    )
    limit = math.atan2(_BLOCK_TRAVEL, RADIUS)
    lever_angle = min(max(lever_angle, -limit), limit)
    block_offset = RADIUS * math.tan(lever_angle)
    return Linkage(
        plate_angle=2.0 * math.pi * ratio,
        pivot_radius=pivot_radius,
        deflection=deflection,
        lever_angle=lever_angle,
        block_offset=block_offset,
        spring_left=SPRING_ANCHOR - BLOCK_HALF_WIDTH + block_offset,
        spring_right=SPRING_ANCHOR - BLOCK_HALF_WIDTH - block_offset,
    )
