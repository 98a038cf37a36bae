"""Scenarios: what every law goes through, each a value with a name.

All track the paper's 60° at 0.2 Hz unless they say so. "Rig" is
`svsa.simulation.plant.effects.RIG`: encoders, a state estimated from them, and one sample of delay.
"""

import math
from itertools import product
from typing import NamedTuple

from svsa.control.installed import BASELINE, PAPERS_LAW
from svsa.runs.configuration import Configuration, Lane
from svsa.runs.paper import FIGURES, LOAD_TIME_S
from svsa.simulation.plant.effects import IDEAL, RIG, Effects
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.effects.gravity import LinkGravity
from svsa.simulation.plant.effects.noise import SensorNoise
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.paper import PAPER_TORQUE_NM, PaperLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.sine import SineLoad
from svsa.simulation.reference.kinds import PositionReference
from svsa.simulation.reference.kinds.constant import ConstantStiffness
from svsa.simulation.reference.kinds.steps import StepsPosition

LOADED_S = 3.0
PEAK_S, REST_S = 2.0, 5.0
"""How long a run goes on without the load: until its peak is over, until what stays is seen."""

TrueOverNominal = tuple[tuple[str, float], ...]
"""Names of `ActuatorParameters`, each with the true value over the nominal one."""


class Scenario(NamedTuple):
    """A run to be gone through: a figure of the paper with other effects, stiffness and loads.

    stiffness: σ_d, N·m/rad; None leaves the figure's. plant: in place of the paper's, the nominal
    model times these. measured_s: from when errors count.
    """

    name: str
    title: str
    loads: tuple[Load, ...]
    effects: Effects = RIG
    stiffness_nm_per_rad: float | None = None
    duration_s: float = 20.0
    figure: str = "4a"
    position: PositionReference | None = None
    plant: TrueOverNominal = ()
    seed: int = 0
    measured_s: float = LOAD_TIME_S

    def build_configuration(self, law: str) -> Configuration:
        """The run of this scenario under a law."""
        figure = FIGURES[self.figure].build_configuration(law)
        sigma, stiffness = self.stiffness_nm_per_rad, figure.stiffness
        if sigma is not None:
            stiffness = ConstantStiffness(stiffness_nm_per_rad=sigma)
        values = dict(figure.nominal if self.plant else figure.actuator)
        values |= {name: ratio * values[name] for name, ratio in self.plant}
        return figure.changed(
            position=self.position or figure.position,
            stiffness=stiffness,
            actuator=figure.actuator.changed(**values),
            effects=self.effects,
            loads=self.loads,
            seed=self.seed,
        )

    def build_compared(self, law: str) -> Configuration:
        """The same beside NDOBC, and NDOBC beside FL."""
        baseline = BASELINE if law == PAPERS_LAW else PAPERS_LAW
        return self.build_configuration(law).changed(comparisons=(Lane(law=baseline),))


PAPER = PaperLoad(start_s=LOAD_TIME_S)
INERTIAS = ("link_inertia_kg_m2", "motor1_inertia_kg_m2", "motor2_inertia_kg_m2")

IDEAL_4A = Scenario("ideal_4a", "Figure 4A", (PAPER,), IDEAL)
RIG_4A = Scenario("rig_4a", "Figure 4A on the rig", (PAPER,))
RIG_4B = Scenario("rig_4b", "Figure 4B on the rig", (PAPER,), figure="4b")
RIG_5 = Scenario("rig_5", "Figure 5 on the rig", (PAPER,), figure="5")


def _build_load_removal(
    name: str, title: str, stiffness: float, off_s: float, after_s: float
) -> Scenario:
    """The paper's load, taken off at a time, s. after_s: how long the run then goes on."""
    torque = (PAPER_TORQUE_NM, PAPER_TORQUE_NM, PAPER_TORQUE_NM)
    load = PulseLoad(torque_nm=torque, start_s=off_s - LOADED_S, duration_s=LOADED_S)
    return Scenario(
        name,
        title,
        (load,),
        stiffness_nm_per_rad=stiffness,
        duration_s=off_s + after_s,
        measured_s=off_s,
    )


OFF_S = 8.0
LOAD_REMOVAL = _build_load_removal(
    "load_removal", "The paper's load taken off at 8 s", 15.0, OFF_S, PEAK_S
)
LOAD_REMOVALS = tuple(
    _build_load_removal(
        f"load_removal_{stiffness:g}_{phase}",
        f"Load taken off at σ = {stiffness:g}, {phase}/16 of the period",
        stiffness,
        OFF_S + phase * 5.0 / 16.0,
        REST_S,
    )
    for stiffness in (12.0, 15.0, 18.0)
    for phase in range(16)
)
"""The load taken off at 16 phases of the movement and three stiffnesses: 48 runs."""

SINE_2HZ = Scenario(
    "sine_2hz",
    "1.5 N·m at 2 Hz on the link",
    (SineLoad(torque_nm=(1.5, 0.0, 0.0), frequency_hz=2.0, start_s=LOAD_TIME_S),),
    measured_s=8.0,
)
MASS = Scenario("mass", "3 kg on the arm", (MassLoad(start_s=LOAD_TIME_S),), measured_s=8.0)
PULSES = Scenario(
    "pulses",
    "Impulses of 3 N·m for 0.1 s on the link",
    tuple(
        PulseLoad(torque_nm=(way * 3.0, 0.0, 0.0), start_s=LOAD_TIME_S + at, duration_s=0.1)
        for way, at in ((1.0, 0.0), (-1.0, 1.3), (1.0, 2.6), (-1.0, 3.9))
    ),
    duration_s=11.0,
)
NOISE_5 = Scenario(
    "noise_5",
    "Five times the sensors' noise",
    (PAPER,),
    RIG.changed(noise=SensorNoise(motor_std_rad=1e-4, deflection_std_rad=1e-3)),
    measured_s=8.0,
)
UNMODELLED = Scenario(
    "unmodelled",
    "Friction, lag of 2 ms and the link's weight, which no law knows of",
    (PAPER,),
    RIG.changed(
        friction=Friction(), current_lag=CurrentLag(time_constant_s=0.002), gravity=LinkGravity()
    ),
)
CORNERS = tuple(
    Scenario(
        "corner_" + "_".join(f"{ratio:g}" for ratio in ratios),
        "M, B1, B2 are {:g}, {:g}, {:g} times nominal".format(*ratios),
        (PAPER,),
        duration_s=10.0,
        plant=tuple(zip(INERTIAS, ratios, strict=True)),
    )
    for ratios in product((0.5, 1.5), repeat=3)
)
"""Every inertia half or one and a half times the nominal one: 8 runs."""

STEP_NM = 0.5
MAX_STEP_NM = 15.0


def build_link_step(torque_nm: float) -> Scenario:
    """A torque on the link from 5 s on, σ = 15, on the rig."""
    load = ConstantLoad(torque_nm=(torque_nm, 0.0, 0.0), start_s=LOAD_TIME_S)
    title = f"{torque_nm:g} N·m on the link at σ = 15"
    return Scenario(f"link_step_{torque_nm:g}", title, (load,), duration_s=LOAD_TIME_S + LOADED_S)


SATURATING = tuple(
    Scenario(
        f"turn_{degrees}",
        f"A turn of {degrees}° in 0.2 s",
        (),
        duration_s=5.0,
        position=StepsPosition(
            time_s=(0.0, 2.0), position_rad=(0.0, math.radians(degrees)), rise_s=0.2
        ),
        measured_s=2.0,
    )
    for degrees in (60, 120, 180)
)
"""Steps of the reference: the greater ones ask for more torque than motors and spring have."""

SINGLE = (
    IDEAL_4A,
    RIG_4A,
    RIG_4B,
    RIG_5,
    LOAD_REMOVAL,
    SINE_2HZ,
    MASS,
    PULSES,
    NOISE_5,
    UNMODELLED,
    *SATURATING,
)
"""Those that are told one by one."""
