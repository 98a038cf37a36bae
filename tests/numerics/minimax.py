"""Where the coefficients of `svsa.numerics.trigonometry` and `exponential` come from.

`find_coefficients(KERNELS["SINE"])` computes a table again. Remez's exchange algorithm in 40 digits
finds the polynomial P of the given degree with the smallest maximum relative error of the final
function. Each coefficient is then rounded to the nearest double.
"""

from collections.abc import Callable
from typing import NamedTuple

import mpmath
from mpmath import mp, mpf

DIGITS = 40
GRID = 40
ROUNDS = 8
TINY = mpf(10) ** -9

Function = Callable[[mpf], mpf]


class Kernel(NamedTuple):
    """P(z) of this degree on (low, high), where `compute` is what it stands for.

    weigh: the weight of an error of P, relative to the final function.
    """

    compute: Function
    weigh: Function
    degree: int
    low: mpf
    high: mpf


def _evaluate(coefficients: list[mpf], z: mpf) -> mpf:
    value = mpf(0)
    for coefficient in reversed(coefficients):
        value = value * z + coefficient
    return value


def _find_extrema(error: Function, low: mpf, high: mpf, count: int) -> list[mpf]:
    """The largest |error| of each of `count` intervals of constant sign."""
    places = [
        (low + high) / 2 - (high - low) / 2 * mpmath.cos(mpmath.pi * k / (GRID * count))
        for k in range(GRID * count + 1)
    ]
    values = [error(z) for z in places]
    stretches: list[tuple[mpf, mpf]] = []
    for place, value in zip(places, values, strict=True):
        if not stretches or stretches[-1][1] * value < 0:
            stretches.append((place, value))
        elif abs(value) > abs(stretches[-1][1]):
            stretches[-1] = (place, value)
    while len(stretches) > count:
        stretches.pop(0 if abs(stretches[0][1]) < abs(stretches[-1][1]) else -1)
    return [place for place, _ in stretches]


def find_coefficients(kernel: Kernel) -> list[float]:
    """The coefficients of P, lowest power first."""
    compute, weigh, degree, low, high = kernel
    count = degree + 2
    places = [
        (low + high) / 2 - (high - low) / 2 * mpmath.cos(mpmath.pi * (2 * k + 1) / (2 * count))
        for k in range(count)
    ]
    powers: list[mpf] = []
    for _ in range(ROUNDS):
        rows = [
            [z**k for k in range(degree + 1)] + [(-1) ** i / weigh(z)] for i, z in enumerate(places)
        ]
        solution = mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix([compute(z) for z in places]))
        powers = list(solution)[: degree + 1]
        found = _find_extrema(
            lambda z, p=powers: weigh(z) * (_evaluate(p, z) - compute(z)),
            low,
            high,
            count,
        )
        if len(found) < count:
            break
        places = found
    return [float(c) for c in powers]


mp.dps = DIGITS

_QUARTER = (mpmath.pi / 4) ** 2
_HALF_LOG2 = mpmath.log(2) / 2 * mpf("1.0001")
_LOG = (3 - 2 * mpmath.sqrt(2)) ** 2 * mpf("1.0001")


def _asin_rest(z: mpf) -> mpf:
    s = mpmath.sqrt(z)
    return (mpmath.asin(s) / s - 1) / z


def _sine_rest(z: mpf) -> mpf:
    x = mpmath.sqrt(z)
    return (mpmath.sin(x) / x - 1) / z


KERNELS = {
    "SINE": Kernel(
        _sine_rest, lambda z: z * mpmath.sqrt(z) / mpmath.sin(mpmath.sqrt(z)), 5, TINY, _QUARTER
    ),
    "COSINE": Kernel(
        lambda z: (mpmath.cos(mpmath.sqrt(z)) - 1 + z / 2) / z**2,
        lambda z: z**2 / mpmath.cos(mpmath.sqrt(z)),
        5,
        mpf("1e-5"),
        _QUARTER,
    ),
    "ARC_SINE": Kernel(
        _asin_rest, lambda z: z * mpmath.sqrt(z) / mpmath.asin(mpmath.sqrt(z)), 11, TINY, mpf(1) / 4
    ),
    "EXPONENTIAL": Kernel(
        lambda r: mpmath.fsum(r**k / mpmath.factorial(k + 3) for k in range(30)),
        lambda r: mpf(1),
        10,
        -_HALF_LOG2,
        _HALF_LOG2,
    ),
    "LOGARITHM": Kernel(
        lambda z: (mpmath.atanh(mpmath.sqrt(z)) / mpmath.sqrt(z) - 1) / z,
        lambda z: z,
        8,
        TINY,
        _LOG,
    ),
}
