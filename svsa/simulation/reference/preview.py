"""Samples of a reference alone, without a controller that follows it."""

import numpy as np

from svsa.simulation.reference.shape import CHIRP, SINE
from svsa.simulation.reference.trajectories import Trajectory
from svsa.simulation.reference.transition import build_stack, compute_trajectory

STILL_S = 1.0
DURATION = 4
"""Which of a chirp's numbers is its duration, s."""
PERIODS = 2.0
LONGEST_S = 1e6
"""As long as any run may be."""


def sample_reference(reference: Trajectory, points: int = 400) -> tuple[np.ndarray, np.ndarray]:
    """A reference from its beginning to its end: times (s) and, a row each, r … r⁗.

    Of a sine two periods, of a constant 1 s. Times (points,); values (points, 5), the unit of
    the reference and that by s … s⁴. It goes alone, not faded in from another.
    """
    times = np.linspace(0.0, find_duration(reference), points)
    stack = build_stack(reference)
    return times, np.array([compute_trajectory(stack, time) for time in times])


def find_duration(reference: Trajectory) -> float:
    """How long a reference moves, s, 10⁶ at most; of a sine two periods, of what is still 1 s."""
    shape = reference.get_shape()
    if shape.curve is not None:
        return float(shape.curve.breaks[-1]) or STILL_S
    if shape.kind == CHIRP:
        return shape.numbers[DURATION]
    omega = shape.numbers[2] if shape.kind == SINE and shape.numbers[1] else 0.0
    if not omega:
        return STILL_S
    return min(PERIODS * 2.0 * np.pi / max(omega, 1.0 / LONGEST_S), LONGEST_S)
