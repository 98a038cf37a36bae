"""Fixed scenarios: single runs for every law, with both signs and 8 phases.

The reference is the paper's 60° at 0.2 Hz unless stated otherwise. The sign is that of the load, or
of the motion if the load has none. Rig effects are `svsa.simulation.plant.effects.RIG`: encoders, a
state estimated from them, and one sample of delay.
"""

import math
from collections.abc import Callable, Iterator
from functools import cache
from itertools import product
from typing import NamedTuple

from svsa.errors import ParameterError, Violation
from svsa.evaluation.ranking.test_set import build_test_trial
from svsa.evaluation.scenario import Scenario
from svsa.evaluation.trials import FAMILIES
from svsa.runs.definition.paper import LOAD_TIME_S
from svsa.simulation.plant.effects import IDEAL, RIG, Effects
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.effects.gravity import LinkGravity
from svsa.simulation.plant.effects.noise import SensorNoise
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.paper import PAPER_TORQUE_NM
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.sine import SineLoad
from svsa.simulation.reference.kinds.constant import ConstantStiffness
from svsa.simulation.reference.kinds.sine import SinePosition
from svsa.simulation.reference.kinds.steps import StepsPosition

PUBLIC_SEED = 1
"""Seed of the published test set."""
PERIOD_S = 5.0
PHASES = 8
SIGNS = (1.0, -1.0)
SIGN_NAMES = {1.0: "positive", -1.0: "negative"}
STEP_NM, MAX_STEP_NM = 0.5, 15.0
LEARNED_PERIODS, REPEATED_PERIODS = 7, 12
_PAPER = (PAPER_TORQUE_NM, PAPER_TORQUE_NM, PAPER_TORQUE_NM)
_MOTION_RAD = math.radians(60.0)

Torque = tuple[float, float, float]
Loads = Callable[[float, float], tuple[Load, ...]]
"""Maps onset (s) and sign to loads."""


class FixedScenario(NamedTuple):
    """A scenario with its variants over sign and phase."""

    name: str
    title: str
    variants: tuple[Scenario, ...]


def _scale(torque: Torque, share: float) -> Torque:
    link, motor1, motor2 = torque
    return share * link, share * motor1, share * motor2


def _step(torque: Torque) -> Loads:
    return lambda start_s, sign: (ConstantLoad(torque_nm=_scale(torque, sign), start_s=start_s),)


def _sine(torque: Torque, frequency_hz: float) -> Loads:
    return lambda start_s, sign: (
        SineLoad(torque_nm=_scale(torque, sign), frequency_hz=frequency_hz, start_s=start_s),
    )


def _removal(torque: Torque) -> Loads:
    """Build the removal of a load that was applied 3 s before."""
    return lambda start_s, sign: (
        PulseLoad(torque_nm=_scale(torque, sign), start_s=start_s - 3.0, duration_s=3.0),
    )


def _impulses(torque_nm: float) -> Loads:
    def build(start_s: float, sign: float) -> tuple[Load, ...]:
        return tuple(
            PulseLoad(
                torque_nm=(way * sign * torque_nm, 0.0, 0.0), start_s=start_s + at, duration_s=0.1
            )
            for way, at in ((1.0, 0.0), (-1.0, 1.3), (1.0, 2.6), (-1.0, 3.9))
        )

    return build


def _hang(start_s: float, sign: float) -> tuple[Load, ...]:
    return (MassLoad(start_s=start_s),)


def _build(
    name: str,
    title: str,
    loads: Loads,
    effects: Effects = RIG,
    stiffness: float = 15.0,
    after_s: float = 6.0,
    phases: int = PHASES,
) -> FixedScenario:
    """Build variants of a load with onset `LOAD_TIME_S` and at later phases of the motion."""
    return FixedScenario(
        name,
        title,
        tuple(
            Scenario(
                f"{name}.{SIGN_NAMES[sign]}.{phase}",
                f"{title}, {SIGN_NAMES[sign]} sign, phase {phase}/{phases}",
                loads(onset_s, sign),
                effects,
                onset_s + after_s,
                onset_s,
                # The load of a hanging mass has one sign; therefore the motion gets the sign.
                position=_build_motion(sign if loads is _hang else 1.0),
                stiffness=ConstantStiffness(stiffness_nm_per_rad=stiffness),
            )
            for sign in SIGNS
            for phase in range(phases)
            for onset_s in (LOAD_TIME_S + phase * PERIOD_S / phases,)
        ),
    )


def _build_motion(sign: float) -> SinePosition:
    return SinePosition(
        amplitude_rad=_MOTION_RAD,
        frequency_hz=1.0 / PERIOD_S,
        phase_rad=0.0 if sign > 0.0 else math.pi,
    )


def _build_turn(degrees: int) -> FixedScenario:
    """Build a step of the reference, from 0."""
    name, title = f"turn_{degrees}", f"Reference step of {degrees}° in 0.2 s"
    return FixedScenario(
        name,
        title,
        tuple(
            Scenario(
                f"{name}.{SIGN_NAMES[sign]}.0",
                f"{title}, {SIGN_NAMES[sign]} sign",
                duration_s=5.0,
                measured_s=2.0,
                position=StepsPosition(
                    time_s=(0.0, 2.0), position_rad=(0.0, sign * math.radians(degrees)), rise_s=0.2
                ),
            )
            for sign in SIGNS
        ),
    )


def _build_repetitive() -> FixedScenario:
    """Build the motion with periodic loads of equal period, measured from the eighth period on."""
    title = "Repeating load, eighth to twelfth period"
    tracks = {"sine": (SineLoad, {"frequency_hz": 1.0}), "mass": (MassLoad, {})}
    variants = []
    for (kind, (load, values)), sign in product(tracks.items(), SIGNS):
        torque = {"torque_nm": (1.5 * sign, 0.0, 0.0)} if kind == "sine" else {}
        variants.append(
            Scenario(
                f"repetitive.{kind}_{SIGN_NAMES[sign]}.0",
                f"{title}: {kind}, {SIGN_NAMES[sign]} sign",
                (load(start_s=0.0, **values, **torque),),
                RIG,
                REPEATED_PERIODS * PERIOD_S,
                LEARNED_PERIODS * PERIOD_S,
                position=_build_motion(sign),
            )
        )
    return FixedScenario("repetitive", title, tuple(variants))


@cache
def build_fixed_scenarios() -> tuple[FixedScenario, ...]:
    """Build all fixed scenarios except the link steps."""
    noise = RIG.changed(noise=SensorNoise(motor_std_rad=1e-4, deflection_std_rad=1e-3))
    unmodelled = RIG.changed(
        friction=Friction(), current_lag=CurrentLag(time_constant_s=0.002), gravity=LinkGravity()
    )
    mixed = (PAPER_TORQUE_NM, PAPER_TORQUE_NM, -PAPER_TORQUE_NM)
    return (
        _build("ideal_4a", "Paper's load, ideal, σ = 15", _step(_PAPER), IDEAL),
        _build("rig_4a", "Paper's load, rig, σ = 15", _step(_PAPER)),
        _build("rig_4b", "Paper's load, rig, σ = 60", _step(_PAPER), stiffness=60.0),
        _build("mixed", "2, 2, −2 N·m, rig, σ = 15", _step(mixed)),
        _build("load_removal", "Paper's load removed, rig, σ = 15", _removal(_PAPER)),
        _build("load_removal_12", "Paper's load removed, rig, σ = 12", _removal(_PAPER), RIG, 12.0),
        _build("sine_2hz", "1.5 N·m at 2 Hz on the link, rig, σ = 15", _sine((1.5, 0.0, 0.0), 2.0)),
        _build("mass", "3 kg on an arm of 68 mm, rig, σ = 15", _hang),
        _build("impulses", "Impulses of 3 N·m for 0.1 s, rig, σ = 15", _impulses(3.0)),
        _build("noise_5", "Paper's load, five times the noise, σ = 15", _step(_PAPER), noise),
        _build(
            "unmodelled", "Paper's load, friction, lag, gravity, σ = 15", _step(_PAPER), unmodelled
        ),
        _build_turn(60),
        _build_turn(120),
        _build_repetitive(),
    )


def build_link_steps(torque_nm: float) -> FixedScenario:
    """Build torque steps on the link, rig effects, σ = 15."""
    return _build(
        f"link_step_{torque_nm:g}",
        f"{torque_nm:g} N·m on the link, rig, σ = 15",
        _step((torque_nm, 0.0, 0.0)),
        after_s=3.0,
    )


def list_scenarios() -> Iterator[Scenario]:
    """List the variants of every fixed scenario, link steps included."""
    for fixed in build_fixed_scenarios():
        yield from fixed.variants
    for count in range(1, round(MAX_STEP_NM / STEP_NM) + 1):
        yield from build_link_steps(count * STEP_NM).variants


def find_scenario(name: str, seed: int = PUBLIC_SEED) -> Scenario:
    """Return the scenario or test trial of this name; `seed` is that of the test set.

    Raises:
        ParameterError: If there is none.
    """
    for family in FAMILIES:
        number = name.removeprefix(f"trial_{family}_")
        if number != name and number.isdecimal() and len(number) < 9:
            return build_test_trial(family, seed, int(number))
    for scenario in list_scenarios():
        if scenario.name == name:
            return scenario
    bound = "a scenario, such as rig_4a.positive.0, link_step_2.5.negative.3 or trial_A_12"
    raise ParameterError(Violation("scenario", name, "", bound))
