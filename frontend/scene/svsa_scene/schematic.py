"""Schematic of an actuator other than the SVSA: the parts that its file draws, moved by pose."""

import math

import trimesh
import viser

from svsa.actuators.drawing import Body, Kind, Part, draw_torsion_spring
from svsa.actuators.mechanism import Mechanism
from svsa.actuators.parameters import MechanismParameters
from svsa_scene import appearance as look
from svsa_scene.geometry import join, make_disc, make_helix, make_plate, turn
from svsa_scene.mechanism import LEVER_Z, SPRING_Z
from svsa_scene.moved import Moved
from svsa_scene.pose import ActuatorPose

_FINISHES: dict[Body, look.Finish] = {
    "motor1": look.PRINCIPAL,
    "motor2": look.SECONDARY,
    "link": look.LINK,
    "lever": look.LEVER,
}
_ELASTIC: tuple[Kind, ...] = ("leaf", "spring")
_HEIGHTS: dict[Kind, float] = {
    "rod": LEVER_Z + 0.1,
    "leaf": LEVER_Z + 0.1,
    "spring": SPRING_Z + 0.1,
    "pin": LEVER_Z + 0.1,
}
_SHORTEST = 1e-3


class Schematic:
    """Rods, springs and pins of a mechanism in the frame of motor 1.

    Every part is a mesh of unit length along +y, turned and scaled from its start to its end.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        moved: Moved,
        mechanism: Mechanism,
        parameters: MechanismParameters,
        root: str,
    ) -> None:
        self._moved = moved
        self._root = root
        self._draw = mechanism.draw or draw_torsion_spring
        self._parameters = parameters
        self._scene = server.scene
        low, _ = mechanism.coordinate
        self._kinds = [part.kind for part in self._draw(parameters, low, 0.0)]
        self._nodes = [
            self._add(number, part) for number, part in enumerate(self._draw(parameters, low, 0.0))
        ]

    def _add(self, number: int, part: Part) -> viser.MeshHandle:
        solid = _build_part(part.kind)
        finish = _FINISHES[part.body]
        color = look.get_stiffness_color(0) if part.kind in _ELASTIC else finish.color
        return self._scene.add_mesh_simple(
            f"{self._root}/c/p{number}",
            solid.vertices,
            solid.faces,
            color=color,
            position=(0.0, 0.0, _HEIGHTS[part.kind]),
        )

    def move(self, pose: ActuatorPose, deflection: float) -> None:
        """Move every part to the pose; `deflection` is φ, rad."""
        parts = self._draw(self._parameters, pose.lever_ratio, deflection)
        for number, (node, part) in enumerate(zip(self._nodes, parts, strict=True)):
            if not self._moved.is_due(f"part{number}", (*part.start, *part.end)):
                continue
            x, y = part.end[0] - part.start[0], part.end[1] - part.start[1]
            node.position = (*part.start, _HEIGHTS[part.kind])
            if part.kind != "pin":
                node.wxyz = turn(math.atan2(-x, y))
                node.scale = (1.0, max(math.hypot(x, y), _SHORTEST), 1.0)

    def color(self, color: look.Rgb) -> None:
        """Color the springs."""
        for kind, node in zip(self._kinds, self._nodes, strict=True):
            if kind in _ELASTIC:
                node.color = color


def _build_part(kind: Kind) -> trimesh.Trimesh:
    if kind == "spring":
        return join([make_helix(0.09, 0.022, 7)])
    if kind == "pin":
        return join([make_disc(0.085, (-0.06, 0.12), bevel=0.015)])
    return join([make_plate([(-0.05, 0.0), (0.05, 0.0), (0.05, 1.0), (-0.05, 1.0)], (-0.04, 0.04))])
