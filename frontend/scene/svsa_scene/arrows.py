"""Torques as arrows: tangential, longer with the torque, turned with its sign."""

import math

import viser

from svsa_scene import appearance as look
from svsa_scene.geometry import make_arrow_head, make_arrow_shaft, turn
from svsa_scene.moved import Moved
from svsa_scene.pose import ActuatorPose

_SMALLEST_NM = 0.05
_LENGTH_AT_1_NM = 0.36
_LONGEST = 1.5
_WIDTH = 0.045
_HEAD = 0.26
_TOP = math.pi


def compute_arrow_length(torque_nm: float) -> float:
    """Length of an arrow, scene units: as the root of the torque, so that small ones are seen."""
    size = abs(torque_nm)
    return min(_LENGTH_AT_1_NM * math.sqrt(size), _LONGEST) if size >= _SMALLEST_NM else 0.0


class TorqueArrow:
    """One torque at a place of a frame.

    name: the arrow's frame, below the one that it moves with. place: its foot there. heading:
    the angle about z at which it points along +y for a positive torque, rad.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        moved: Moved,
        name: str,
        place: tuple[float, float, float],
        heading: float,
        color: look.Rgb,
        label: str,
    ) -> None:
        self._moved = moved
        self._name = name
        self._heading = heading
        self._shown = False
        scene = server.scene
        self._root = scene.add_frame(name, show_axes=False, position=place, visible=False)
        shaft, head = make_arrow_shaft(_WIDTH), make_arrow_head(3.2 * _WIDTH, _HEAD)
        self._shaft = scene.add_mesh_simple(
            f"{name}/s", shaft.vertices, shaft.faces, color=color, cast_shadow=False
        )
        self._head = scene.add_frame(f"{name}/h", show_axes=False)
        scene.add_mesh_simple(
            f"{name}/h/m", head.vertices, head.faces, color=color, cast_shadow=False
        )
        scene.add_label(
            f"{name}/h/t",
            label,
            position=(0.0, _HEAD + 0.16, 0.0),
            anchor="center-center",
            font_screen_scale=1.0,
        )

    def show(self, torque_nm: float) -> None:
        """Point along the torque; too small a one is not drawn."""
        length = compute_arrow_length(torque_nm)
        if (length > 0.0) != self._shown:
            self._shown = length > 0.0
            self._root.visible = self._shown
        if not self._shown:
            return
        angle = self._heading + (math.pi if torque_nm < 0.0 else 0.0)
        if self._moved.is_due(f"{self._name}/turn", (angle,)):
            self._root.wxyz = turn(angle)
        if self._moved.is_due(f"{self._name}/length", (length,)):
            self._shaft.scale = (1.0, length, 1.0)
            self._head.position = (0.0, length, 0.0)


class TorqueArrows:
    """u1 and w4 on the principal motor, u2 and w6 on the stiffness motor, w2 on the link's arm.

    Those of the motors stand above them and do not turn, so that they stay in sight.
    """

    def __init__(self, server: viser.ViserServer, moved: Moved) -> None:
        def add(
            name: str,
            place: tuple[float, float, float],
            heading: float,
            color: look.Rgb,
            label: str,
        ) -> TorqueArrow:
            return TorqueArrow(server, moved, name, place, heading, color, label)

        self._torque1 = add("/a/u1", (-0.66, 0.0, -2.95), _TOP, look.PRINCIPAL.color, "u₁")
        self._torque2 = add("/a/u2", (-1.05, 0.0, -0.95), _TOP, look.SECONDARY.color, "u₂")
        self._motor1 = add("/a/w4", (-0.66, 0.0, -2.5), _TOP, look.DISTURBANCE, "w₄")
        self._motor2 = add("/a/w6", (-1.05, 0.0, -0.5), _TOP, look.DISTURBANCE, "w₆")
        self._link = add("/a/l/w2", (1.28, 0.0, 1.0), 0.0, look.DISTURBANCE, "w₂")

    def show(self, pose: ActuatorPose) -> None:
        """Every torque of the pose."""
        self._torque1.show(pose.torque1_nm)
        self._torque2.show(pose.torque2_nm)
        self._link.show(pose.disturbance_link_nm)
        self._motor1.show(pose.disturbance_motor1_nm)
        self._motor2.show(pose.disturbance_motor2_nm)
