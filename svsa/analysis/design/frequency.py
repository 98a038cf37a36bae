"""How much of a torque on the link the loop lets through, over frequency."""

import math
from typing import NamedTuple

import numpy as np

from svsa.analysis.design.sampled_loop import linearize_tick
from svsa.runs.configuration import Configuration

MIN_HZ = 0.1
POINTS = 120
_NYQUIST_SHARE = 0.98


class FrequencyResponse(NamedTuple):
    """e/w2 of the sampled loop about rest. frequency: Hz. magnitude: rad per N·m. phase: rad.

    radius: the largest |z| of the loop's poles, 1; where it is not below 1, nothing settles and the
    numbers have no meaning.
    """

    frequency: np.ndarray
    magnitude: np.ndarray
    phase: np.ndarray
    radius: float

    @property
    def is_stable(self) -> bool:
        """Whether the loop settles."""
        return self.radius < 1.0


def compute_disturbance_response(
    configuration: Configuration, sigma: float, points: int = POINTS
) -> FrequencyResponse:
    """The error q_d − q under w2 = sin ωt, from 0.1 Hz to half the rate of the loop.

        e/w2 = −q/w2 = −C (e^{jωT} I − A)⁻¹ W

    with the tick's A and W (see `SampledLoop`), so that sampling, delay, lag and estimator count.
    """
    loop = linearize_tick(configuration, sigma)
    period = configuration.sampling.period_s
    frequency = np.geomspace(MIN_HZ, _NYQUIST_SHARE * 0.5 / period, points)
    shifts = np.exp(2j * math.pi * period * frequency)
    unit = np.eye(len(loop.A))
    q = np.array([np.linalg.solve(shift * unit - loop.A, loop.W)[0] for shift in shifts])
    return FrequencyResponse(frequency, np.abs(q), np.unwrap(np.angle(-q)), loop.radius)
