"""The moving parts of one actuator: mechanism, deflection, its limit, torques as arrows."""

import math
from collections.abc import Callable
from functools import cache

import trimesh
import viser

from svsa.actuators.installed import find_mechanism
from svsa.actuators.parameters import SVSA, MechanismParameters
from svsa_scene import appearance as look
from svsa_scene import mechanism
from svsa_scene.arrows import TorqueArrows
from svsa_scene.geometry import join, make_helix, make_sector, scale_sector, turn
from svsa_scene.limits import DeflectionLimit
from svsa_scene.linkage import RADIUS, SPRING_ANCHOR, Linkage, compute_linkage
from svsa_scene.moved import Moved
from svsa_scene.pose import ActuatorPose
from svsa_scene.schematic import Schematic


class ActuatorParts:
    """The parts of an actuator in a frame of the scene.

    An actuator other than the SVSA has the same motors, link and arrows, and the parts that its
    file draws.

    Args:
        server: The viser server.
        parameters: Parameters of the plant, which name the actuator.
        root: Name of the frame, which exists: x along the link at q = 0, z along the axis.
        has_labels: Whether the torques have labels.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        parameters: MechanismParameters,
        root: str = "/a",
        has_labels: bool = True,
    ) -> None:
        self.mechanism = find_mechanism(parameters)
        limits = self.mechanism.limits
        self._range = limits.stiffness_min_nm_per_rad, limits.stiffness_max_nm_per_rad
        self._server, self._root = server, root
        self.moved = Moved()
        self._stiffness_step = 0
        self.schematic: Schematic | None = None
        if self.mechanism.name == SVSA:
            self._connector = self.add("c", mechanism.build_connector)
            self._plate = self.add("c/s", mechanism.build_spiral_plate)
            self._pivot = self.add("c/p", mechanism.build_pivot)
            self._link = self.add("l", mechanism.build_link)
            self._lever = self.add("l/v", mechanism.build_lever)
            self._lever.position = (-RADIUS, 0.0, 0.0)
            self._block = self.add("l/b", mechanism.build_block)
            self._add_springs()
        else:
            self._connector = self.add("c", mechanism.build_carrier)
            if self.mechanism.has_stiffness_motor:
                self.add("c/m2", mechanism.build_stiffness_motor)
            self._link = self.add("l", mechanism.build_plain_link)
            self.schematic = Schematic(server, self.moved, self.mechanism, parameters, root)
        self._limit = DeflectionLimit(server, self.moved, root)
        self._add_sector()
        self._arrows = TorqueArrows(server, self.moved, root, has_labels)

    def add(self, name: str, build: Callable[[], mechanism.Group]) -> viser.SceneNodeHandle:
        """Add a frame with a solid group below the root."""
        scene, node = self._server.scene, f"{self._root}/{name}"
        frame = scene.add_frame(node, show_axes=False)
        scene.add_glb(f"{node}/solid", mechanism.export(build))
        return frame

    def move(self, pose: ActuatorPose) -> None:
        """Move every part to a finite pose."""
        linkage = compute_linkage(pose)
        self.turn("link", self._link, pose.position_rad)
        self.turn("connector", self._connector, pose.motor1_position_rad)
        if self.schematic is None:
            self._move_linkage(linkage)
        else:
            self.schematic.move(pose, linkage.deflection)
        self._move_deflection(linkage.deflection)
        self._limit.show(pose.deflection_limit_rad)
        self._arrows.show(pose)
        self._color_springs(look.compute_stiffness_step(pose.stiffness_nm_per_rad, *self._range))

    def turn(self, key: str, node: viser.SceneNodeHandle, angle: float) -> None:
        """Turn a node about z, if the angle, rad, differs visibly from the one sent."""
        if self.moved.is_due(key, (angle,)):
            node.wxyz = turn(angle)

    def _add_springs(self) -> None:
        helix = _build_helix()
        self._springs = [
            self._server.scene.add_mesh_simple(
                f"{self._root}/l/{name}",
                helix.vertices,
                helix.faces,
                color=look.get_stiffness_color(0),
                position=(0.0, side * SPRING_ANCHOR, mechanism.SPRING_Z),
                wxyz=(1.0, 0.0, 0.0, 0.0) if side < 0 else (0.0, 0.0, 0.0, 1.0),
            )
            for name, side in (("j", -1.0), ("k", 1.0))
        ]

    def _add_sector(self) -> None:
        sector = make_sector(0.96, 1.17)
        self._sector = self._server.scene.add_mesh_simple(
            f"{self._root}/c/d",
            sector.vertices,
            sector.faces,
            color=look.DEFLECTION,
            side="double",
            position=(0.0, 0.0, mechanism.SECTOR_Z),
            cast_shadow=False,
        )

    def _move_linkage(self, linkage: Linkage) -> None:
        self.turn("plate", self._plate, linkage.plate_angle)
        self.turn("lever", self._lever, linkage.lever_angle)
        if self.moved.is_due("pivot", (linkage.pivot_radius,)):
            self._pivot.position = (-linkage.pivot_radius, 0.0, 0.0)
        if self.moved.is_due("block", (linkage.block_offset,)):
            self._block.position = (0.0, linkage.block_offset, 0.0)
            for spring, length in zip(
                self._springs, (linkage.spring_left, linkage.spring_right), strict=True
            ):
                spring.scale = (1.0, length, 1.0)

    def _move_deflection(self, deflection: float) -> None:
        if self.moved.is_due("deflection", (deflection,)):
            shown = min(max(deflection, -math.pi / 2), math.pi / 2)
            self._sector.wxyz = turn(shown / 2)
            self._sector.scale = scale_sector(shown)

    def _color_springs(self, step: int) -> None:
        if step == self._stiffness_step:
            return
        self._stiffness_step = step
        color = look.get_stiffness_color(step)
        if self.schematic is not None:
            self.schematic.color(color)
            return
        for spring in self._springs:
            spring.color = color


@cache
def _build_helix() -> trimesh.Trimesh:
    """A spring of unit length."""
    return join([make_helix(0.1, 0.022, 7)])
