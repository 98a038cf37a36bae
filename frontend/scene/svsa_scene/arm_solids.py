"""Solid parts of an arm: links, tip, hung mass, force, wall, ellipse. Lengths are scene units.

Axes as in the frame "/a": x down along a link at 0, y to the right, z along the axes.
"""

import numpy as np
import trimesh

from svsa_scene import appearance as look
from svsa_scene.geometry import join, make_arrow_head, make_bar, make_disc, make_plate, make_ring
from svsa_scene.mechanism import Group

REACH = 8.0
"""Length of the straight arm in scene units."""
LINK_Z = (0.72, 0.96)
"""Front and back of a link, in the frame of its joint: in the plane of the actuator's link."""
STEP_Z = 2.78
"""From joint to joint along the axes: the gearbox of joint 2 is mounted on link 1."""
_TIP_Z = 0.84
"""From the last joint to the plane of the tip along the axes."""
_FLANGE_Z = (LINK_Z[0] - 0.04, LINK_Z[1] + 0.04)


def find_tip_z(joints: int) -> float:
    """Return the plane of the tip along the axes, in the frame "/a"."""
    return STEP_Z * (joints - 1) + _TIP_Z


def build_link(length: float) -> Group:
    """A link from the ring of its joint to the flange of the next joint, at x = `length`."""
    bars = [make_bar((0.86, 0.0, 0.3), (length, 0.0, 0.42), LINK_Z)]
    flange = [make_ring(0.36, 0.56, _FLANGE_Z, bevel=0.03)]
    for part in flange:
        part.apply_translation((length, 0.0, 0.0))
    return [look.paint(join(bars), look.LINK), look.paint(join(flange), look.STEEL)]


def build_last_link(length: float) -> Group:
    """The last link from the ring of its joint to the tip, at x = `length`."""
    bar = make_bar((0.86, 0.0, 0.28), (length, 0.0, 0.13), LINK_Z)
    tip = make_disc(0.17, (LINK_Z[0] - 0.05, LINK_Z[1] + 0.12), bevel=0.04, at=(length, 0.0))
    return [look.paint(join([bar]), look.LINK), look.paint(join([tip]), look.STEEL)]


def build_ghost_link(length: float, finish: look.Finish) -> Group:
    """The link of the reference: wider and thinner than the link."""
    return [
        look.paint(join([make_bar((0.0, 0.0, 0.46), (length, 0.0, 0.46), (0.8, 0.88))]), finish)
    ]


def build_outline(length: float, finish: look.Finish) -> Group:
    """The frame of a link of the comparison."""
    sides = [make_bar((0.0, y, 0.05), (length, y, 0.05), (0.8, 0.9)) for y in (-0.34, 0.34)]
    ends = [make_ring(0.3, 0.4, (0.78, 0.92), bevel=0.0) for _ in range(2)]
    ends[1].apply_translation((length, 0.0, 0.0))
    return [look.paint(join([*sides, *ends]), finish)]


def build_mass() -> Group:
    """A cylinder on a rod from the origin along +x: 1 kg, scaled with the root of the mass."""
    rod = make_plate([(0.0, -0.04), (0.9, -0.04), (0.9, 0.04), (0.0, 0.04)], (-0.04, 0.04))
    disc = make_disc(0.55, (0.8, 1.5), bevel=0.06)
    disc.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, (0.0, 1.0, 0.0)))
    return [look.paint(join([rod]), look.STEEL), look.paint(join([disc]), look.IRON)]


def build_shaft() -> trimesh.Trimesh:
    """Shaft of an arrow of unit length along +y."""
    return join([make_plate([(-0.07, 0.0), (0.07, 0.0), (0.07, 1.0), (-0.07, 1.0)], (-0.07, 0.07))])


def build_head() -> trimesh.Trimesh:
    """Head of an arrow along +y."""
    return join([make_arrow_head(0.24, 0.55)])


def build_wall(length: float, tip_z: float) -> trimesh.Trimesh:
    """A wall at y < 0, whose surface is y = 0."""
    half = length / 2.0
    return join(
        [make_plate([(-half, -0.4), (half, -0.4), (half, 0.0), (-half, 0.0)], (-1.0, tip_z + 1.0))]
    )


def build_disc_and_edge() -> tuple[trimesh.Trimesh, trimesh.Trimesh]:
    """A unit disc about the origin and its edge; scaled, they are an ellipse."""
    angle = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    edge = np.column_stack([np.cos(angle), np.sin(angle)])
    disc = make_plate(edge, (-0.004, 0.004))
    return disc, make_ring(0.95, 1.0, (-0.012, 0.012), bevel=0.0)
