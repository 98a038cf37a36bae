"""Torques as curved arrows about their axis: longer with the torque, turned with its sign."""

import math
from functools import cache
from typing import NamedTuple

import trimesh
import viser

from svsa_scene import appearance as look
from svsa_scene.geometry import join, make_arc, make_arrow_head, turn, turn_over
from svsa_scene.moved import Moved
from svsa_scene.names import add_label
from svsa_scene.pose import ActuatorPose

SMALLEST_NM = 0.05
LONGEST_NM = 20.0
_PIECES = 7
_PIECE = 0.45
_LONGEST = (_PIECES + 1) * _PIECE
_WIRE = 0.05
_HEAD = 0.3
_TOP = math.pi


def compute_arc(torque_nm: float) -> float:
    """Angle of an arrow, rad: with the root of the torque, so that small ones are seen, from
    0.45 rad at 0.05 N·m, below which none is drawn, to 3.6 rad at 20 N·m and above.
    """
    size = abs(torque_nm)
    if size < SMALLEST_NM:
        return 0.0
    low, high = math.sqrt(SMALLEST_NM), math.sqrt(LONGEST_NM)
    share = (math.sqrt(min(size, LONGEST_NM)) - low) / (high - low)
    return _PIECE + share * (_LONGEST - _PIECE)


class ArrowPlace(NamedTuple):
    """Position of an arrow, in scene units.

    Attributes:
        node: Name of its frame, a child of the part with which it moves.
        radius: Radius of its circle about the axis.
        z: Position of the circle along the axis.
        foot: Angle about z at which it begins, rad.
    """

    node: str
    radius: float
    z: float
    foot: float


class TorqueArrow:
    """One torque: as many pieces of arc as fit, and a head with a piece behind it that ends the arc
    at an angle proportional to the torque. A positive torque turns like q, counter-clockwise.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        moved: Moved,
        place: ArrowPlace,
        color: look.Rgb,
        label: str,
    ) -> None:
        self._moved = moved
        self._place = place
        self._shown = 0
        scene = server.scene
        node, radius = place.node, place.radius
        self._root = scene.add_frame(
            node, show_axes=False, position=(0.0, 0.0, place.z), visible=False
        )
        arc = _build_piece(radius)
        self._pieces = [
            scene.add_mesh_simple(
                f"{node}/{number}",
                arc.vertices,
                arc.faces,
                color=color,
                wxyz=turn(number * _PIECE),
                visible=False,
                cast_shadow=False,
            )
            for number in range(_PIECES)
        ]
        self._head = scene.add_frame(f"{node}/h", show_axes=False)
        head = _build_head(radius)
        scene.add_mesh_simple(
            f"{node}/h/m", head.vertices, head.faces, color=color, cast_shadow=False
        )
        if label:
            add_label(server, f"{node}/h/t", label, (radius + 2 * _WIRE, 0.4 * _HEAD, 0.0))

    def show(self, torque_nm: float) -> None:
        """Turn with the torque; a very small torque is not drawn."""
        arc = compute_arc(torque_nm)
        shown = math.ceil(arc / _PIECE)
        if shown != self._shown:
            self._show_pieces(shown)
        if not shown:
            return
        way = -1.0 if torque_nm < 0.0 else 1.0
        node, foot = self._place.node, self._place.foot
        if self._moved.is_due(f"{node}/way", (way,)):
            self._root.wxyz = turn(foot) if way > 0.0 else turn_over(foot)
        if self._moved.is_due(f"{node}/arc", (arc,)):
            self._head.wxyz = turn(arc)

    def _show_pieces(self, shown: int) -> None:
        """Show this number of pieces, including the head; 0 hides the arrow."""
        if (shown > 0) != (self._shown > 0):
            self._root.visible = shown > 0
        for number, piece in enumerate(self._pieces):
            is_seen = number < shown - 1
            if piece.visible != is_seen:
                piece.visible = is_seen
        self._shown = shown


class TorqueArrows:
    """Arrows: u1 and w4 about the principal motor, u2 and w6 about the stiffness motor, w2 on the
    link's ring.

    Those of the motors begin at the top and do not turn with them; their radius is so large that
    the link's ring does not hide them in the front view.
    """

    def __init__(
        self, server: viser.ViserServer, moved: Moved, root: str, has_labels: bool
    ) -> None:
        def add(place: ArrowPlace, color: look.Rgb, label: str) -> TorqueArrow:
            place = place._replace(node=f"{root}/{place.node}")
            return TorqueArrow(server, moved, place, color, label if has_labels else "")

        self._torque1 = add(ArrowPlace("u1", 1.3, -2.95, _TOP), look.PRINCIPAL.color, "u₁")
        self._motor1 = add(ArrowPlace("w4", 1.3, -2.4, _TOP), look.DISTURBANCE, "w₄")
        self._torque2 = add(ArrowPlace("u2", 1.1, -1.0, _TOP), look.SECONDARY.color, "u₂")
        self._motor2 = add(ArrowPlace("w6", 1.1, -0.45, _TOP), look.DISTURBANCE, "w₆")
        self._link = add(ArrowPlace("l/w2", 0.84, 1.0, 0.0), look.DISTURBANCE, "w₂")

    def show(self, pose: ActuatorPose) -> None:
        """Every torque of the pose."""
        self._torque1.show(pose.torque1_nm)
        self._torque2.show(pose.torque2_nm)
        self._link.show(pose.disturbance_link_nm)
        self._motor1.show(pose.disturbance_motor1_nm)
        self._motor2.show(pose.disturbance_motor2_nm)


@cache
def _build_piece(radius: float) -> trimesh.Trimesh:
    """A piece of arc, from +x on."""
    return join([make_arc(radius, _WIRE, _PIECE)])


@cache
def _build_head(radius: float) -> trimesh.Trimesh:
    """The end marker of an arc at +x."""
    cone = make_arrow_head(3.2 * _WIRE, _HEAD)
    cone.apply_translation((radius, 0.0, 0.0))
    return join([make_arc(radius, _WIRE, -_PIECE), cone])
