"""Time for which the motors of a bench bear a load, computed before it is added."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from svsa.actuators.signals import CHANNELS, TORQUES
from svsa.hardware.description.file import BenchFile
from svsa.hardware.safety.heat import Winding
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from svsa.simulation.plant.loads import Load

BEFORE_S, LONGEST_S = 2.0, 30.0
_STEP_S, _STRETCH_S = 0.01, 1.0

Motor = Literal["motor1", "motor2"]


@dataclass(frozen=True)
class Endurance:
    """A motor that a load overheats: from when on heat limits its torque.

    Attributes:
        motor: The motor.
        torque_nm: Torque demanded under the load, rms, N·m.
        lasting_torque_nm: Continuous rating, N·m.
        seconds: Time from the load's onset until heat limits the torque, starting cold, s.
    """

    motor: Motor
    torque_nm: float
    lasting_torque_nm: float
    seconds: float


def find_endurance(
    bench: BenchFile, configuration: Configuration, loads: Iterable[Load]
) -> Endurance | None:
    """Find the motor that heat limits first under these loads; None if neither within 30 s.

    The bench's simulated twin moves as in the configuration and gets the loads after 2 s; its
    torques heat windings that are cold at that time, in steps of 10 ms. None also if the run ends
    in a fault before.

    Args:
        bench: The bench.
        configuration: Configuration of the bench, see `build_bench_configuration`.
        loads: All active loads.

    Returns:
        The motor, or None.
    """
    run = Run(configuration.changed(comparisons=(), loads=()))
    limits = configuration.limits
    windings = (
        Winding(bench.motor1, limits.torque1_nm),
        Winding(bench.motor2, limits.torque2_nm),
    )
    _advance(run, BEFORE_S)
    onset_s = run.time_s
    for load in loads:
        run.add_load(load.changed(start_s=None))
    step = round(_STEP_S / run.period_s)
    torques = np.empty((0, 2))
    while run.fault is None and run.time_s < onset_s + LONGEST_S:
        begin_s = len(torques) * run.period_s
        stretch = _advance(run, _STRETCH_S)
        torques = np.vstack((torques, stretch))
        for number in range(len(stretch) // step):
            asked = stretch[number * step : (number + 1) * step]
            held = _warm(windings, asked)
            if held is not None:
                return Endurance(
                    "motor2" if held else "motor1",
                    float(np.sqrt(np.mean(torques[:, held] ** 2))),
                    windings[held].lasting_nm,
                    begin_s + number * _STEP_S,
                )
    return None


def _warm(windings: tuple[Winding, Winding], asked: np.ndarray) -> Literal[0, 1] | None:
    """Advance the heat by a step with torques (ticks, 2), N·m; return the limited motor, or
    None.
    """
    for number, winding in enumerate(windings):
        torque = np.abs(asked[:, number])
        if winding.find_heat_reduction(float(np.max(torque))) is not None:
            return 1 if number else 0
        winding.warm(math.sqrt(float(np.mean(torque**2))), _STEP_S)
    return None


def _advance(run: Run, seconds: float) -> np.ndarray:
    """Compute u1, u2 for this time, (ticks, 2); fewer if the run has ended."""
    samples = np.empty((1, round(seconds / run.period_s), len(CHANNELS)))
    return samples[0, : run.advance(samples)][:, TORQUES]
