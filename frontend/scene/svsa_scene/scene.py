"""The actuator in a viser scene: built once, then moved by poses only."""

import math
from collections.abc import Callable
from functools import cache

import trimesh
import viser

from svsa_scene import appearance as look
from svsa_scene import mechanism
from svsa_scene.arrows import TorqueArrows
from svsa_scene.comparisons import Comparisons
from svsa_scene.geometry import join, make_helix, make_sector, scale_sector, turn
from svsa_scene.limits import DeflectionLimit
from svsa_scene.linkage import (
    LOAD_ARM,
    RADIUS,
    SPRING_ANCHOR,
    Linkage,
    compute_linkage,
)
from svsa_scene.moved import Moved
from svsa_scene.names import add_label, add_part_labels
from svsa_scene.pose import ActuatorPose

_ON_MASS = (1.14, 0.0, mechanism.HOOK_Z + 0.39)


class ActuatorScene:
    """The serial variable stiffness actuator as every viewer of a viser server sees it."""

    def __init__(self, server: viser.ViserServer) -> None:
        self._server = server
        self._moved = Moved()
        self._stiffness_step = 0
        self._load_mass_kg = 0.0
        look.set_stage(server, ground=-mechanism.AXIS_HEIGHT)
        self.set_theme(dark=False)
        self._build()

    def set_theme(self, dark: bool) -> None:
        """Light or dark background for viewers whose address does not ask for `?darkMode`."""
        look.set_theme(self._server, dark)

    def update(self, pose: ActuatorPose) -> None:
        """Move every part to the pose, in one step for the viewer. Non-finite poses are left
        out: the view keeps the last one.
        """
        if not pose.is_finite:
            return
        linkage = compute_linkage(pose)
        with self._server.atomic():
            self._turn("link", self._link, pose.position_rad)
            self._turn("connector", self._connector, pose.motor1_position_rad)
            self._turn("ghost", self._ghost, pose.position_reference_rad)
            self._move_linkage(linkage)
            self._move_deflection(linkage.deflection)
            self._limit.show(pose.deflection_limit_rad)
            self._move_load(pose.position_rad, pose.load_mass_kg)
            self._arrows.show(pose)
            self._comparisons.show(pose.comparisons)
            self._color_springs(look.compute_stiffness_step(pose.stiffness_nm_per_rad))

    def _build(self) -> None:
        scene = self._server.scene
        half = math.sqrt(0.5)
        scene.add_frame("/a", show_axes=False, wxyz=(half, 0.0, half, 0.0))
        self._add("/a/stand", mechanism.build_stand)
        self._connector = self._add("/a/c", mechanism.build_connector)
        self._plate = self._add("/a/c/s", mechanism.build_spiral_plate)
        self._pivot = self._add("/a/c/p", mechanism.build_pivot)
        self._limit = DeflectionLimit(self._server, self._moved)
        self._link = self._add("/a/l", mechanism.build_link)
        self._lever = self._add("/a/l/v", mechanism.build_lever)
        self._lever.position = (-RADIUS, 0.0, 0.0)
        self._block = self._add("/a/l/b", mechanism.build_block)
        self._ghost = self._add("/a/g", mechanism.build_ghost)
        self._load = self._add("/a/w", mechanism.build_load)
        self._load.visible = False
        self._add_springs()
        self._add_sector()
        self._add_labels()
        self._arrows = TorqueArrows(self._server, self._moved)
        self._comparisons = Comparisons(self._server, self._moved)

    def _add(self, name: str, build: Callable[[], mechanism.Group]) -> viser.SceneNodeHandle:
        scene = self._server.scene
        frame = scene.add_frame(name, show_axes=False)
        scene.add_glb(f"{name}/solid", mechanism.export(build))
        return frame

    def _add_springs(self) -> None:
        helix = _build_helix()
        self._springs = [
            self._server.scene.add_mesh_simple(
                f"/a/l/{name}",
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
            "/a/c/d",
            sector.vertices,
            sector.faces,
            color=look.DEFLECTION,
            side="double",
            position=(0.0, 0.0, mechanism.SECTOR_Z),
            cast_shadow=False,
        )

    def _add_labels(self) -> None:
        add_part_labels(self._server)
        self._mass_label = add_label(self._server, "/a/w/t", "3 kg", _ON_MASS)

    def _turn(self, key: str, node: viser.SceneNodeHandle, angle: float) -> None:
        if self._moved.is_due(key, (angle,)):
            node.wxyz = turn(angle)

    def _move_linkage(self, linkage: Linkage) -> None:
        self._turn("plate", self._plate, linkage.plate_angle)
        self._turn("lever", self._lever, linkage.lever_angle)
        if self._moved.is_due("pivot", (linkage.pivot_radius,)):
            self._pivot.position = (-linkage.pivot_radius, 0.0, 0.0)
        if self._moved.is_due("block", (linkage.block_offset,)):
            self._block.position = (0.0, linkage.block_offset, 0.0)
            for spring, length in zip(
                self._springs, (linkage.spring_left, linkage.spring_right), strict=True
            ):
                spring.scale = (1.0, length, 1.0)

    def _move_deflection(self, deflection: float) -> None:
        if self._moved.is_due("deflection", (deflection,)):
            shown = min(max(deflection, -math.pi / 2), math.pi / 2)
            self._sector.wxyz = turn(shown / 2)
            self._sector.scale = scale_sector(shown)

    def _move_load(self, position: float, mass_kg: float) -> None:
        if mass_kg > 0.0:
            hook = (LOAD_ARM * math.cos(position), LOAD_ARM * math.sin(position), 0.0)
            if self._moved.is_due("load", hook):
                self._load.position = hook
        if mass_kg != self._load_mass_kg:
            self._load_mass_kg = mass_kg
            self._load.visible = mass_kg > 0.0
            if mass_kg > 0.0:
                self._mass_label.text = f"{mass_kg:.3g} kg"

    def _color_springs(self, step: int) -> None:
        if step != self._stiffness_step:
            self._stiffness_step = step
            for spring in self._springs:
                spring.color = look.get_stiffness_color(step)


@cache
def _build_helix() -> trimesh.Trimesh:
    """A spring of unit length."""
    return join([make_helix(0.1, 0.022, 7)])
