"""Rehearsal: two hundred runs in columns like the table's, none of them in the table.

What NDOBC-S is tuned on, so that the table can judge it: other references, loads, stiffnesses,
times, models, noise and trials. What is random in them comes from a seed of their own.
"""

import math
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import product

import numpy as np

from svsa.evaluation.ranking.scenarios import INERTIAS, Scenario
from svsa.evaluation.ranking.sweeps import MODELLED
from svsa.evaluation.ranking.trials import build_trial
from svsa.simulation.plant.effects import IDEAL, RIG, Effects
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.effects.noise import SensorNoise
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.series import SeriesLoad
from svsa.simulation.plant.loads.sine import SineLoad
from svsa.simulation.reference.kinds.sine import SinePosition

SEED, TRIALS_SEED, TRIALS = 20240611, 777001, 48
BEGIN_S = 2.0
"""When measuring begins, and a load acts that comes once."""
END_S, REST_S, EARLY_S = 5.0, 6.0, 0.8
BENCH = RIG.changed(friction=Friction(), current_lag=CurrentLag())
Torques = tuple[float, float, float]


class _Chance:
    """What is random, in the order in which it is asked for."""

    def __init__(self) -> None:
        self._random = np.random.default_rng(SEED)

    def draw(self, low: float, high: float) -> float:
        return float(self._random.uniform(low, high))

    def draw_seed(self) -> int:
        return int(self._random.integers(0, 10**6))

    def draw_normal(self, count: int) -> np.ndarray:
        return np.clip(self._random.standard_normal((count, 2)), -4.0, 4.0)

    def draw_reference(self) -> SinePosition:
        """0.12 to 0.33 Hz, 40° to 65°, to one side first or to the other."""
        frequency, amplitude = self.draw(0.12, 0.33), self.draw(40.0, 65.0)
        return _build_sine(frequency, amplitude, float(self._random.integers(0, 2)))

    def draw_side(self) -> SinePosition:
        """The paper's movement, to one side first or to the other."""
        paper = {"amplitude_rad": math.radians(60.0), "frequency_hz": 0.2}
        return self.draw_reference().changed(**paper)


def _build_sine(frequency_hz: float, amplitude_deg: float, side: float) -> SinePosition:
    return SinePosition(
        amplitude_rad=math.radians(amplitude_deg),
        frequency_hz=frequency_hz,
        phase_rad=side * math.pi,
    )


@cache
def build_rehearsal() -> dict[str, tuple[Scenario, ...]]:
    """The runs of each column."""
    columns: dict[str, list[Scenario]] = {}
    for scenario in _build_runs(_Chance()):
        columns.setdefault(scenario.name, []).append(scenario)
    return {
        name: tuple(one._replace(name=f"{name}_{k}") for k, one in enumerate(runs))
        for name, runs in columns.items()
    }


def _run(
    column: str,
    stiffness: float,
    position: SinePosition,
    loads: tuple[Load, ...],
    effects: Effects = RIG,
    plant: Mapping[str, float] | None = None,
    seed: int = 0,
    duration_s: float = END_S,
) -> Scenario:
    wrong = tuple((plant or {}).items())
    return Scenario(
        column, column, loads, effects, stiffness, duration_s, position=position, plant=wrong,
        seed=seed, measured_s=BEGIN_S,
    )  # fmt: skip


def _step(torque: Torques, start_s: float = BEGIN_S) -> tuple[Load, ...]:
    return (ConstantLoad(torque_nm=torque, start_s=start_s),)


def _pulse(torque: Torques, start_s: float, duration_s: float) -> tuple[Load, ...]:
    return (PulseLoad(torque_nm=torque, start_s=start_s, duration_s=duration_s),)


def _build_runs(chance: _Chance) -> Iterator[Scenario]:
    """One after another, each called by its column."""
    yield from _build_steps(chance)
    yield from _build_moving(chance)
    yield from _build_trials()
    yield from _build_wrong_models(chance)
    yield from _build_hard(chance)
    yield from _build_again(chance)
    yield from _build_steady(chance)
    yield from _build_soft(chance)
    yield from _build_shaken(chance)


def _build_steps(chance: _Chance) -> Iterator[Scenario]:
    """Loads that come at once: in the ideal loop, on the rig, on one like a bench; and that go."""
    draw = chance.draw
    for stiffness, way in product((17.0, 21.0, 30.0, 45.0), (1.0, -1.0)):
        position, torque = chance.draw_reference(), way * draw(1.4, 2.1)
        yield _run("ideal", stiffness, position, _step((torque, torque, torque)), IDEAL)
    for k in range(20):
        stiffness = 14.5 * (60.0 / 14.5) ** (k / 19.0) if k > 7 else draw(14.3, 17.0)
        position = chance.draw_reference()
        torque = (1.0 if k % 2 else -1.0) * draw(1.5, 2.1)
        even = (torque, torque, torque)
        yield _run(
            "rig", stiffness, position, _step(even if k % 4 else (0.8 * torque, 0.3 * torque, 0.0))
        )
    for k in range(10):
        stiffness = draw(14.5, 20.0) if k < 5 else draw(20.0, 60.0)
        position = chance.draw_reference()
        torque = (1.0 if k % 2 else -1.0) * draw(1.5, 2.1)
        yield _run("bench", stiffness, position, _step((torque, torque, torque)), BENCH)
    for stiffness, k in product((11.6, 12.7, 13.8, 16.5, 19.0), range(8)):
        position = chance.draw_reference()
        torque = (1.0 if k % 2 else -1.0) * draw(1.8, 2.1)
        gone = _pulse((torque, torque, torque), 0.7, 1.3)
        yield _run("load_removal", stiffness, position, gone, duration_s=REST_S)


def _build_moving(chance: _Chance) -> Iterator[Scenario]:
    """Loads that swing or hang, and noise."""
    for stiffness, frequency, torque in (
        (16.0, 1.6, 1.3),
        (25.0, 2.5, 1.4),
        (16.0, 2.3, 1.4),
        (16.0, 0.8, 1.5),
    ):
        sine = SineLoad(torque_nm=(torque, 0.0, 0.0), frequency_hz=frequency, start_s=EARLY_S)
        yield _run("sine", stiffness, chance.draw_reference(), (sine,))
    for stiffness, mass in ((16.0, 2.3), (24.0, 2.8)):
        load = MassLoad(mass_kg=mass, start_s=EARLY_S)
        yield _run("mass", stiffness, chance.draw_side(), (load,))
    plain = SensorNoise()
    for stiffness, times in ((15.5, 6.0), (18.0, 3.0), (26.0, 8.0), (16.0, 4.0)):
        noise = SensorNoise(
            motor_std_rad=times * plain.motor_std_rad,
            deflection_std_rad=times * plain.deflection_std_rad,
        )
        position, load = chance.draw_reference(), _step((1.8, 1.8, 1.8), 1.0)
        yield _run(
            "noise", stiffness, position, load, RIG.changed(noise=noise), seed=chance.draw_seed()
        )


def _build_trials() -> Iterator[Scenario]:
    for number in range(TRIALS):
        yield build_trial(number, TRIALS_SEED)._replace(name="trial", duration_s=REST_S)


def _build_wrong_models(chance: _Chance) -> Iterator[Scenario]:
    """The paper's load where one thing is far from the nominal model, or every inertia is."""
    load = _step((2.0, 2.0, 2.0))
    for name, ratio in product(MODELLED, (0.3, 0.42, 0.6, 0.85, 1.2, 1.7, 2.4, 3.4)):
        yield _run("model", 15.0, chance.draw_side(), load, plant={name: ratio})
    for number in range(8):
        ratios = [(0.55, 1.45)[number >> place & 1] for place in range(3)]
        wrong: dict[str, float] = dict(zip(INERTIAS, ratios, strict=True))
        yield _run("corner", 16.0, chance.draw_side(), load, plant=wrong)


def _build_hard(chance: _Chance) -> Iterator[Scenario]:
    """Great steps on the link, impulses, lag, delay and pushes."""
    for torque, side in product((2.7, 4.2, 5.6, 7.2, 8.2), (0.0, 1.0)):
        yield _run("step", 15.0, _build_sine(0.2, 60.0, side), _step((torque, 0.0, 0.0)))
    for torque in (2.6, 3.2, -3.0):
        impulse = _pulse((torque, 0.0, 0.0), BEGIN_S, 0.11)
        yield _run("impulse", 15.5, chance.draw_reference(), impulse)
    load = _step((2.0, 2.0, 2.0))
    for lag_ms in (1.5, 2.5, 3.5, 6.0):
        lag = RIG.changed(current_lag=CurrentLag(time_constant_s=lag_ms / 1000.0))
        yield _run("lag", 15.0, chance.draw_side(), load, lag)
    for delay in (2, 3):
        yield _run("delay", 15.0, chance.draw_side(), load, RIG.changed(delay_samples=delay))
    for _ in range(4):
        torque = (chance.draw(-5.0, 5.0), chance.draw(-5.0, 5.0), chance.draw(-5.0, 5.0))
        position = chance.draw_side()
        push = _pulse(torque, BEGIN_S, chance.draw(0.05, 0.3))
        yield _run("push", 15.0, position, (*_step((2.0, 2.0, 2.0), 1.0), *push))


def _build_again(chance: _Chance) -> Iterator[Scenario]:
    """A load that comes back the other way as soon as it is gone, five times."""
    draw = chance.draw
    for stiffness in (15.0, 17.0, 22.0, 34.0, 50.0, 24.0):
        position = chance.draw_reference()
        torque = draw(0.7, 1.0), draw(-1.0, 1.0), draw(-0.6, 0.6)
        gap = draw(0.35, 0.7)
        loads: list[Load] = []
        for k in range(5):
            share = -0.6 if k % 2 else 1.0
            part = (share * torque[0], share * torque[1], share * torque[2])
            loads += _pulse(part, BEGIN_S - 0.6 + k * gap, 0.98 * gap)
        yield _run("again", stiffness, position, tuple(loads))


def _build_steady(chance: _Chance) -> Iterator[Scenario]:
    """What is left long after a load, or without any."""
    for k in range(16):
        stiffness = chance.draw(14.5, 18.0) if k < 9 else chance.draw(18.0, 60.0)
        position = chance.draw_reference()
        torque = (1.0 if k % 2 else -1.0) * chance.draw(1.2, 2.1)
        load = _step((torque, torque, torque), 0.5) if k % 3 else ()
        yield _run("steady", stiffness, position, load)


def _build_soft(chance: _Chance) -> Iterator[Scenario]:
    """Loads that come or swing while the spring is soft: what is hardest for all."""
    for name, count, effects in (("ideal_soft", 10, IDEAL), ("rig_soft", 16, RIG)):
        for k in range(count):
            stiffness, position = chance.draw(13.5, 16.5), chance.draw_reference()
            torque = (1.0 if k % 2 else -1.0) * chance.draw(1.85, 2.2)
            yield _run(name, stiffness, position, _step((torque, torque, torque)), effects)
    for _ in range(8):
        stiffness, position = chance.draw(13.0, 18.0), chance.draw_reference()
        torque, frequency = chance.draw(1.3, 1.7), chance.draw(1.5, 2.6)
        sine = SineLoad(torque_nm=(torque, 0.0, 0.0), frequency_hz=frequency, start_s=EARLY_S)
        yield _run("sine_soft", stiffness, position, (sine,))


def _build_shaken(chance: _Chance) -> Iterator[Scenario]:
    """Normal torque on the motors, new every 2 ms, beside the paper's load."""
    for std in (2.5, 2.5, 4.5, 4.5, 7.0, 7.0):
        times = np.arange(0.0, END_S + 0.001, 0.002)
        normal = chance.draw_normal(len(times))
        rows = tuple((0.0, float(std * one), float(std * other / 3)) for one, other in normal)
        shaking = SeriesLoad(start_s=0.0, time_s=tuple(times.tolist()), torque_nm=rows)
        loads = (*_step((2.0, 2.0, 2.0)), shaking)
        yield _run("shaken", 15.0, chance.draw_side(), loads)
