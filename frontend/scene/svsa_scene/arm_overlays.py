"""Overlays of an arm: reference and comparison, path of the tip, stiffness ellipse."""

import math
from collections import deque
from collections.abc import Callable, Sequence

import numpy as np
import viser

from svsa_scene import appearance as look
from svsa_scene import arm_solids as solids
from svsa_scene import mechanism
from svsa_scene.arm_solids import REACH
from svsa_scene.geometry import turn
from svsa_scene.moved import Moved
from svsa_scene.names import add_label
from svsa_scene.tip import StiffnessEllipse, sum_pairs

TRAIL_POINTS = 90
_TRAIL_EVERY = 2
_JUMP = 0.25 * REACH
_ELLIPSE_COLOR: look.Rgb = (122, 82, 186)
_FULL_AXIS = 0.32 * REACH
_MOST_AXIS = 0.5 * REACH


class OtherArm:
    """Links without mechanisms: the reference, or the comparison."""

    def __init__(
        self,
        server: viser.ViserServer,
        moved: Moved,
        root: str,
        lengths: Sequence[float],
        name: str,
    ) -> None:
        self._scene, self._moved, self._lengths = server.scene, moved, lengths
        self._links = [server.scene.add_frame(root, show_axes=False)]
        for number, length in enumerate(lengths[:-1], start=2):
            node, at = f"{self._links[-1].name}/{number}", (length, 0.0, solids.STEP_Z)
            self._links.append(server.scene.add_frame(node, show_axes=False, position=at))
        self._name = name
        place = (0.8 * lengths[-1], -0.4, 0.9)
        self._label = add_label(server, f"{self._links[-1].name}/t", name or " ", place)

    def paint(self, build: Callable[..., mechanism.Group], finish: look.Finish) -> None:
        """Draw the links."""
        for link, length in zip(self._links, self._lengths, strict=True):
            self._scene.add_glb(f"{link.name}/solid", mechanism.export(build, length, finish))

    def show(self, q: Sequence[float] | None, name: str = "") -> None:
        """Show it at these angles, rad; None hides it."""
        if self._links[0].visible != (q is not None):
            self._links[0].visible = q is not None
        if q is None:
            return
        if name and name != self._name:
            self._name = self._label.text = name
        for link, angle in zip(self._links, q, strict=True):
            if self._moved.is_due(link.name, (angle,)):
                link.wxyz = turn(angle)


class Trail:
    """The path of a point over the last seconds, in the plane of the tip."""

    def __init__(
        self, server: viser.ViserServer, node: str, color: look.Rgb, thickness: float, tip_z: float
    ) -> None:
        self._lines = server.scene.add_line_segments(
            node,
            np.zeros((1, 2, 3)),
            color,
            thickness=thickness,
            thickness_units="screen",
            position=(0.0, 0.0, tip_z),
            visible=False,
        )
        self._points: deque[tuple[float, float]] = deque(maxlen=TRAIL_POINTS)
        self._count = 0

    def add(self, tip: tuple[float, float]) -> None:
        """Move the point. A jump starts the path again."""
        if self._points and math.dist(self._points[-1], tip) > _JUMP:
            self._points.clear()
        self._count += 1
        if self._count % _TRAIL_EVERY == 0:
            self._points.append(tip)
            self.draw(self._points)

    def draw(self, points: Sequence[tuple[float, float]]) -> None:
        """Draw a path, (x, y) in scene units."""
        if len(points) < 2:
            return
        path = np.array([(-y, x, 0.0) for x, y in points])
        self._lines.points = np.stack([path[:-1], path[1:]], axis=1).astype(np.float32)
        if not self._lines.visible:
            self._lines.visible = True


class Ellipse:
    """Stiffness of the tip as an ellipse: half axes with the root of K, so that soft and stiff are
    both seen. `_FULL_AXIS` is that of the greatest stiffness of the joints over the sum of the
    products of each two lengths.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        moved: Moved,
        stiffness: float,
        lengths: Sequence[float],
        tip_z: float,
    ) -> None:
        self._moved, self._tip_z = moved, tip_z
        self._scale = _FULL_AXIS / math.sqrt(stiffness) * math.sqrt(sum_pairs(lengths))
        scene = server.scene
        self._frame = scene.add_frame("/a/k", show_axes=False, visible=False)
        disc, edge = solids.build_disc_and_edge()
        self._disc = scene.add_mesh_simple(
            "/a/k/d",
            disc.vertices,
            disc.faces,
            color=_ELLIPSE_COLOR,
            opacity=0.22,
            side="double",
            cast_shadow=False,
        )
        self._edge = scene.add_mesh_simple(
            "/a/k/e", edge.vertices, edge.faces, color=_ELLIPSE_COLOR, cast_shadow=False
        )

    def show(self, tip: tuple[float, float], ellipse: StiffnessEllipse | None) -> None:
        """Draw the ellipse at the tip; a straight or folded arm has none."""
        if self._frame.visible != (ellipse is not None):
            self._frame.visible = ellipse is not None
        if ellipse is None:
            return
        at = (-tip[1], tip[0], self._tip_z - 0.2)
        if self._moved.is_due("ellipse at", at):
            self._frame.position = at
        axes = [
            min(self._scale * math.sqrt(k), _MOST_AXIS) for k in (ellipse.greatest, ellipse.least)
        ]
        if self._moved.is_due("ellipse", (*axes, ellipse.angle)):
            self._frame.wxyz = turn(ellipse.angle + math.pi / 2)
            self._disc.scale = self._edge.scale = (axes[0], max(axes[1], 0.02), 1.0)
