"""An arm in a viser scene: mechanisms, links, tip path, loads and tip stiffness."""

from collections.abc import Callable, Sequence

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
from svsa_scene.tip import compute_stiffness_ellipse, compute_tip

_FLOOR = REACH + 1.6
_TIP_COLOR: look.Rgb = look.COLORS[0]
_REFERENCE_COLOR: look.Rgb = look.GHOST.color


class ArmScene:
    """An arm as every viewer of a viser server sees it.

    Args:
        server: The viser server.
        links: The links of the plant.
        actuators: Parameters of the actuator of each joint.
        has_trail: Whether the path of the last seconds is drawn.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        links: ArmParameters,
        actuators: Sequence[MechanismParameters],
        has_trail: bool = True,
    ) -> None:
        self._server = server
        self._metres = [link.length_m for link in links.chain]
        scale, tip_z = REACH / sum(self._metres), solids.find_tip_z(len(self._metres))
        self._lengths = [scale * metres for metres in self._metres]
        look.set_stage(server, ground=-_FLOOR, cameras="arm", size=3.2)
        self.set_theme(dark=False)
        # The cameras look at the middle of an arm of two joints.
        look.add_root(server, back=0.5 * solids.STEP_Z * (len(self._metres) - 2))
        self._add_solid("/a/stand", mechanism.build_stand, _FLOOR)
        self._joints = self._add_joints(actuators)
        self._moved = Moved()
        self._ghost = OtherArm(server, self._moved, "/a/g", self._lengths, "q_d")
        self._ghost.paint(solids.build_ghost_link, look.GHOST)
        self._comparison = OtherArm(server, self._moved, "/a/r", self._lengths, "")
        self._comparison.paint(
            solids.build_outline, look.Finish(look.get_line_color(1), 0.0, 0.7, 0.85)
        )
        self._comparison.show(None)
        self._loads = TipLoads(server, self._moved, scale, tip_z)
        stiffest = [find_mechanism(one).limits.stiffness_max_nm_per_rad for one in actuators]
        self._ellipse = Ellipse(server, self._moved, max(stiffest), self._metres, tip_z)
        self._trails = (
            Trail(server, "/a/t", _TIP_COLOR, 3.0, tip_z),
            Trail(server, "/a/td", _REFERENCE_COLOR, 2.0, tip_z),
        )
        self._has_trail = has_trail

    def _add_joints(self, actuators: Sequence[MechanismParameters]) -> list[ActuatorParts]:
        """Add actuator, link and name of each joint to the link before."""
        joints, root, last = [], "/a", len(actuators)
        for number, (actuator, length) in enumerate(
            zip(actuators, self._lengths, strict=True), start=1
        ):
            if number > 1:
                at = (self._lengths[number - 2], 0.0, solids.STEP_Z)
                root = f"{root}/l/{number}"
                self._server.scene.add_frame(root, show_axes=False, position=at)
            parts = ActuatorParts(self._server, actuator, root, has_labels=False)
            if number > 1:
                parts.add("m", mechanism.build_principal_motor)
            joints.append(parts)
            build = solids.build_last_link if number == last else solids.build_link
            self._add_solid(f"{root}/l/1", build, length)
            self._server.scene.add_frame(f"{root}/l/n{number}", show_axes=False)
            place = (0.55 * length, 0.3, 0.98)
            add_label(self._server, f"{root}/l/n{number}/t", f"q_{number}", place)
        return joints

    def set_theme(self, dark: bool) -> None:
        """Light or dark background for viewers whose address does not ask for `?darkMode`."""
        look.set_theme(self._server, dark)

    def update(self, pose: ArmPose) -> None:
        """Move every part to the pose, in one step for the viewer. Non-finite poses are left
        out: the view keeps the last one.
        """
        if not pose.is_finite:
            return
        q = [joint.position_rad for joint in pose.joints]
        reference = [joint.position_reference_rad for joint in pose.joints]
        stiffness = [joint.stiffness_nm_per_rad for joint in pose.joints]
        tip = compute_tip(self._lengths, q)
        with self._server.atomic():
            for parts, joint in zip(self._joints, pose.joints, strict=True):
                parts.move(joint)
            self._ghost.show(reference)
            self._comparison.show(pose.comparison, pose.comparison_name)
            self._loads.show(tip, pose.load)
            self._ellipse.show(tip, compute_stiffness_ellipse(self._metres, q, stiffness))
            if self._has_trail:
                for trail, point in zip(
                    self._trails, (tip, compute_tip(self._lengths, reference)), strict=True
                ):
                    trail.add(point)

    def draw_paths(self, joints: np.ndarray, references: np.ndarray) -> None:
        """Draw the complete path of the tip and of its reference, in place of those of the last
        seconds.

        Args:
            joints: Angles of the joints over time, (ticks, joints), rad.
            references: Their references, (ticks, joints), rad.
        """
        for trail, angles in zip(self._trails, (joints, references), strict=True):
            trail.draw([compute_tip(self._lengths, q) for q in angles if np.isfinite(q).all()])

    def _add_solid(self, node: str, build: Callable[..., mechanism.Group], length: float) -> None:
        self._server.scene.add_glb(node, mechanism.export(build, length))
