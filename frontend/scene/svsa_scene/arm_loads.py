"""Loads at the tip of an arm: mass, force, wall."""

import math

import viser

from svsa_scene import appearance as look
from svsa_scene import arm_solids as solids
from svsa_scene import mechanism
from svsa_scene.arm_pose import TipLoad, Wall
from svsa_scene.arm_solids import REACH
from svsa_scene.geometry import turn
from svsa_scene.moved import Moved
from svsa_scene.names import add_label

_FULL_FORCE_N = 40.0
_LONGEST_ARROW = 4.0
_SMALLEST_FORCE_N = 0.05


class TipLoads:
    """Mass, force and wall."""

    def __init__(self, server: viser.ViserServer, moved: Moved, scale: float, tip_z: float) -> None:
        self._moved, self._scale, self._tip_z = moved, scale, tip_z
        scene = server.scene
        self._mass_kg = 0.0
        self._mass = scene.add_frame("/a/w", show_axes=False, visible=False)
        self._solid = scene.add_glb("/a/w/solid", mechanism.export(solids.build_mass))
        self._mass_label = add_label(server, "/a/w/t", "0 kg", (1.1, 0.6, 0.0))
        self._force = scene.add_frame("/a/f", show_axes=False, visible=False)
        shaft, head = solids.build_shaft(), solids.build_head()
        self._shaft = scene.add_mesh_simple(
            "/a/f/s", shaft.vertices, shaft.faces, color=look.DISTURBANCE, cast_shadow=False
        )
        self._head = scene.add_frame("/a/f/h", show_axes=False)
        scene.add_mesh_simple(
            "/a/f/h/m", head.vertices, head.faces, color=look.DISTURBANCE, cast_shadow=False
        )
        self._force_label = add_label(server, "/a/f/h/t", "0 N", (0.0, 0.9, 0.0))
        wall = solids.build_wall(1.4 * REACH, tip_z)
        self._wall = scene.add_mesh_simple(
            "/a/wall",
            wall.vertices,
            wall.faces,
            color=look.FRAME.color,
            opacity=0.55,
            visible=False,
            cast_shadow=False,
        )

    def show(self, tip: tuple[float, float], load: TipLoad) -> None:
        """Draw the loads at the tip; `tip` is (x, y) in scene units."""
        x, y = tip
        self._show_mass((-y, x, self._tip_z + 0.25), load.mass_kg)
        self._show_force((-y, x, self._tip_z + 0.4), load.force_n)
        self._show_wall(load.wall)

    def _show_mass(self, at: tuple[float, float, float], mass_kg: float) -> None:
        if mass_kg > 0.0 and self._moved.is_due("mass", at):
            self._mass.position = at
        if mass_kg != self._mass_kg:
            self._mass_kg = mass_kg
            self._mass.visible = mass_kg > 0.0
            if mass_kg > 0.0:
                self._solid.scale = min(max(mass_kg ** (1 / 3), 0.4), 1.6)
                self._mass_label.text = f"{mass_kg:.3g} kg"

    def _show_force(self, at: tuple[float, float, float], force_n: tuple[float, float]) -> None:
        size = math.hypot(*force_n)
        is_seen = size >= _SMALLEST_FORCE_N
        if self._force.visible != is_seen:
            self._force.visible = is_seen
        if not is_seen:
            return
        if self._moved.is_due("force at", at):
            self._force.position = at
        if self._moved.is_due("force", force_n):
            length = 0.5 + _LONGEST_ARROW * min(math.sqrt(size / _FULL_FORCE_N), 1.0)
            # Along +y of the arrow: the local axes are x = down and y = right.
            self._force.wxyz = turn(math.atan2(force_n[1], force_n[0]))
            self._shaft.scale = (1.0, length, 1.0)
            self._head.position = (0.0, length, 0.0)
            self._force_label.text = f"{size:.3g} N"

    def _show_wall(self, wall: Wall | None) -> None:
        if self._wall.visible != (wall is not None):
            self._wall.visible = wall is not None
        if wall is None or not self._moved.is_due("wall", (wall.normal_rad, wall.distance_m)):
            return
        distance = self._scale * wall.distance_m
        nx, ny = math.cos(wall.normal_rad), math.sin(wall.normal_rad)
        self._wall.position = (-distance * ny, distance * nx, 0.0)
        self._wall.wxyz = turn(wall.normal_rad)
