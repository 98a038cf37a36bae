"""The actuator in a viser scene: built once, then moved by poses only."""

import math
from collections.abc import Callable
from functools import cache

import trimesh
import viser

from svsa.actuators.installed import find_mechanism, get_mechanism
from svsa.actuators.parameters import SVSA, MechanismParameters
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
from svsa_scene.schematic import Schematic

_ON_MASS = (1.14, 0.0, mechanism.HOOK_Z + 0.39)


class ActuatorScene:
    """An actuator as every viewer of a viser server sees it.

    parameters: of the plant, which name the actuator; left out, those of the SVSA. Another actuator
    than the SVSA has the same motors, link, reference, load and arrows, and the parts that its file
    draws.
    """

    def __init__(
        self, server: viser.ViserServer, parameters: MechanismParameters | None = None
    ) -> None:
        mechanism_of = get_mechanism(SVSA) if parameters is None else find_mechanism(parameters)
        self._mechanism = mechanism_of
        self._parameters = parameters or mechanism_of.prototype
        limits = mechanism_of.limits
        self._range = limits.stiffness_min_nm_per_rad, limits.stiffness_max_nm_per_rad
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
        stiffness = pose.stiffness_nm_per_rad
        with self._server.atomic():
            self._turn("link", self._link, pose.position_rad)
            self._turn("connector", self._connector, pose.motor1_position_rad)
            self._turn("ghost", self._ghost, pose.position_reference_rad)
            if self._schematic is None:
                self._move_linkage(linkage)
            else:
                self._schematic.move(pose, linkage.deflection)
            self._move_deflection(linkage.deflection)
            self._limit.show(pose.deflection_limit_rad)
            self._move_load(pose.position_rad, pose.load_mass_kg)
            self._arrows.show(pose)
            self._comparisons.show(pose.comparisons)
            self._color_springs(look.compute_stiffness_step(stiffness, *self._range))

    def _build(self) -> None:
        scene = self._server.scene
        half = math.sqrt(0.5)
        scene.add_frame("/a", show_axes=False, wxyz=(half, 0.0, half, 0.0))
        self._add("/a/stand", mechanism.build_stand)
        self._schematic: Schematic | None = None
        if self._mechanism.name == SVSA:
            self._connector = self._add("/a/c", mechanism.build_connector)
            self._plate = self._add("/a/c/s", mechanism.build_spiral_plate)
            self._pivot = self._add("/a/c/p", mechanism.build_pivot)
            self._link = self._add("/a/l", mechanism.build_link)
            self._lever = self._add("/a/l/v", mechanism.build_lever)
            self._lever.position = (-RADIUS, 0.0, 0.0)
            self._block = self._add("/a/l/b", mechanism.build_block)
            self._add_springs()
        else:
            self._connector = self._add("/a/c", mechanism.build_carrier)
            if self._mechanism.has_stiffness_motor:
                self._add("/a/c/m2", mechanism.build_stiffness_motor)
            self._link = self._add("/a/l", mechanism.build_plain_link)
            self._schematic = Schematic(
                self._server, self._moved, self._mechanism, self._parameters
            )
        self._limit = DeflectionLimit(self._server, self._moved)
        self._ghost = self._add("/a/g", mechanism.build_ghost)
        self._load = self._add("/a/w", mechanism.build_load)
        self._load.visible = False
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
        add_part_labels(self._server, self._mechanism)
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
        if step == self._stiffness_step:
            return
        self._stiffness_step = step
        color = look.get_stiffness_color(step)
        if self._schematic is not None:
            self._schematic.color(color)
            return
        for spring in self._springs:
            spring.color = color


@cache
def _build_helix() -> trimesh.Trimesh:
    """A spring of unit length."""
    return join([make_helix(0.1, 0.022, 7)])
