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
from svsa_scene.tip import Lengths, StiffnessEllipse

TRAIL_POINTS = 90
_TRAIL_EVERY = 2
_JUMP = 0.25 * REACH
_ELLIPSE_COLOR: look.Rgb = (122, 82, 186)
_FULL_AXIS = 0.32 * REACH
_MOST_AXIS = 0.5 * REACH


class OtherArm:
    """Links without mechanisms: the reference, or the comparison."""

    def __init__(
        self, server: viser.ViserServer, moved: Moved, root: str, lengths: Lengths, name: str
    ) -> None:
        self._scene, self._moved, self._root, self._lengths = server.scene, moved, root, lengths
        at = (lengths.link1, 0.0, solids.STEP_Z)
        self._link1 = server.scene.add_frame(root, show_axes=False)
        self._link2 = server.scene.add_frame(f"{root}/2", show_axes=False, position=at)
        self._name = name
        place = (0.8 * lengths.link2, -0.4, 0.9)
        self._label = add_label(server, f"{root}/2/t", name or " ", place)

    def paint(self, build: Callable[..., mechanism.Group], finish: look.Finish) -> None:
        """Draw both links."""
        for node, length in zip((self._root, f"{self._root}/2"), self._lengths, strict=True):
            self._scene.add_glb(f"{node}/solid", mechanism.export(build, length, finish))

    def show(self, q: tuple[float, float] | None, name: str = "") -> None:
        """Show it at these angles, rad; None hides it."""
        if self._link1.visible != (q is not None):
            self._link1.visible = q is not None
        if q is None:
            return
        if name and name != self._name:
            self._name = self._label.text = name
        for number, (node, angle) in enumerate(zip((self._link1, self._link2), q, strict=True)):
            if self._moved.is_due(f"{self._root}{number}", (angle,)):
                node.wxyz = turn(angle)


class Trail:
    """The path of a point over the last seconds, in the plane of the tip."""

    def __init__(
        self, server: viser.ViserServer, node: str, color: look.Rgb, thickness: float
    ) -> None:
        self._lines = server.scene.add_line_segments(
            node,
            np.zeros((1, 2, 3)),
            color,
            thickness=thickness,
            thickness_units="screen",
            position=(0.0, 0.0, solids.TIP_Z),
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
    both seen. `_FULL_AXIS` is that of the greatest stiffness of the joints over l1 l2.
    """

    def __init__(
        self, server: viser.ViserServer, moved: Moved, stiffness: float, lengths: Lengths
    ) -> None:
        self._moved = moved
        self._scale = _FULL_AXIS / math.sqrt(stiffness / (lengths.link1 * lengths.link2))
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
        at = (-tip[1], tip[0], solids.TIP_Z - 0.2)
        if self._moved.is_due("ellipse at", at):
            self._frame.position = at
        axes = [
            min(self._scale * math.sqrt(k), _MOST_AXIS) for k in (ellipse.greatest, ellipse.least)
        ]
        if self._moved.is_due("ellipse", (*axes, ellipse.angle)):
            self._frame.wxyz = turn(ellipse.angle + math.pi / 2)
            self._disc.scale = self._edge.scale = (axes[0], max(axes[1], 0.02), 1.0)
