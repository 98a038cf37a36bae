"""Trials: random scenarios of two families, and the training and validation sets.

Family A is the paper's: 60° of motion, loads on the link, inertias ±50 %, effects of the rig with
friction and noise. Family B is wider: stiffness from 12 to 120 N·m/rad that may vary, wrong spring
and dampings, a current lag, sines to 5 Hz, loads on the motors. Loads have either sign, at any
phase of the motion.

Each set has a name; the keys of its random generators depend on name, family and seed. The test set
is in `svsa.evaluation.ranking.test_set`, which tuning cannot import.
"""

import hashlib
import hmac
import math
from collections.abc import Sequence
from functools import cache
from typing import Literal

import numpy as np

from svsa.evaluation.scenario import INERTIAS, Scenario
from svsa.simulation.plant.effects import RIG
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.effects.noise import SensorNoise
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.sine import SineLoad
from svsa.simulation.reference.kinds import StiffnessReference
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness
from svsa.simulation.reference.kinds.sine import SinePosition, SineStiffness

PROTOCOL = "2"
"""Incremented if trials, fixed scenarios or criterion change: results are comparable only within
one.
"""
Family = Literal["A", "B"]
FAMILIES: tuple[Family, ...] = ("A", "B")
LOAD_S, DURATION_S = 2.0, 6.0
REST_BEGIN_S = 1.0
"""Time from which the torque at rest is measured, s."""
REST_STIFFNESSES = (12.0, 20.0, 35.0, 60.0)
_DAMPINGS = ("link_damping_nms_per_rad", "motor1_damping_nms_per_rad", "motor2_damping_nms_per_rad")


def start_generator(key: int, number: int) -> np.random.Generator:
    """Start an independent Philox generator for a key and a number, both below 2^64."""
    return np.random.Generator(np.random.Philox(key=np.array([key, number], dtype=np.uint64)))


def derive_key(name: str, seed: int) -> int:
    """Derive the key of a set's trials: 64 bits of SHA-256 of its name and seed."""
    return int.from_bytes(hashlib.sha256(f"{name}:{seed}".encode()).digest()[:8], "big")


def derive_seed(secret: bytes, version: str = PROTOCOL) -> int:
    """Derive the seed of a hidden set, 63 bits of HMAC-SHA256(secret, version).

    When the secret is published later, everyone can compute the trials again.
    """
    digest = hmac.digest(secret, version.encode(), hashlib.sha256)
    return int.from_bytes(digest[:8], "big") >> 1


def build_trial(family: Family, name: str, seed: int, number: int) -> Scenario:
    """Build one trial of a family. It does not depend on the others of its set.

    Args:
        family: A or B.
        name: Name of the set.
        seed: Seed of the set, at least 0.
        number: Number of the trial, from 0.
    """
    random = start_generator(derive_key(f"{name} {family}", seed), number)
    is_wide = family == "B"
    plant = [(inertia, float(random.uniform(0.5, 1.5))) for inertia in INERTIAS]
    if is_wide:
        plant += [(damping, 2.0 ** float(random.uniform(-1.0, 1.0))) for damping in _DAMPINGS]
        plant.append(("spring_stiffness_n_per_m", float(random.uniform(0.95, 1.05))))
    friction, noise = Friction(), SensorNoise()
    friction_share, noise_share = float(random.uniform(0.0, 2.0)), float(random.uniform(0.0, 2.0))
    lag_s = 1e-3 * float(random.uniform(0.2, 2.0))
    effects = RIG.changed(
        friction=friction.changed(
            coulomb1_nm=friction_share * friction.coulomb1_nm,
            coulomb2_nm=friction_share * friction.coulomb2_nm,
        ),
        noise=SensorNoise(
            motor_std_rad=noise_share * noise.motor_std_rad,
            deflection_std_rad=noise_share * noise.deflection_std_rad,
        ),
        current_lag=CurrentLag(time_constant_s=lag_s) if is_wide else None,
        delay_samples=int(random.integers(1, 3)),
    )
    return Scenario(
        f"trial_{family}_{number}",
        f"Trial {number + 1} of family {family}",
        (_draw_load(random, is_wide),),
        effects,
        DURATION_S,
        LOAD_S,
        position=_draw_position(random, is_wide),
        stiffness=_draw_stiffness(random, is_wide),
        plant=tuple(plant),
        seed=int(random.integers(0, 2**32)),
    )


def build_training(seed: int, count: int) -> tuple[Scenario, ...]:
    """Build the training trials of a candidate; half of each family."""
    return build_set("training", seed, count)


def build_validation(seed: int, count: int) -> tuple[Scenario, ...]:
    """Build the validation trials of the best candidates; half of each family."""
    return build_set("validation", seed, count)


def build_set(name: str, seed: int, count: int, first: int = 0) -> tuple[Scenario, ...]:
    """Build trials of families A and B, alternating.

    Args:
        name: Name of the set, such as "test".
        seed: Seed of the set.
        count: Number of trials.
        first: Number of the first trial, from 0.

    Returns:
        The trials in the order of their numbers.
    """
    numbers = range(first, first + count)
    return tuple(build_trial(FAMILIES[number % 2], name, seed, number // 2) for number in numbers)


@cache
def build_rest() -> tuple[Scenario, ...]:
    """Build runs at rest with the rig's noise, without friction, to measure torque noise.

    There are four stiffnesses, each with one and with two samples of delay.
    """
    return tuple(
        Scenario(
            f"rest_{sigma:g}_{delay}",
            f"At rest at σ = {sigma:g}, delay of {delay} samples",
            (),
            RIG.changed(
                noise=SensorNoise(),
                friction=Friction(coulomb1_nm=0.0, coulomb2_nm=0.0),
                delay_samples=delay,
            ),
            2.0 * REST_BEGIN_S,
            REST_BEGIN_S,
            position=ConstantPosition(),
            stiffness=ConstantStiffness(stiffness_nm_per_rad=sigma),
            seed=number,
        )
        for delay in (1, 2)
        for number, sigma in enumerate(REST_STIFFNESSES)
    )


def get_mean_stiffness(scenario: Scenario) -> float:
    """Return the mean of a trial's reference stiffness σ_d, N·m/rad."""
    match scenario.stiffness:
        case ConstantStiffness(stiffness_nm_per_rad=sigma):
            return sigma
        case SineStiffness(offset_nm_per_rad=sigma):
            return sigma
    raise TypeError(f"A trial has a constant or a sine as σ_d, not {scenario.stiffness!r}.")


def list_mean_stiffnesses(scenarios: Sequence[Scenario]) -> np.ndarray:
    """List the mean reference stiffness σ_d of each trial, (scenarios,), N·m/rad."""
    return np.array([get_mean_stiffness(scenario) for scenario in scenarios])


def _draw_position(random: np.random.Generator, is_wide: bool) -> SinePosition:
    """Draw a sine in a random direction, with a uniform phase at the load's onset."""
    turns = float(random.uniform(0.2, 0.7))
    amplitude = float(random.uniform(20.0, 70.0)) if is_wide else 60.0
    return SinePosition(
        amplitude_rad=math.radians(amplitude),
        frequency_hz=turns / LOAD_S,
        phase_rad=math.pi * int(random.integers(0, 2)),
    )


def _draw_stiffness(random: np.random.Generator, is_wide: bool) -> StiffnessReference:
    low, high = (12.0, 120.0) if is_wide else (15.0, 70.0)
    sigma = low * (high / low) ** float(random.uniform())
    if not is_wide or random.uniform() < 0.5:
        return ConstantStiffness(stiffness_nm_per_rad=sigma)
    share = float(random.uniform(0.05, 0.2))
    # The sine stays within the range of the family.
    middle = min(max(sigma, low / (1.0 - share)), high / (1.0 + share))
    return SineStiffness(
        offset_nm_per_rad=middle,
        amplitude_nm_per_rad=share * middle,
        frequency_hz=float(random.uniform(0.1, 0.5)),
    )


def _draw_load(random: np.random.Generator, is_wide: bool) -> Load:
    sign = 1.0 if random.uniform() < 0.5 else -1.0
    size = float(random.uniform(0.5, 2.0))
    torque = (sign * size, 0.0, 0.0)
    if is_wide and random.uniform() < 0.5:
        motor1, motor2 = float(random.uniform(-2.0, 2.0)), float(random.uniform(-1.0, 1.0))
        torque = (sign * size * int(random.integers(0, 2)), motor1, motor2)
    match int(random.integers(0, 5)):
        case 0:
            return ConstantLoad(torque_nm=torque, start_s=LOAD_S)
        case 1:
            duration = float(random.uniform(0.5, 2.0))
            return PulseLoad(torque_nm=torque, start_s=LOAD_S, duration_s=duration)
        case 2:
            duration = float(random.uniform(0.05, 0.15))
            link, motor1, motor2 = torque
            impulse = (1.5 * link, 1.5 * motor1, 1.5 * motor2)
            return PulseLoad(torque_nm=impulse, start_s=LOAD_S, duration_s=duration)
        case 3:
            highest = 5.0 if is_wide else 1.0
            frequency = 0.2 * (highest / 0.2) ** float(random.uniform())
            link, motor1, motor2 = torque
            half = (0.5 * link, 0.5 * motor1, 0.5 * motor2)
            return SineLoad(torque_nm=half, frequency_hz=frequency, start_s=LOAD_S)
        case _:
            return MassLoad(mass_kg=float(random.uniform(1.0, 3.0)), start_s=LOAD_S)
