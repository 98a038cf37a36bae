"""The six sweeps of robustness: how far one thing may be wrong before a law no longer holds.

In the manner of the double pendulum's benchmark (Wiebe et al., "Open-source dual-purpose acrobot
and pendubot platform", 2024): a law's robustness is the mean of six shares of success. Every run is
figure 4A on the rig for 6 s with the paper's load from 2 s on, and has held if its last second has
an rms error of at most 1°. The sweeps go on to where nearly every law has failed, so that they tell
laws apart.
"""

from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np

from svsa.evaluation.ranking.scenarios import INERTIAS, Scenario
from svsa.evaluation.ranking.trials import start_generator
from svsa.simulation.plant.effects import RIG
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.delay_samples import MAX_DELAY_SAMPLES
from svsa.simulation.plant.effects.noise import SensorNoise
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.series import SeriesLoad

LOAD_S, DURATION_S = 2.0, 6.0
SEED = 0
"""Of the published sweeps."""
REPEATS = 3
_LOAD = PaperLoad(start_s=LOAD_S)
_RATIOS = tuple(2.0 ** (step / 2.0) for step in range(-4, 5))


class Sweep(NamedTuple):
    """Runs over the values of one thing, as many for each.

    unit: of the values, "1" for a ratio. runs: those of each value.
    """

    name: str
    title: str
    unit: str
    values: tuple[float, ...]
    runs: tuple[tuple[Scenario, ...], ...]


def _build(
    name: str,
    title: str,
    unit: str,
    values: tuple[float, ...],
    vary: Callable[[Scenario, float, int, int], Scenario],
    repeats: int,
    seed: int,
) -> Sweep:
    """vary: a run made another by a value, by which of the repeats it is, and by the seed."""

    def build_run(value: float, repeat: int) -> Scenario:
        reported = f"{title}: {value:g} {unit}" if unit != "1" else f"{title}: × {value:.3g}"
        plain = Scenario(f"{name}_{value:.3g}_{repeat}", reported, (_LOAD,), duration_s=DURATION_S)
        return vary(plain, value, repeat, seed)

    runs = tuple(tuple(build_run(value, one) for one in range(repeats)) for value in values)
    return Sweep(name, title, unit, values, runs)


MODELLED = (*INERTIAS, "spring_stiffness_n_per_m")


def _vary_model(run: Scenario, value: float, repeat: int, seed: int) -> Scenario:
    return run._replace(plant=((MODELLED[repeat], value),))


def _vary_noise(run: Scenario, value: float, repeat: int, seed: int) -> Scenario:
    plain = SensorNoise()
    noise = SensorNoise(
        motor_std_rad=value * plain.motor_std_rad,
        deflection_std_rad=value * plain.deflection_std_rad,
    )
    return run._replace(effects=RIG.changed(noise=noise), seed=(seed + repeat) % 2**32)


def _vary_torque(run: Scenario, value: float, repeat: int, seed: int) -> Scenario:
    return run._replace(loads=(_LOAD, _build_torque_noise(value, repeat, seed)))


@cache
def _build_torque_noise(std: float, repeat: int, seed: int) -> Load:
    """Normal torque on motor 1, and a third of it on motor 2, new every 2 ms, joined by lines."""
    random = start_generator(seed, 1000 + repeat)
    times = np.arange(0.0, DURATION_S + 0.002, 0.002)
    torque = np.clip(random.standard_normal((len(times), 2)), -4.0, 4.0)
    rows = np.column_stack([np.zeros(len(times)), std * torque[:, 0], std * torque[:, 1] / 3.0])
    points = tuple((float(a), float(b), float(c)) for a, b, c in rows)
    return SeriesLoad(start_s=0.0, time_s=tuple(times.tolist()), torque_nm=points)


def _vary_response(run: Scenario, value: float, repeat: int, seed: int) -> Scenario:
    lag = CurrentLag(time_constant_s=value / 1000.0)
    return run._replace(effects=RIG.changed(current_lag=lag))


def _vary_delay(run: Scenario, value: float, repeat: int, seed: int) -> Scenario:
    return run._replace(effects=RIG.changed(delay_samples=int(value)))


def _vary_perturbation(run: Scenario, value: float, repeat: int, seed: int) -> Scenario:
    """Three pushes of 0.05 to 0.3 s on all bodies, in a direction of each its own."""
    random = start_generator(seed, 2000 + repeat)
    pushes = []
    for at in (0.5, 2.5, 3.7):
        w = value * random.uniform(-1.0, 1.0, 3)
        pushes.append(
            PulseLoad(
                torque_nm=(float(w[0]), float(w[1]), float(w[2])),
                start_s=round(at + float(random.uniform(0.0, 0.6)), 3),
                duration_s=round(float(random.uniform(0.05, 0.3)), 3),
            )
        )
    return run._replace(loads=(_LOAD, *pushes))


@cache
def build_sweeps(seed: int = SEED) -> tuple[Sweep, ...]:
    """The six: their values go from what is easy to what hardly a law bears.

    seed: of what chance there is in them, which is sensor noise, torque noise and pushes.
    """
    noise = tuple(float(2**step) for step in range(9))
    torque = (0.25, 0.5, 1.0, 2.0, 4.0, 6.0, 8.0, 12.0)
    response = (0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0, 15.0)
    delay = tuple(float(samples) for samples in range(MAX_DELAY_SAMPLES + 1))
    push = tuple(float(step) for step in range(1, 13))
    return (
        _build("model", "True over nominal", "1", _RATIOS, _vary_model, len(MODELLED), seed),
        _build("velocity_noise", "Sensor noise", "1", noise, _vary_noise, REPEATS, seed),
        _build("torque_noise", "Torque noise", "N·m", torque, _vary_torque, REPEATS, seed),
        _build("torque_response", "Lag of the torque", "ms", response, _vary_response, 1, seed),
        _build("delay", "Samples of delay", "samples", delay, _vary_delay, 1, seed),
        _build("perturbation", "Pushes", "N·m", push, _vary_perturbation, REPEATS + 1, seed),
    )
