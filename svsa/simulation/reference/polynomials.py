"""Compiled polynomials of time with four derivatives: fade, blend of two signals, curve."""

import numpy as np

from svsa.numerics.compilation import compiled
from svsa.simulation.reference.curve import DEGREE
from svsa.simulation.reference.shape import Derivatives


@compiled
def compute_fade(start: float, duration: float, time: float) -> Derivatives:
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
def blend(old: Derivatives, new: Derivatives, w: Derivatives) -> Derivatives:
    """old + w (new − old) to the 4th derivative, by Leibniz's rule; all `Derivatives`."""
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
def compute_polynomial(
    breaks: np.ndarray, coefficients: np.ndarray, first: float, length: float, time: float
) -> Derivatives:
    """Σ c_k (t − t_i)^k and its derivatives by Horner's scheme; constant before t_0 and after the
    end.

    Args:
        breaks: Break points, shape (m,), s.
        coefficients: Shape (m, 10).
        first: Index of this curve's first break, an integer as float.
        length: Number of its breaks.
        time: Time of the curve, s.

    Returns:
        Value and derivatives.
    """
    low = int(first)
    if time <= breaks[low]:
        return Derivatives(coefficients[low, 0], 0.0, 0.0, 0.0, 0.0)
    high = low + int(length)
    while high - low > 1:
        middle = (low + high) // 2
        if breaks[middle] <= time:
            low = middle
        else:
            high = middle
    dt = time - breaks[low]
    p0, p1, p2, p3, p4 = 0.0, 0.0, 0.0, 0.0, 0.0
    # In this scheme each p is a derivative divided by its factorial: hence the factors 2, 6 and 24.
    for k in range(DEGREE, -1, -1):
        p4 = p4 * dt + p3
        p3 = p3 * dt + p2
        p2 = p2 * dt + p1
        p1 = p1 * dt + p0
        p0 = p0 * dt + coefficients[low, k]
    return Derivatives(p0, p1, 2.0 * p2, 6.0 * p3, 24.0 * p4)
