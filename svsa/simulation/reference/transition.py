"""Transition between references without a jump in any derivative used.

The old reference r_a and the new one r_b run in parallel and are blended: r = r_a + w(t) (r_b −
r_a), with a weight w of degree 9 whose first four derivatives are zero at both ends. Therefore r is
four times continuously differentiable, and, as a convex combination at every instant, never leaves
the range of the two. A change during a transition starts from the current blend, so that a
reference is a short stack of trajectories.

A sine depends on session time. A finite reference keeps its first value during its transition, and
starts after it.
"""

from typing import Any, NamedTuple

import numpy as np

from svsa.errors import StateError
from svsa.numerics.compilation import compiled, specialize
from svsa.numerics.simd.choice import choose, some
from svsa.numerics.simd.elementwise import call_where
from svsa.numerics.simd.memory import read
from svsa.simulation.reference.curve import DEGREE
from svsa.simulation.reference.kinds import POSITIONS, STIFFNESSES
from svsa.simulation.reference.kinds.reference import AnyReference
from svsa.simulation.reference.kinds.sine import compute_sine
from svsa.simulation.reference.polynomials import blend, compute_fade, compute_polynomial
from svsa.simulation.reference.shape import CURVE, MAX_NUMBERS, SINE, Derivatives, Shape

MAX_FADES = 32

KIND, A, B, C, D, E, F, START, FADE = range(3 + MAX_NUMBERS)


class Stack(NamedTuple):
    """A reference as arrays for the compiled loop.

    Attributes:
        rows: Shape (n, 9): kind, numbers, start and fade (s); (n, 9, 8) for runs with different
            references.
        breaks: Breaks of all curves (see `Curve`), shape (m,); a row's curve begins at its A and
            has B breaks.
        coefficients: Coefficients of all curves, shape (m, 10).
    """

    rows: np.ndarray
    breaks: np.ndarray
    coefficients: np.ndarray


_EMPTY = Stack(np.empty((0, 3 + MAX_NUMBERS)), np.empty(0), np.empty((0, DEGREE + 1)))


def build_stack(trajectory: AnyReference) -> Stack:
    """Build a reference from t = 0."""
    return _append(_EMPTY, trajectory.get_shape(), _find_code(trajectory), 0.0, 0.0)


def build_shape_stack(shape: Shape) -> Stack:
    """Build a sine or a curve from t = 0."""
    return _append(_EMPTY, shape, SINE, 0.0, 0.0)


def push_trajectory(stack: Stack, trajectory: AnyReference, time: float) -> Stack:
    """Blend in `trajectory` from `time` (s) on; finished transitions are dropped.

    Raises:
        StateError: While `MAX_FADES` transitions are in progress.
    """
    # Below a finished fade every trajectory has the weight 0.
    done = stack.rows[:, START] + stack.rows[:, FADE] <= time
    kept = _drop(stack, int(np.flatnonzero(done)[-1])) if done.any() else stack
    if len(kept.rows) >= MAX_FADES:
        raise StateError(
            f"{MAX_FADES} changes of this reference are still fading in; wait for one to end."
        )
    shape, code = trajectory.get_shape(), _find_code(trajectory)
    return _append(kept, shape, code, time, trajectory.transition_s)


def _find_code(trajectory: AnyReference) -> int:
    return _CODES.get(trajectory.compute, SINE)


def _append(stack: Stack, shape: Shape, code: int, start: float, fade: float) -> Stack:
    row = np.zeros(3 + MAX_NUMBERS)
    row[KIND], row[START], row[FADE] = code, start, fade
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
"""Number in a row that selects its function, besides SINE and CURVE."""
before: Any = None
compute: Any = None
code: float = 0.0
"""Specialises `_compute_next`: the function for the previous kinds, and this one with its number.
"""


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
    # Broadcasts the zeros to a vector if `kind` is one.
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
    """The current reference and its four derivatives.

    Args:
        stack: Result of `build_stack` and `push_trajectory`.
        time: Session time, s.

    Returns:
        `Derivatives`.
    """
    value = compute_row(stack, 0, time)
    for i in range(1, stack.rows.shape[0]):
        target = compute_row(stack, i, time)
        weight = compute_fade(stack.rows[i, START], stack.rows[i, FADE], time)
        # A blend with the weight 1 would keep rounding errors of the old reference indefinitely.
        value = target if weight.d0 == 1.0 else blend(value, target, weight)
    return value
