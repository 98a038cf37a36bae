"""The actuator in a viser scene: built once, then moved by poses only."""

import math

import viser

from svsa.actuators.installed import get_mechanism
from svsa.actuators.parameters import SVSA, MechanismParameters
from svsa_scene import appearance as look
from svsa_scene import mechanism
from svsa_scene.comparisons import Comparisons
from svsa_scene.linkage import LOAD_ARM
from svsa_scene.names import add_label, add_part_labels
from svsa_scene.parts import ActuatorParts
from svsa_scene.pose import ActuatorPose

_ON_MASS = (1.14, 0.0, mechanism.HOOK_Z + 0.39)


class ActuatorScene:
    """An actuator as every viewer of a viser server sees it.

    `parameters` are those of the plant, which name the actuator; by default those of the SVSA.
    """

    def __init__(
        self, server: viser.ViserServer, parameters: MechanismParameters | None = None
    ) -> None:
        self._server = server
        self._load_mass_kg = 0.0
        look.set_stage(server, ground=-mechanism.AXIS_HEIGHT)
        self.set_theme(dark=False)
        look.add_root(server)
        self._parts = parts = ActuatorParts(server, parameters or get_mechanism(SVSA).prototype)
        parts.add("stand", mechanism.build_stand)
        self._ghost = parts.add("g", mechanism.build_ghost)
        self._load = parts.add("w", mechanism.build_load)
        self._load.visible = False
        add_part_labels(server, parts.mechanism)
        self._mass_label = add_label(server, "/a/w/t", "3 kg", _ON_MASS)
        self._comparisons = Comparisons(server, parts.moved)

    def set_theme(self, dark: bool) -> None:
        """Light or dark background for viewers whose address does not ask for `?darkMode`."""
        look.set_theme(self._server, dark)

    def update(self, pose: ActuatorPose) -> None:
        """Move every part to the pose, in one step for the viewer. Non-finite poses are left
        out: the view keeps the last one.
        """
        if not pose.is_finite:
            return
        with self._server.atomic():
            self._parts.move(pose)
            self._parts.turn("ghost", self._ghost, pose.position_reference_rad)
            self._move_load(pose.position_rad, pose.load_mass_kg)
            self._comparisons.show(pose.comparisons)

    def _move_load(self, position: float, mass_kg: float) -> None:
        if mass_kg > 0.0:
            hook = (LOAD_ARM * math.cos(position), LOAD_ARM * math.sin(position), 0.0)
            if self._parts.moved.is_due("load", hook):
                self._load.position = hook
        if mass_kg != self._load_mass_kg:
            self._load_mass_kg = mass_kg
            self._load.visible = mass_kg > 0.0
            if mass_kg > 0.0:
                self._mass_label.text = f"{mass_kg:.3g} kg"
