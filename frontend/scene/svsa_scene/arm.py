"""A two-joint arm in a viser scene: both mechanisms, links, tip path, loads and tip stiffness."""

from collections.abc import Callable

import numpy as np
import viser

from svsa.actuators.arm.parameters import ArmParameters
from svsa.actuators.installed import find_mechanism
from svsa.actuators.parameters import MechanismParameters
from svsa_scene import appearance as look
from svsa_scene import arm_solids as solids
from svsa_scene import mechanism
from svsa_scene.arm_loads import TipLoads
from svsa_scene.arm_overlays import Ellipse, OtherArm, Trail
from svsa_scene.arm_pose import ArmPose
from svsa_scene.arm_solids import REACH
from svsa_scene.moved import Moved
from svsa_scene.names import add_label
from svsa_scene.parts import ActuatorParts
from svsa_scene.tip import Lengths, compute_stiffness_ellipse, compute_tip

_FLOOR = REACH + 1.6
_TIP_COLOR: look.Rgb = look.COLORS[0]
_REFERENCE_COLOR: look.Rgb = look.GHOST.color


class ArmScene:
    """An arm as every viewer of a viser server sees it.

    Args:
        server: The viser server.
        links: The links of the plant.
        actuators: Parameters of the actuators of joint 1 and joint 2.
        has_trail: Whether the path of the last seconds is drawn.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        links: ArmParameters,
        actuators: tuple[MechanismParameters, MechanismParameters],
        has_trail: bool = True,
    ) -> None:
        self._server = server
        self._metres = Lengths(links.length1_m, links.length2_m)
        self._scale = REACH / self._metres.reach
        self._lengths = Lengths(
            self._metres.link1 * self._scale, REACH - self._metres.link1 * self._scale
        )
        look.set_stage(server, ground=-_FLOOR, cameras="arm", size=3.2)
        self.set_theme(dark=False)
        look.add_root(server)
        link1, link2 = self._lengths
        first = ActuatorParts(server, actuators[0], "/a", has_labels=False)
        self._add_solid("/a/stand", mechanism.build_stand, _FLOOR)
        self._add_solid("/a/l/1", solids.build_link1, link1)
        server.scene.add_frame("/a/l/2", show_axes=False, position=(link1, 0.0, solids.STEP_Z))
        second = ActuatorParts(server, actuators[1], "/a/l/2", has_labels=False)
        second.add("m", mechanism.build_principal_motor)
        self._add_solid("/a/l/2/l/1", solids.build_link2, link2)
        self._joints = first, second
        self._moved = Moved()
        self._ghost = OtherArm(server, self._moved, "/a/g", self._lengths, "q_d")
        self._ghost.paint(solids.build_ghost_link, look.GHOST)
        self._comparison = OtherArm(server, self._moved, "/a/r", self._lengths, "")
        self._comparison.paint(
            solids.build_outline, look.Finish(look.get_line_color(1), 0.0, 0.7, 0.85)
        )
        self._comparison.show(None)
        self._loads = TipLoads(server, self._moved, self._scale)
        stiffest = [find_mechanism(one).limits.stiffness_max_nm_per_rad for one in actuators]
        self._ellipse = Ellipse(server, self._moved, max(stiffest), self._metres)
        self._trails = (
            Trail(server, "/a/t", _TIP_COLOR, 3.0),
            Trail(server, "/a/td", _REFERENCE_COLOR, 2.0),
        )
        self._has_trail = has_trail
        for number, node in enumerate(("/a/l/n1", "/a/l/2/l/n2"), start=1):
            server.scene.add_frame(node, show_axes=False)
            place = (0.55 * self._lengths[number - 1], 0.3, 0.98)
            add_label(server, f"{node}/t", f"q_{number}", place)

    def set_theme(self, dark: bool) -> None:
        """Light or dark background for viewers whose address does not ask for `?darkMode`."""
        look.set_theme(self._server, dark)

    def update(self, pose: ArmPose) -> None:
        """Move every part to the pose, in one step for the viewer. Non-finite poses are left
        out: the view keeps the last one.
        """
        if not pose.is_finite:
            return
        first, second = pose.joints
        q = first.position_rad, second.position_rad
        wanted = first.position_reference_rad, second.position_reference_rad
        tip = compute_tip(self._lengths, *q)
        stiffness = first.stiffness_nm_per_rad, second.stiffness_nm_per_rad
        with self._server.atomic():
            for parts, joint in zip(self._joints, pose.joints, strict=True):
                parts.move(joint)
            self._ghost.show(wanted)
            self._comparison.show(pose.comparison, pose.comparison_name)
            self._loads.show(tip, pose.load)
            self._ellipse.show(tip, compute_stiffness_ellipse(self._metres, q, stiffness))
            if self._has_trail:
                for trail, point in zip(
                    self._trails, (tip, compute_tip(self._lengths, *wanted)), strict=True
                ):
                    trail.add(point)

    def draw_paths(self, joints: np.ndarray, references: np.ndarray) -> None:
        """Draw the complete path of the tip and of its reference, in place of those of the last
        seconds.

        Args:
            joints: q1 and q2 over time, (ticks, 2), rad.
            references: Their references, (ticks, 2), rad.
        """
        for trail, angles in zip(self._trails, (joints, references), strict=True):
            trail.draw([compute_tip(self._lengths, *q) for q in angles if np.isfinite(q).all()])

    def _add_solid(self, node: str, build: Callable[..., mechanism.Group], length: float) -> None:
        self._server.scene.add_glb(node, mechanism.export(build, length))
