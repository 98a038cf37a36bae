"""Samples of a reference, without simulating a controller."""

import numpy as np

from svsa.inputs.checked import check_number
from svsa.simulation.reference.kinds.reference import AnyReference
from svsa.simulation.reference.transition import build_stack, compute_trajectory

STILL_S = 1.0
LONGEST_S = 1e6
"""Maximum duration of a run, s."""
MAX_POINTS = 1_000_000


def sample_reference(reference: AnyReference, points: int = 400) -> tuple[np.ndarray, np.ndarray]:
    """Sample a reference with its derivatives from its start to its end.

    A sine is sampled over two periods, a constant over 1 s. There is no transition from another
    reference.

    Args:
        reference: Reference of position or stiffness.
        points: Number of points, at least 2.

    Returns:
        Times (points,), s, and values (points, 5): r, ṙ, r̈, r⃛ and r⁗, in rad or N·m/rad, and that
        per s to s⁴.

    Raises:
        ParameterError: If the number of points is out of range.
    """
    check_number("points", points, "", 2, MAX_POINTS)
    times = np.linspace(0.0, find_duration(reference), points)
    stack = build_stack(reference)
    return times, np.array([compute_trajectory(stack, time) for time in times])


def find_duration(reference: AnyReference) -> float:
    """Compute the duration of a reference, s, at most 10⁶; two periods of a sine, 1 s of a
    constant.
    """
    return min(reference.get_shape().duration or STILL_S, LONGEST_S)
