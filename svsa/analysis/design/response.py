"""Response to 3 kg, from rest, simulated."""

from typing import NamedTuple

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness

ONSET_S = 0.1
DURATION_S = 0.9


class LoadResponse(NamedTuple):
    """The response to a load.

    Attributes:
        time: Time since the load's onset, s.
        error: q_d − q, rad.
        torque1: u1, N·m.
        fault: Fault that ended the run early, or "".
    """

    time: np.ndarray
    error: np.ndarray
    torque1: np.ndarray
    fault: str


def simulate_load(configuration: Configuration, sigma: float) -> LoadResponse:
    """Simulate the configuration's first lane at rest at q = 0, σ_d = `sigma`, with the paper's
    load.

    Limits and effects are those of the configuration.
    """
    run = Run(
        configuration.changed(
            position=ConstantPosition(),
            stiffness=ConstantStiffness(stiffness_nm_per_rad=sigma),
            comparisons=(),
            loads=(PaperLoad(start_s=ONSET_S),),
        )
    )
    samples = np.empty((1, round((ONSET_S + DURATION_S) / run.period_s), len(CHANNELS)))
    rows = samples[0, : run.advance(samples)]
    return LoadResponse(
        rows[:, CHANNEL_INDEX["time_s"]] - ONSET_S,
        rows[:, CHANNEL_INDEX["position_error_rad"]],
        rows[:, CHANNEL_INDEX["torque1_nm"]],
        run.fault.message if run.fault else "",
    )
