"""Scenarios: what every law goes through, each a value with a name.

All track the paper's 60° at 0.2 Hz. "Rig" is `svsa.plant.effects.RIG`: encoders, a state
estimated from them, and one sample of delay.
"""

from typing import NamedTuple

from svsa.paper import FIGURES, LOAD_TIME_S
from svsa.plant.disturbances import (
    PAPER_TORQUE_NM,
    ConstantLoad,
    Load,
    MassLoad,
    PaperLoad,
    PulseLoad,
    SineLoad,
)
from svsa.plant.effects import IDEAL, RIG, Effects
from svsa.reference.sine import ConstantStiffness
from svsa.run.configuration import Configuration

LOADED_S = 3.0
AFTER_S = 2.0


class Scenario(NamedTuple):
    """A run to be gone through: figure 4A with other effects, stiffness and load.

    stiffness: σ_d, N·m/rad. duration_s: s.
    """

    name: str
    title: str
    load: Load
    effects: Effects = RIG
    stiffness_nm_per_rad: float = 15.0
    duration_s: float = 20.0

    def build_configuration(self, law: str) -> Configuration:
        """The run of this scenario under a law."""
        stiffness = ConstantStiffness(stiffness_nm_per_rad=self.stiffness_nm_per_rad)
        return (
            FIGURES["4a"]
            .build_configuration(law)
            .changed(stiffness=stiffness, effects=self.effects, loads=(self.load,))
        )


def _build_unloading(name: str, title: str, stiffness: float, off_s: float) -> Scenario:
    """The paper's load, taken off at a time, s."""
    torque = (PAPER_TORQUE_NM, PAPER_TORQUE_NM, PAPER_TORQUE_NM)
    load = PulseLoad(torque_nm=torque, start_s=off_s - LOADED_S, duration_s=LOADED_S)
    return Scenario(name, title, load, stiffness_nm_per_rad=stiffness, duration_s=off_s + AFTER_S)


_PAPER = PaperLoad(start_s=LOAD_TIME_S)
IDEAL_4A = Scenario("ideal_4a", "Figure 4A", _PAPER, IDEAL)
RIG_4A = Scenario("rig_4a", "Figure 4A on the rig", _PAPER)
OFF_S = 8.0
UNLOADING = _build_unloading("unloading", "The paper's load taken off at 8 s", 15.0, OFF_S)
SINE_2HZ = Scenario(
    "sine_2hz",
    "1.5 N·m at 2 Hz on the link",
    SineLoad(torque_nm=(1.5, 0.0, 0.0), frequency_hz=2.0, start_s=LOAD_TIME_S),
)
MASS = Scenario("mass", "3 kg on the arm", MassLoad(start_s=LOAD_TIME_S))

UNLOADINGS = tuple(
    _build_unloading(
        f"unloading_{stiffness:g}_{phase}",
        f"Load taken off at σ = {stiffness:g}, {phase}/16 of the period",
        stiffness,
        OFF_S + phase * 5.0 / 16.0,
    )
    for stiffness in (12.0, 15.0, 18.0)
    for phase in range(16)
)
"""The load taken off at 16 phases of the movement and three stiffnesses: 48 runs."""

STEP_NM = 0.5
MAX_STEP_NM = 15.0


def build_link_step(torque_nm: float) -> Scenario:
    """A torque on the link from 5 s on, σ = 15, on the rig."""
    load = ConstantLoad(torque_nm=(torque_nm, 0.0, 0.0), start_s=LOAD_TIME_S)
    title = f"{torque_nm:g} N·m on the link at σ = 15"
    return Scenario(f"link_step_{torque_nm:g}", title, load, duration_s=LOAD_TIME_S + LOADED_S)
