"""Solids of which the actuator is built. Axis of turned parts: z. Lengths are scene units."""

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import trimesh
from trimesh.creation import revolve

Array = npt.NDArray[np.float64]
_SECTIONS = 56


def make_disc(
    radius: float, z: tuple[float, float], *, bevel: float = 0.02, at: tuple[float, float] = (0, 0)
) -> trimesh.Trimesh:
    """A bevelled disc or cylinder between two heights, its axis through `at`."""
    low, high = z
    profile = [
        (0.0, low),
        (radius - bevel, low),
        (radius, low + bevel),
        (radius, high - bevel),
        (radius - bevel, high),
        (0.0, high),
    ]
    return _revolve(profile, at)


def make_ring(
    inner: float, outer: float, z: tuple[float, float], *, bevel: float = 0.02
) -> trimesh.Trimesh:
    """A bevelled ring between two radii and two heights, about the origin."""
    low, high = z
    profile = [
        (inner, low),
        (outer - bevel, low),
        (outer, low + bevel),
        (outer, high - bevel),
        (outer - bevel, high),
        (inner + bevel, high),
        (inner, high - bevel),
        (inner, low),
    ]
    return _revolve(profile, (0.0, 0.0))


def make_plate(outline: npt.ArrayLike, z: tuple[float, float]) -> trimesh.Trimesh:
    """A prism between two heights over a convex outline, (n, 2), counter-clockwise."""
    edge = np.asarray(outline, dtype=float)
    count = len(edge)
    centre = edge.mean(axis=0)
    layers = [np.column_stack([np.vstack([edge, centre]), np.full(count + 1, h)]) for h in z]
    index = np.arange(count)
    after = np.roll(index, -1)
    top = count + 1
    faces = np.vstack(
        [
            np.column_stack([after, index, np.full(count, count)]),
            np.column_stack([index + top, after + top, np.full(count, count + top)]),
            np.column_stack([index, after, after + top]),
            np.column_stack([index, after + top, index + top]),
        ]
    )
    return trimesh.Trimesh(np.vstack(layers), faces, process=False)


def make_bar(
    start: tuple[float, float, float], end: tuple[float, float, float], z: tuple[float, float]
) -> trimesh.Trimesh:
    """A flat bar with round ends between two (x, y, half width), tapered between them."""
    (x0, y0, r0), (x1, y1, r1) = start, end
    heading = np.arctan2(y1 - y0, x1 - x0)
    lean = np.arcsin((r0 - r1) / np.hypot(x1 - x0, y1 - y0))
    far = heading + np.linspace(-np.pi / 2 + lean, np.pi / 2 - lean, 24)
    near = heading + np.linspace(np.pi / 2 - lean, 3 * np.pi / 2 + lean, 24)
    outline = np.vstack(
        [
            np.column_stack([x1 + r1 * np.cos(far), y1 + r1 * np.sin(far)]),
            np.column_stack([x0 + r0 * np.cos(near), y0 + r0 * np.sin(near)]),
        ]
    )
    return make_plate(outline, z)


def make_tube(path: Array, radius: float, *, sections: int = 10) -> trimesh.Trimesh:
    """A round wire of the given radius along a smooth path, (n, 3), with closed ends."""
    tangent = np.gradient(path, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    normal = np.empty_like(path)
    normal[0] = np.cross(tangent[0], np.eye(3)[np.argmin(np.abs(tangent[0]))])
    for i in range(1, len(path)):
        normal[i] = normal[i - 1] - tangent[i] * (normal[i - 1] @ tangent[i])
        normal[i] /= np.linalg.norm(normal[i])
    normal[0] /= np.linalg.norm(normal[0])
    binormal = np.cross(tangent, normal)
    around = np.linspace(0.0, 2 * np.pi, sections, endpoint=False)
    rings = path[:, None, :] + radius * (
        np.cos(around)[None, :, None] * normal[:, None, :]
        + np.sin(around)[None, :, None] * binormal[:, None, :]
    )
    vertices = np.vstack([rings.reshape(-1, 3), path[:1], path[-1:]])
    step = np.arange(len(path) - 1)[:, None] * sections
    here = step + np.arange(sections)
    beyond = step + np.roll(np.arange(sections), -1)
    first, last = len(vertices) - 2, len(vertices) - 1
    rim = np.arange(sections)
    end = (len(path) - 1) * sections
    faces = np.vstack(
        [
            np.column_stack([here.ravel(), beyond.ravel(), (beyond + sections).ravel()]),
            np.column_stack([here.ravel(), (beyond + sections).ravel(), (here + sections).ravel()]),
            np.column_stack([np.roll(rim, -1), rim, np.full(sections, first)]),
            np.column_stack([end + rim, end + np.roll(rim, -1), np.full(sections, last)]),
        ]
    )
    return trimesh.Trimesh(vertices, faces, process=False)


def make_helix(radius: float, wire: float, turns: int) -> trimesh.Trimesh:
    """A spring of unit length along +y from the origin; scaled along y it changes its length."""
    angle = np.linspace(0.0, 2 * np.pi * turns, 18 * turns + 1)
    path = np.column_stack([radius * np.cos(angle), angle / angle[-1], radius * np.sin(angle)])
    return make_tube(path, wire, sections=8)


def make_arc(radius: float, wire: float, angle: float) -> trimesh.Trimesh:
    """A round wire on a circle about z, from +x through an angle, rad (below 0: clockwise)."""
    along = np.linspace(0.0, angle, 10)
    path = radius * np.column_stack([np.cos(along), np.sin(along), np.zeros_like(along)])
    return make_tube(path, wire, sections=8)


def make_arrow_head(radius: float, length: float) -> trimesh.Trimesh:
    """A cone along +y, its base at the origin."""
    cone = revolve(np.array([(0.0, 0.0), (radius, 0.0), (0.0, length)]), sections=20)
    cone.apply_transform(trimesh.transformations.rotation_matrix(-np.pi / 2, (1.0, 0.0, 0.0)))
    return join([cone])


def make_spiral(
    pitch: float, turns: tuple[float, float], offset: float, z: float, wire: float
) -> trimesh.Trimesh:
    """Make a ridge along the Archimedean spiral r = pitch·α/2π + offset on a plate.

    α counts clockwise from −x, so that turning the plate by α moves radius r onto −x.
    """
    angle = 2 * np.pi * np.linspace(turns[0], turns[1], 90)
    r = pitch * angle / (2 * np.pi) + offset
    path = np.column_stack([-r * np.cos(angle), r * np.sin(angle), np.full_like(r, z)])
    return make_tube(path, wire)


def turn(angle: float) -> tuple[float, float, float, float]:
    """The rotation about z by an angle, rad, as the quaternion (w, x, y, z)."""
    return (math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2))


def turn_over(angle: float) -> tuple[float, float, float, float]:
    """Half a turn about x, then one about z by an angle, rad: what ran counter-clockwise from +x
    runs clockwise from there.
    """
    return (0.0, math.cos(angle / 2), math.sin(angle / 2), 0.0)


def scale_sector(angle: float) -> tuple[float, float, float]:
    """The scale at which `make_sector` spans an angle, rad; a little where it is 0."""
    return (math.cos(angle / 2), max(2 * abs(math.sin(angle / 2)), 1e-3), 1.0)


def make_sector(inner: float, outer: float) -> trimesh.Trimesh:
    """A flat trapezoid about −x for a scaled sector: scaled by `scale_sector(φ)`, it is the
    part between two radii of the triangle that the angle φ spans.
    """
    vertices = [
        (-inner, -inner / 2, 0.0),
        (-outer, -outer / 2, 0.0),
        (-outer, outer / 2, 0.0),
        (-inner, inner / 2, 0.0),
    ]
    return trimesh.Trimesh(vertices, [(0, 2, 1), (0, 3, 2)], process=False)


def join(parts: Sequence[trimesh.Trimesh]) -> trimesh.Trimesh:
    """One mesh of several, its normals smooth over curves and split at edges."""
    offsets = np.cumsum([0, *(len(part.vertices) for part in parts)])
    merged = trimesh.Trimesh(
        np.vstack([part.vertices for part in parts]),
        np.vstack([part.faces + at for part, at in zip(parts, offsets, strict=False)]),
    )
    return trimesh.graph.smooth_shade(merged, angle=0.6)


def _revolve(profile: list[tuple[float, float]], at: tuple[float, float]) -> trimesh.Trimesh:
    solid = revolve(np.asarray(profile), sections=_SECTIONS)
    solid.apply_translation((at[0], at[1], 0.0))
    return solid
