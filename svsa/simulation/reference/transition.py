"""Transition between references without a jump in any derivative used.

The old reference r_a and the new one r_b run on side by side and are faded:
r = r_a + w(t) (r_b − r_a), with a weight w of degree 9 whose first four derivatives are
zero at both ends. r is then four times continuously differentiable, and, a convex
combination at every instant, never leaves the range of the two. A change during a fade
fades from what runs, so that a reference is a short stack of trajectories.

A sine runs on the time of the session. What has a beginning holds its first value while it
fades in, and begins when it has.
"""

from typing import Any, NamedTuple

import numpy as np

from svsa.errors import StateError
from svsa.numerics.compilation import compiled, specialize
from svsa.numerics.simd.choice import choose, some
from svsa.numerics.simd.each import call_where
from svsa.numerics.simd.memory import read
from svsa.simulation.reference.curve import DEGREE
from svsa.simulation.reference.kinds import POSITIONS, STIFFNESSES
from svsa.simulation.reference.kinds.reference import AnyReference
from svsa.simulation.reference.kinds.sine import compute_sine
from svsa.simulation.reference.polynomials import blend, compute_fade, compute_polynomial
from svsa.simulation.reference.shape import CURVE, MAX_NUMBERS, SINE, Derivatives

MAX_FADES = 32

KIND, A, B, C, D, E, F, START, FADE = range(3 + MAX_NUMBERS)


class Stack(NamedTuple):
    """A reference as arrays for the compiled loop.

    rows: (n, 9): kind, numbers, start and fade (s); (n, 9, 8) for runs that have other references
    each. breaks, coefficients: (m,) and (m, 10), of every curve (see `Curve`); A and B of its row
    are where it begins and how long it is.
    """

    rows: np.ndarray
    breaks: np.ndarray
    coefficients: np.ndarray


_EMPTY = Stack(np.empty((0, 3 + MAX_NUMBERS)), np.empty(0), np.empty((0, DEGREE + 1)))


def build_stack(trajectory: AnyReference) -> Stack:
    """Build a reference from t = 0."""
    return _append(_EMPTY, trajectory, 0.0, 0.0)


def push_trajectory(stack: Stack, trajectory: AnyReference, time: float) -> Stack:
    """Fade in `trajectory` from `time` (s) on; finished transitions are dropped.

    Raises `StateError` while `MAX_FADES` changes are still fading.
    """
    # Below a finished fade every trajectory has the weight 0.
    done = stack.rows[:, START] + stack.rows[:, FADE] <= time
    kept = _drop(stack, int(np.flatnonzero(done)[-1])) if done.any() else stack
    if len(kept.rows) >= MAX_FADES:
        raise StateError(
            f"{MAX_FADES} changes of this reference are still fading in; wait for one to end."
        )
    return _append(kept, trajectory, time, trajectory.transition_s)


def _append(stack: Stack, trajectory: AnyReference, start: float, fade: float) -> Stack:
    shape, row = trajectory.get_shape(), np.zeros(3 + MAX_NUMBERS)
    row[KIND], row[START], row[FADE] = _CODES.get(trajectory.compute, SINE), start, fade
    row[A : A + len(shape.numbers)] = shape.numbers
    breaks, coefficients = stack.breaks, stack.coefficients
    if shape.curve is not None:
        row[KIND] = CURVE
        row[A], row[B] = len(breaks), len(shape.curve.breaks)
        breaks = np.concatenate([breaks, shape.curve.breaks])
        coefficients = np.concatenate([coefficients, shape.curve.coefficients])
    return Stack(np.vstack([stack.rows, row]), breaks, coefficients)


def _drop(stack: Stack, count: int) -> Stack:
    """Drop the first rows of the stack and their curves."""
    rows, gone = stack.rows[count:].copy(), stack.rows[:count]
    length = int(gone[gone[:, KIND] == CURVE, B].sum())
    rows[rows[:, KIND] == CURVE, A] -= length
    return Stack(rows, stack.breaks[length:].copy(), stack.coefficients[length:].copy())


_COMPUTED = dict.fromkeys(one.compute for one in (*POSITIONS, *STIFFNESSES) if one.compute)
_CODES = {compute: code for code, compute in enumerate(_COMPUTED, CURVE + 1)}
"""The number by which a row says which function computes it, besides SINE and CURVE."""
before: Any = None
compute: Any = None
code: float = 0.0
"""Of `_compute_next`: what computes the kinds before this one, and this one with its number."""


@compiled
def _compute_none(kind: float, numbers: tuple[float, ...], value: Derivatives) -> Derivatives:
    return value


def _compute_next(kind: float, numbers: tuple[float, ...], value: Derivatives) -> Derivatives:
    return call_where(kind == code, compute, numbers, before(kind, numbers, value))


def _chain() -> Any:
    """Chain all kinds in one compiled function without function pointers."""
    chained = _compute_none
    for function, number in _CODES.items():
        given = {"before": chained, "compute": function, "code": float(number)}
        chained = specialize(_compute_next, f"{function.__name__}_next", **given)
    return chained


compute_own = _chain()
"""(kind, numbers, value) -> `Derivatives` of the function of this kind, or `value`."""


@compiled
def compute_row(stack: Stack, i: int, time: float) -> Derivatives:
    """The i-th trajectory of the stack and its four derivatives at `time` (s)."""
    r, kind = stack.rows, read(stack.rows, i, KIND)
    a, b, c, d = read(r, i, A), read(r, i, B), read(r, i, C), read(r, i, D)
    nothing = Derivatives(0.0, 0.0, 0.0, 0.0, 0.0)
    # Makes a vector of the zeros if `kind` is one.
    value = choose(kind == SINE, nothing, nothing)
    if some(kind == SINE):
        value = compute_sine(a, b, c, d, time)
    own = time - read(r, i, START) - read(r, i, FADE)
    sweep = a, b, c, d, read(r, i, E), read(r, i, F), own
    value = compute_own(kind, sweep, value)
    piece = stack.breaks, stack.coefficients, a, b, own
    return call_where(kind == CURVE, compute_polynomial, piece, value)


@compiled
def compute_trajectory(stack: Stack, time: float) -> Derivatives:
    """The running reference and its four derivatives at `time` (s).

    stack: as `build_stack` and `push_trajectory` make it.
    """
    value = compute_row(stack, 0, time)
    for i in range(1, stack.rows.shape[0]):
        target = compute_row(stack, i, time)
        weight = compute_fade(stack.rows[i, START], stack.rows[i, FADE], time)
        # A blend with the weight 1 would leave rounding errors of the old reference indefinitely.
        value = target if weight.d0 == 1.0 else blend(value, target, weight)
    return value
