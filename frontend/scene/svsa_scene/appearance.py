"""Colours, materials, light and camera of the view."""

import json
import math
from importlib.resources import files
from typing import NamedTuple

import numpy as np
import trimesh
import viser
from trimesh.visual import TextureVisuals
from trimesh.visual.material import PBRMaterial

Rgb = tuple[int, int, int]


class Finish(NamedTuple):
    """A surface: sRGB colour 0…255, metalness and roughness 0…1, opacity 0…1."""

    color: Rgb
    metalness: float
    roughness: float
    opacity: float = 1.0


FRAME = Finish((118, 128, 141), 0.0, 0.6)
STEEL = Finish((176, 183, 192), 0.1, 0.35)
DARK = Finish((58, 65, 75), 0.0, 0.45)
PRINCIPAL = Finish((52, 116, 190), 0.0, 0.42)
SECONDARY = Finish((224, 166, 58), 0.0, 0.42)
LINK = Finish((222, 226, 231), 0.0, 0.45)
LEVER = Finish((140, 76, 164), 0.0, 0.45)
IRON = Finish((68, 72, 80), 0.0, 0.5)
GHOST = Finish((24, 168, 156), 0.0, 0.8, 0.32)
DEFLECTION: Rgb = (214, 62, 14)
LIMIT = Finish((205, 52, 58), 0.1, 0.6)
DISTURBANCE: Rgb = (226, 88, 12)
COLORS: tuple[Rgb, ...] = (
    (0, 114, 178),
    (213, 94, 0),
    (0, 158, 115),
    (184, 84, 148),
    (214, 140, 10),
)
"""The `LINE_COLORS` of curves, in the order of the page:
`frontend/web/src/core/plots/linestyles.ts`.
"""
MAX_COMPARISONS = 3

_STIFFNESS_STEPS = 32
_STIFFNESS_SCALE = np.array(
    [(52, 120, 200), (44, 172, 168), (120, 190, 84), (240, 190, 50), (224, 66, 52)], dtype=float
)


def compute_stiffness_step(stiffness_nm_per_rad: float, low: float, high: float) -> int:
    """Compute the step 0…31 of the spring's color for σ, logarithmic over the actuator's range.

    Args:
        stiffness_nm_per_rad: σ, N·m/rad.
        low: Smallest stiffness of the actuator, N·m/rad.
        high: Greatest stiffness of the actuator, N·m/rad.

    Returns:
        The step.
    """
    held = min(max(stiffness_nm_per_rad, low), high)
    share = math.log(held / low) / math.log(high / low)
    return min(int(share * _STIFFNESS_STEPS), _STIFFNESS_STEPS - 1)


def get_stiffness_color(step: int) -> Rgb:
    """Colour of a step: blue is soft, red is stiff."""
    where = step / (_STIFFNESS_STEPS - 1) * (len(_STIFFNESS_SCALE) - 1)
    knots = np.arange(len(_STIFFNESS_SCALE))
    red, green, blue = (int(np.interp(where, knots, c)) for c in _STIFFNESS_SCALE.T)
    return red, green, blue


def get_line_color(line_style: int) -> Rgb:
    """Color of the curves of this line style."""
    return COLORS[line_style % len(COLORS)]


def make_material(finish: Finish) -> PBRMaterial:
    """The finish as a glTF material, whose colour is linear."""
    srgb = np.array(finish.color) / 255.0
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    return PBRMaterial(
        baseColorFactor=[*linear, finish.opacity],
        metallicFactor=finish.metalness,
        roughnessFactor=finish.roughness,
        alphaMode="BLEND" if finish.opacity < 1.0 else "OPAQUE",
    )


def paint(mesh: trimesh.Trimesh, finish: Finish) -> trimesh.Trimesh:
    """The mesh in a finish."""
    mesh.visual = TextureVisuals(material=make_material(finish))
    return mesh


def add_root(server: viser.ViserServer, back: float = 0.0) -> None:
    """Add the frame "/a" of every part: x down, y to the right, z towards the viewer in front.

    back: its distance behind the origin of the scene.
    """
    half = math.sqrt(0.5)
    at = (-back, 0.0, 0.0)
    server.scene.add_frame("/a", show_axes=False, wxyz=(half, 0.0, half, 0.0), position=at)


def set_stage(
    server: viser.ViserServer, ground: float, cameras: str = "actuator", size: float = 1.0
) -> None:
    """Set light, ground grid at z = `ground` and the first camera: of the presets in
    `cameras.json`, which the page has too, the one that shows everything. size: relative to that
    of an actuator.

    There is no environment map: without a graphics card it triples the time of a frame.
    """
    scene = server.scene
    scene.set_up_direction("+z")
    scene.world_axes.visible = False
    scene.configure_environment_map(None)
    scene.configure_default_lights(enabled=False)
    scene.add_light_hemisphere(
        "/light/sky", sky_color=(255, 255, 255), ground_color=(140, 148, 160), intensity=1.9
    )
    scene.add_light_directional("/light/key", intensity=2.3, position=(5.0, 3.0, 7.0))
    scene.add_light_directional(
        "/light/rim", intensity=0.8, color=(205, 222, 255), position=(-4.0, -5.0, 3.0)
    )
    scene.add_grid(
        "/ground",
        width=9.0 * size,
        height=9.0 * size,
        position=(-1.0, 0.0, ground),
        cell_size=0.5,
        section_size=2.0,
        cell_color=(150, 158, 168),
        section_color=(128, 138, 150),
        shadow_opacity=0.2,
        cell_thickness=0.6,
        section_thickness=0.9,
        fade_distance=6.5 * size,
        fade_from="origin",
    )
    whole = json.loads((files("svsa_scene") / "cameras.json").read_text("utf-8"))[cameras]["whole"]
    camera = server.initial_camera
    camera.position = tuple(whole["position"])
    camera.look_at = tuple(whole["look_at"])
    camera.fov = math.radians(whole["fov_deg"])
    camera.near = 0.1
    camera.far = 60.0 * size


def set_theme(server: viser.ViserServer, dark: bool) -> None:
    """Viser's own page without logo and share button, on a light or dark background."""
    server.gui.configure_theme(dark_mode=dark, show_logo=False, show_share_button=False)
