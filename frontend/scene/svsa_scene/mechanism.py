"""The actuator's solid parts, each group in the frame with which it moves.

z of a part is its position along the joint axis, from the motor at the back (negative) to the link
in front. Colors show the axis: blue turns with θ1, brass with θ2, white with q.
"""

from collections.abc import Callable, Hashable
from functools import cache

import numpy as np
import trimesh
from trimesh.exchange.gltf import export_glb

from svsa_scene import appearance as look
from svsa_scene.geometry import (
    join,
    make_bar,
    make_disc,
    make_plate,
    make_ring,
    make_spiral,
    make_tube,
)
from svsa_scene.linkage import BLOCK_HALF_WIDTH, LOAD_ARM, RADIUS, SPRING_ANCHOR

AXIS_HEIGHT = 2.5
LEVER_Z = 0.83
SPRING_Z = 0.95
SECTOR_Z = 0.99
HOOK_Z = 1.3

Group = list[trimesh.Trimesh]


def build_stand(floor: float = AXIS_HEIGHT) -> Group:
    """Base plate, two uprights and the principal motor's body: what does not move. floor: height
    of the axis above it.
    """
    base = make_plate(
        [(floor - 0.14, -0.95), (floor, -0.95), (floor, 0.95), (floor - 0.14, 0.95)], (-3.75, -1.2)
    )
    uprights = [_make_upright(floor, z) for z in ((-3.45, -3.31), (-1.86, -1.7))]
    return [look.paint(join([base, *uprights]), look.FRAME), *build_principal_motor()]


def build_principal_motor() -> Group:
    """Body and gearbox of the principal motor."""
    motor = [make_disc(0.48, (-3.32, -2.2), bevel=0.05), make_disc(0.2, (-3.7, -3.3))]
    gearbox = [make_disc(0.44, (-2.2, -1.68), bevel=0.03)]
    return [
        look.paint(join(motor), look.PRINCIPAL),
        look.paint(join(gearbox), look.DARK),
    ]


def build_connector() -> Group:
    """Intermediate connector on the principal motor's shaft (θ1): cage, slot for the pivot, body
    of the stiffness motor, and the bearing on which the link turns.
    """
    shaft = make_disc(0.16, (-1.7, -1.42))
    back = make_disc(0.7, (-1.45, -1.33), bevel=0.025)
    front = make_ring(0.76, 0.92, (0.46, 0.6), bevel=0.025)
    posts = [
        make_disc(0.055, (-1.4, 0.48), at=(0.84 * np.cos(t), 0.84 * np.sin(t)))
        for t in np.radians([45.0, 135.0, 225.0, 315.0])
    ]
    lugs = [
        make_bar(
            (0.7 * np.cos(t), 0.7 * np.sin(t), 0.1),
            (0.84 * np.cos(t), 0.84 * np.sin(t), 0.1),
            (-1.45, -1.33),
        )
        for t in np.radians([45.0, 135.0, 225.0, 315.0])
    ]
    slot = [
        make_plate([(-0.8, y0), (0.1, y0), (0.1, y1), (-0.8, y1)], (0.5, 0.6))
        for y0, y1 in ((-0.13, -0.07), (0.07, 0.13))
    ]
    pointer = make_plate(
        [(-1.2, -0.012), (-0.88, -0.035), (-0.88, 0.035), (-1.2, 0.012)], (0.48, 0.58)
    )
    return [
        look.paint(join([shaft]), look.STEEL),
        look.paint(join([back, front, *posts, *lugs, *slot, pointer]), look.PRINCIPAL),
        *build_stiffness_motor(),
        look.paint(join([make_ring(0.78, 0.88, (0.6, 0.76))]), look.STEEL),
    ]


def build_carrier() -> Group:
    """Disc on the principal motor's shaft (θ1) of an actuator other than the SVSA: ring, bearing
    of the link and pointer.
    """
    shaft = make_disc(0.16, (-1.7, 0.6))
    back = make_disc(0.7, (-1.45, -1.33), bevel=0.025)
    front = make_disc(0.92, (0.46, 0.6), bevel=0.025)
    posts = [
        make_disc(0.055, (-1.4, 0.48), at=(0.62 * np.cos(t), 0.62 * np.sin(t)))
        for t in np.radians([45.0, 135.0, 225.0, 315.0])
    ]
    pointer = make_plate(
        [(-1.2, -0.012), (-0.88, -0.035), (-0.88, 0.035), (-1.2, 0.012)], (0.48, 0.58)
    )
    return [
        look.paint(join([shaft]), look.STEEL),
        look.paint(join([back, *posts, pointer]), look.PRINCIPAL),
        look.paint(join([front]), look.FRAME),
        look.paint(join([make_ring(0.78, 0.88, (0.6, 0.76))]), look.STEEL),
    ]


def build_stiffness_motor() -> Group:
    """Body of the stiffness motor, which the principal motor carries."""
    return [
        look.paint(join([make_disc(0.4, (-1.33, -0.4), bevel=0.05)]), look.SECONDARY),
        look.paint(join([make_disc(0.36, (-0.4, 0.02), bevel=0.03)]), look.DARK),
    ]


def build_spiral_plate() -> Group:
    """Plate on the stiffness motor's shaft with the Archimedean groove between two ridges."""
    plate = [make_disc(0.7, (0.16, 0.25), bevel=0.02), make_disc(0.12, (0.0, 0.34))]
    groove = [make_spiral(RADIUS, (0.2, 0.88), side, 0.27, 0.032) for side in (-0.075, 0.075)]
    mark = make_disc(0.045, (0.24, 0.29), at=(0.58, 0.0))
    return [
        look.paint(join(plate), look.SECONDARY),
        look.paint(join([*groove, mark]), look.DARK),
    ]


def build_pivot() -> Group:
    """Pin that the groove moves along the connector's slot; it carries the lever."""
    return [
        look.paint(join([make_disc(0.06, (0.26, 1.0), bevel=0.015)]), look.STEEL),
        look.paint(join([make_disc(0.095, (0.94, 1.05), bevel=0.02)]), look.SECONDARY),
    ]


def build_lever() -> Group:
    """Lever, from its hinge at the origin along +x."""
    arms = [
        make_bar((0.0, y, 0.03), (0.9, y, 0.03), (LEVER_Z - 0.035, LEVER_Z + 0.035))
        for y in (-0.085, 0.085)
    ]
    ends = [
        make_bar((x, -0.06, 0.055), (x, 0.06, 0.055), (LEVER_Z - 0.035, LEVER_Z + 0.035))
        for x in (0.0, 0.9)
    ]
    return [look.paint(join([*arms, *ends]), look.LEVER)]


def build_link() -> Group:
    """Output link (q): ring, arm, hook for the load at 68 mm, guide rod of the springs."""
    ring = make_ring(0.74, 0.9, (0.76, 0.92), bevel=0.03)
    arm = make_bar((0.85, 0.0, 0.2), (1.4, 0.0, 0.12), (0.78, 0.9))
    hinge = make_bar((-0.7, 0.0, 0.09), (-0.88, 0.0, 0.09), (0.77, 0.95))
    lug = make_bar((LOAD_ARM, 0.0, 0.09), (0.85, 0.0, 0.14), (0.78, 0.91))
    pointer = make_plate(
        [(-1.24, -0.012), (-0.88, -0.035), (-0.88, 0.035), (-1.24, 0.012)], (0.8, 0.9)
    )
    walls = [
        make_bar(
            (-0.1, side * (SPRING_ANCHOR + 0.04), 0.04),
            (0.1, side * (SPRING_ANCHOR + 0.04), 0.04),
            (0.8, 1.07),
        )
        for side in (-1, 1)
    ]
    feet = [
        make_bar((0.0, side * 0.66, 0.1), (0.0, side * 0.8, 0.1), (0.78, 0.86)) for side in (-1, 1)
    ]
    rod = np.column_stack([np.zeros(2), [-0.68, 0.68], np.full(2, SPRING_Z)])
    pins = [
        make_disc(0.05, (0.78, 1.0), at=(-RADIUS, 0.0)),
        make_disc(0.045, (0.9, HOOK_Z + 0.06), at=(LOAD_ARM, 0.0)),
    ]
    tip = make_disc(0.075, (0.88, 0.94), at=(1.4, 0.0))
    return [
        look.paint(join([ring, arm, hinge, lug, pointer, *walls, *feet]), look.LINK),
        look.paint(join([make_tube(rod, 0.028), *pins, tip]), look.STEEL),
    ]


def build_plain_link() -> Group:
    """Output link (q) of an actuator other than the SVSA: ring, arm, hook for the load."""
    ring = make_ring(0.78, 0.9, (0.76, 0.88), bevel=0.03)
    arm = make_bar((0.85, 0.0, 0.2), (1.4, 0.0, 0.12), (0.78, 0.9))
    pointer = make_plate(
        [(-1.24, -0.012), (-0.88, -0.035), (-0.88, 0.035), (-1.24, 0.012)], (0.8, 0.9)
    )
    hook = make_disc(0.045, (0.86, HOOK_Z + 0.06), at=(LOAD_ARM, 0.0))
    lug = make_bar((LOAD_ARM, 0.0, 0.06), (0.85, 0.0, 0.1), (0.78, 0.86))
    tip = make_disc(0.075, (0.88, 0.94), at=(1.4, 0.0))
    return [
        look.paint(join([ring, arm, lug, pointer]), look.LINK),
        look.paint(join([hook, tip]), look.STEEL),
    ]


def build_block() -> Group:
    """Block on the rod between the springs, moved by the lever's inner end."""
    half = BLOCK_HALF_WIDTH
    block = make_plate([(-0.1, -half), (0.1, -half), (0.1, half), (-0.1, half)], (0.86, 1.06))
    return [look.paint(join([block]), look.LEVER)]


def build_ghost() -> Group:
    """Outline of the link's arm and ring where the reference wants it, a little larger than it."""
    ring = make_ring(0.72, 0.93, (0.8, 0.86), bevel=0.0)
    arm = make_bar((0.95, 0.0, 0.215), (1.43, 0.0, 0.15), (0.74, 0.95))
    return [look.paint(join([ring, arm]), look.GHOST)]


def compute_comparison_tip(number: int) -> float:
    """Radius at which the outline of another lane's arm ends, slightly larger for each lane."""
    return 1.5 + 0.22 * number


def build_comparison(finish: look.Finish, number: int) -> Group:
    """Frame of a link's arm where another lane has it, each a little longer than the last."""
    tip = compute_comparison_tip(number)
    sides = [make_bar((0.98, y, 0.022), (tip, 0.75 * y, 0.022), (0.8, 0.9)) for y in (-0.2, 0.2)]
    cross = make_bar((tip, -0.15, 0.022), (tip, 0.15, 0.022), (0.8, 0.9))
    ring = make_ring(0.935, 0.965, (0.8, 0.88), bevel=0.0)
    return [look.paint(join([*sides, cross, ring]), finish)]


def build_load() -> Group:
    """Three discs on a rod, hung from the origin; 3 kg of iron at the scene's scale."""
    rod = np.column_stack([[0.0, 1.45], np.zeros(2), np.full(2, HOOK_Z)])
    discs = [_make_hung_disc(x) for x in (0.74, 1.01, 1.28)]
    return [
        look.paint(
            join([make_tube(rod, 0.028), make_ring(0.05, 0.085, (HOOK_Z - 0.03, HOOK_Z + 0.03))]),
            look.STEEL,
        ),
        look.paint(join(discs), look.IRON),
    ]


def build_limit_mark() -> Group:
    """Mark at −x next to the pointers, turned to the largest deflection allowed."""
    outline = [(-1.2, -0.015), (-0.96, -0.015), (-0.96, 0.015), (-1.2, 0.015)]
    return [look.paint(join([make_plate(outline, (SECTOR_Z - 0.02, SECTOR_Z + 0.02))]), look.LIMIT)]


@cache
def export(build: Callable[..., Group], *arguments: Hashable) -> bytes:
    """The group that this function builds, as one binary glTF: the same for every scene."""
    return export_glb(trimesh.Scene(build(*arguments)), include_normals=True)


def _make_upright(floor: float, z: tuple[float, float]) -> trimesh.Trimesh:
    arc = np.linspace(np.pi / 2, 3 * np.pi / 2, 32)
    top = np.column_stack([0.62 * np.cos(arc), 0.62 * np.sin(arc)])
    return make_plate(np.vstack([top, [(floor - 0.1, -0.8), (floor - 0.1, 0.8)]]), z)


def _make_hung_disc(x: float) -> trimesh.Trimesh:
    disc = make_disc(0.38, (x, x + 0.25), bevel=0.03)
    disc.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, (0.0, 1.0, 0.0)))
    disc.apply_translation((0.0, 0.0, HOOK_Z))
    return disc
