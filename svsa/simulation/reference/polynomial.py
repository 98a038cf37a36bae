"""The value and four derivatives of one of many piecewise polynomials."""

import numpy as np

from svsa.numerics.compilation import compiled
from svsa.simulation.reference.curve import DEGREE
from svsa.simulation.reference.shape import Derivatives


@compiled
def compute_polynomial(
    breaks: np.ndarray, coefficients: np.ndarray, first: float, length: float, time: float
) -> Derivatives:
    """Σ c_k (t − t_i)^k and its derivatives by Horner's scheme; held before t_0 and at the end.

    breaks: (m,), s. coefficients: (m, 10). first, length: which of them are this curve's, whole
    numbers. time: s, of the curve.
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
    for k in range(DEGREE, -1, -1):
        p4 = p4 * dt + p3
        p3 = p3 * dt + p2
        p2 = p2 * dt + p1
        p1 = p1 * dt + p0
        p0 = p0 * dt + coefficients[low, k]
    return Derivatives(p0, p1, 2.0 * p2, 6.0 * p3, 24.0 * p4)
