"""A season's trials: a hundred random plants, loads and noises, and the seeds that make them."""

import hashlib
import hmac

import numpy as np

from svsa.evaluation.ranking.scenarios import INERTIAS, Scenario
from svsa.simulation.plant.effects import RIG
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.effects.noise import SensorNoise
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.sine import SineLoad

SUITE_VERSION = "1"
"""Changes with all that the score counts, trials, sweeps, scenarios, weights: scores compare within
one."""


def derive_seed(secret: bytes, version: str = SUITE_VERSION) -> int:
    """The seed of a season, 64 bits of HMAC-SHA256(secret, version).

    Whoever does not know the secret cannot tune for the trials; published afterwards, it lets
    anybody compute them again.
    """
    return int.from_bytes(hmac.digest(secret, version.encode(), hashlib.sha256)[:8], "big")


PUBLIC_SEED = derive_seed(b"public")


def start_generator(seed: int, number: int) -> np.random.Generator:
    """The generator of the draw `number` of a season: Philox, its key the seed and the number.

    Trials are the same in whatever order, and however many of them, are made. seed: below 2^64.
    """
    return np.random.Generator(np.random.Philox(key=np.array([seed, number], dtype=np.uint64)))


TRIALS = 100
LOAD_S = 3.0
DURATION_S = 10.0
MIN_SIGMA, MAX_SIGMA = 16.0, 70.0


def build_trial(number: int, seed: int = PUBLIC_SEED) -> Scenario:
    """The draw of this number, from 0 on, of a season.

    True over nominal M, B1 and B2 each from 0.5 to 1.5; σ_d from 12 to 70 N·m/rad, as many below
    as above their geometric mean; Coulomb friction up to the double of `Friction`, noise up to the
    double of `SensorNoise`; one or two samples of delay; and from 3 s on a step, a pulse, a sine or
    a mass. Ten seconds.
    """
    random = start_generator(seed, number)
    plant = tuple((name, float(random.uniform(0.5, 1.5))) for name in INERTIAS)
    sigma = MIN_SIGMA * (MAX_SIGMA / MIN_SIGMA) ** float(random.uniform())
    coulomb_share, noise_share = float(random.uniform(0.0, 2.0)), float(random.uniform(0.0, 2.0))
    friction, noise = Friction(), SensorNoise()
    effects = RIG.changed(
        friction=Friction(
            coulomb1_nm=coulomb_share * friction.coulomb1_nm,
            coulomb2_nm=coulomb_share * friction.coulomb2_nm,
        ),
        noise=SensorNoise(
            motor_std_rad=noise_share * noise.motor_std_rad,
            deflection_std_rad=noise_share * noise.deflection_std_rad,
        ),
        delay_samples=int(random.integers(1, 3)),
    )
    return Scenario(
        f"trial_{number}",
        f"Draw {number + 1}",
        (_draw_load(random),),
        effects,
        sigma,
        DURATION_S,
        plant=plant,
        seed=int(random.integers(0, 2**32)),
        measured_s=LOAD_S,
    )


def build_trials(seed: int = PUBLIC_SEED) -> tuple[Scenario, ...]:
    """The trials of a season."""
    return tuple(build_trial(number, seed) for number in range(TRIALS))


def _draw_load(random: np.random.Generator) -> Load:
    way = 1.0 if random.uniform() < 0.5 else -1.0
    torque = way * float(random.uniform(0.5, 2.0))
    match int(random.integers(0, 4)):
        case 0:
            return ConstantLoad(torque_nm=(torque, 0.0, 0.0), start_s=LOAD_S)
        case 1:
            duration = float(random.uniform(0.5, 4.0))
            return PulseLoad(torque_nm=(torque, 0.0, 0.0), start_s=LOAD_S, duration_s=duration)
        case 2:
            frequency = float(random.uniform(0.2, 1.0))
            return SineLoad(
                torque_nm=(0.5 * torque, 0.0, 0.0), frequency_hz=frequency, start_s=LOAD_S
            )
        case _:
            return MassLoad(mass_kg=float(random.uniform(1.0, 3.0)), start_s=LOAD_S)
