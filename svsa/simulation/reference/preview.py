"""Samples of a reference alone, without a controller that follows it."""

import numpy as np

from svsa.simulation.reference.kinds.reference import AnyReference
from svsa.simulation.reference.transition import build_stack, compute_trajectory

STILL_S = 1.0
LONGEST_S = 1e6
"""As long as any run may be."""


def sample_reference(reference: AnyReference, points: int = 400) -> tuple[np.ndarray, np.ndarray]:
    """A reference from its beginning to its end: times (s) and, a row each, r … r⁗.

    Of a sine two periods, of a constant 1 s. Times (points,); values (points, 5), the unit of
    the reference and that by s … s⁴. It goes alone, not faded in from another.
    """
    times = np.linspace(0.0, find_duration(reference), points)
    stack = build_stack(reference)
    return times, np.array([compute_trajectory(stack, time) for time in times])


def find_duration(reference: AnyReference) -> float:
    """How long a reference moves, s, 10⁶ at most; of a sine two periods, of what is still 1 s."""
    return min(reference.get_shape().duration or STILL_S, LONGEST_S)
