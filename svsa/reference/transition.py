"""From any running reference to another without a jump in any derivative used.

The old reference r_a and the new one r_b run on side by side and are faded:
r = r_a + w(t) (r_b − r_a), with a weight w of degree 9 whose first four derivatives are
zero at both ends. r is then four times continuously differentiable, and, a convex
combination at every instant, never leaves the range of the two. A change during a fade
fades from what runs, so that a reference is a short stack of trajectories.
"""

import math

import numpy as np

from svsa.compilation import compiled
from svsa.errors import StateError
from svsa.reference.trajectories import Derivatives, Trajectory, compute_sine

MOST_FADES = 32

OFFSET, AMPLITUDE, OMEGA, PHASE, START, FADE = range(6)


def build_stack(trajectory: Trajectory) -> np.ndarray:
    """A reference that runs from t = 0: one row (offset, amplitude, ω, phase, start, fade)."""
    return np.array([_build_row(trajectory, 0.0, 0.0)])


def push_trajectory(stack: np.ndarray, trajectory: Trajectory, time: float) -> np.ndarray:
    """The stack with `trajectory` fading in from `time` (s) on, finished fades dropped.

    Raises `StateError` while `MOST_FADES` changes are still fading.
    """
    done = stack[:, START] + stack[:, FADE] <= time
    kept = stack[np.flatnonzero(done)[-1] :] if done.any() else stack
    if len(kept) >= MOST_FADES:
        raise StateError(
            f"{MOST_FADES} changes of this reference are still fading in; wait for one to end."
        )
    return np.vstack([kept, _build_row(trajectory, time, trajectory.transition_s)])


def _build_row(trajectory: Trajectory, start: float, fade: float) -> list[float]:
    offset, amplitude, frequency, phase = trajectory.get_shape()
    return [offset, amplitude, 2.0 * math.pi * frequency, phase, start, fade]


@compiled
def compute_fade(start, duration, time):
    """The weight w and four derivatives: 0 before `start`, 1 after start + duration (s).

    w(x) = x⁵ (126 − 420x + 540x² − 315x³ + 70x⁴), x = (t − start)/duration: the polynomial
    of degree 9 with w(0) = 0, w(1) = 1 and derivatives 1 to 4 zero at both ends.
    """
    if time >= start + duration:
        return Derivatives(1.0, 0.0, 0.0, 0.0, 0.0)
    if time <= start:
        return Derivatives(0.0, 0.0, 0.0, 0.0, 0.0)
    x = (time - start) / duration
    y = 1.0 - x
    rate = 1.0 / duration
    weight = x**5 * (126.0 + x * (-420.0 + x * (540.0 + x * (-315.0 + x * 70.0))))
    xy = x * y
    first = 630.0 * xy**4
    second = 2520.0 * xy**3 * (y - x)
    third = 2520.0 * xy**2 * (3.0 * (y - x) ** 2 - 2.0 * xy)
    fourth = 15120.0 * xy * (y - x) * ((y - x) ** 2 - 3.0 * xy)
    return Derivatives(weight, first * rate, second * rate**2, third * rate**3, fourth * rate**4)


@compiled
def blend(old, new, w):
    """Old + w (new − old) to the 4th derivative, by Leibniz's rule; all `Derivatives`."""
    e0, e1, e2 = new.d0 - old.d0, new.d1 - old.d1, new.d2 - old.d2
    e3, e4 = new.d3 - old.d3, new.d4 - old.d4
    return Derivatives(
        old.d0 + w.d0 * e0,
        old.d1 + w.d0 * e1 + w.d1 * e0,
        old.d2 + w.d0 * e2 + 2.0 * w.d1 * e1 + w.d2 * e0,
        old.d3 + w.d0 * e3 + 3.0 * w.d1 * e2 + 3.0 * w.d2 * e1 + w.d3 * e0,
        old.d4 + w.d0 * e4 + 4.0 * w.d1 * e3 + 6.0 * w.d2 * e2 + 4.0 * w.d3 * e1 + w.d4 * e0,
    )


@compiled
def compute_trajectory(stack, time):
    """The running reference and its four derivatives at `time` (s).

    stack: (n, 6) rows as `build_stack` and `push_trajectory` make them.
    """
    row = stack[0]
    value = compute_sine(row[OFFSET], row[AMPLITUDE], row[OMEGA], row[PHASE], time)
    for i in range(1, stack.shape[0]):
        row = stack[i]
        target = compute_sine(row[OFFSET], row[AMPLITUDE], row[OMEGA], row[PHASE], time)
        weight = compute_fade(row[START], row[FADE], time)
        value = target if weight.d0 == 1.0 else blend(value, target, weight)
    return value
