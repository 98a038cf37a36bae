"""Estimate the scales from the traces of a turn: fits of the equations of motion.

With double integrals from the beginning of a pulse, the counts n of a motor, those of the
deflection m, and the current I obey

    n = k ∬I − c ∬sgn ṅ + h ∬m                         the motor with Coulomb friction (Eq 1)
    −n − d ∫n = r (m + d ∫m) + r s ∬m + v t + n0       the link, M q̈ + D q̇ = −σ φ (Eq 1)

    k = N² η K_t n_t / (2π B)              counts/s² per A, n_t counts per turn, N gear ratio
    r = N n_t / m_t                        motor counts per count of the deflection
    s = σ / M, d = D / M                   1/s², 1/s

Friction is estimated, so its value need not be known.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.hardware.commissioning.pulse import Trace, Turn

MAX_ERROR = 0.15
MAX_FRICTION = 0.75
_FADE = 0.1
"""Share of the maximum speed below which friction is blended out."""
_SLOPE_SAMPLES = 3


class Fitted(NamedTuple):
    """A fitted value and its standard error."""

    value: float
    error: float

    @property
    def is_sharp(self) -> bool:
        """Whether its standard error is at most 15 %."""
        return self.error <= MAX_ERROR * abs(self.value)


class MotorFit(NamedTuple):
    """Fit of a motor.

    Attributes:
        gain: k, counts/s² per A.
        friction: Friction torque as a share of the motor's torque.
    """

    gain: Fitted
    friction: float

    @property
    def is_sharp(self) -> bool:
        """Whether the gain is known, and friction at most 75 %."""
        return self.gain.is_sharp and self.friction <= MAX_FRICTION


class LinkFit(NamedTuple):
    """Fit of the link.

    Attributes:
        ratio: r, motor counts per deflection count.
        stiffness: s = σ/M, 1/s².
    """

    ratio: Fitted
    stiffness: Fitted


def fit_motor(turn: Turn, rest: float | None) -> MotorFit:
    """Fit k; `rest` are the deflection counts at rest, None for a motor without a spring on its
    side.
    """
    rows, moved = [], []
    for trace in (turn.forth.trace, turn.back.trace):
        time = trace.time_s
        columns = [1e-3 * trace.current_ma, -_compute_direction(trace)]
        if rest is not None:
            columns.append(trace.deflected - rest)
        rows.append(np.stack([_integrate_twice(each, time) for each in columns], axis=1))
        moved.append(trace.moved)
    gain, friction = _solve(rows, moved)[:2]
    driven = abs(1e-3 * gain.value * turn.forth.current_ma)
    return MotorFit(gain, abs(friction.value) / driven if driven else math.inf)


def fit_link(turn: Turn, rest: float, damping: float) -> LinkFit:
    """Fit r and s to a turn of motor 1.

    Args:
        turn: The turn.
        rest: Deflection counts at rest.
        damping: d, 1/s.

    Returns:
        The fit.
    """
    rows, moved = [], []
    for number, trace in enumerate((turn.forth.trace, turn.back.trace)):
        time, deflected = trace.time_s, trace.deflected - rest
        # The link still oscillates when the second pulse begins: each pulse has its own v and n0.
        own = np.zeros((time.size, 4))
        own[:, 2 * number], own[:, 2 * number + 1] = time, 1.0
        damped = deflected + damping * _integrate(deflected, time)
        fitted = np.stack([damped, _integrate_twice(deflected, time)], axis=1)
        rows.append(np.concatenate([fitted, own], axis=1))
        moved.append(-trace.moved - damping * _integrate(trace.moved, time))
    ratio, product = _solve(rows, moved)[:2]
    if not (ratio.is_sharp and product.value):
        return LinkFit(ratio, Fitted(0.0, math.inf))
    error = math.hypot(ratio.error / ratio.value, product.error / product.value)
    stiffness = product.value / ratio.value
    return LinkFit(ratio, Fitted(stiffness, abs(stiffness) * error))


def _integrate_twice(values: np.ndarray, time_s: np.ndarray) -> np.ndarray:
    return _integrate(_integrate(values, time_s), time_s)


def _integrate(values: np.ndarray, time_s: np.ndarray) -> np.ndarray:
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(time_s)
    return np.concatenate([[0.0], np.cumsum(steps)])


def _compute_direction(trace: Trace) -> np.ndarray:
    """Compute the sign of the velocity ṅ, without a jump at rest."""
    n, time, moved = _SLOPE_SAMPLES, trace.time_s, trace.moved
    speed = np.zeros(time.size)
    speed[n:-n] = (moved[2 * n :] - moved[: -2 * n]) / (time[2 * n :] - time[: -2 * n])
    return np.tanh(speed / max(_FADE * float(np.max(np.abs(speed))), 1.0))


def _solve(rows: list[np.ndarray], targets: list[np.ndarray]) -> list[Fitted]:
    """Least squares; the error is infinite if the columns do not determine the values."""
    a, b = np.concatenate(rows), np.concatenate(targets)
    # Columns are normalised: their lengths differ by up to ten powers of ten.
    lengths = np.linalg.norm(a, axis=0)
    if b.size <= a.shape[1] or not np.all(lengths > 0.0):
        return [Fitted(0.0, math.inf)] * a.shape[1]
    scaled = a / lengths
    values, _, rank, _ = np.linalg.lstsq(scaled, b, rcond=1e-10)
    if rank < a.shape[1]:
        return [Fitted(0.0, math.inf)] * a.shape[1]
    residual = b - scaled @ values
    variance = float(residual @ residual) / (b.size - a.shape[1])
    errors = np.sqrt(variance * np.diag(np.linalg.inv(scaled.T @ scaled)))
    return [Fitted(*each) for each in zip(values / lengths, errors / lengths, strict=True)]
