"""Sine, cosine and arc cosine by additions and multiplications: the same bits on every machine.

glibc selects among several sines by the processor, and other libm implementations differ. These
functions consist of operations that IEEE 754 rounds in exactly one way (see `svsa.numerics.fused`),
and a compiler can vectorise them. The polynomials are minimax, P of degree n in z = r²:

    sin r = r + r z S(z),  cos r = 1 − z/2 + z² C(z)        |r| ≤ π/4
    asin s = s + s z P(z)                                   0 ≤ s ≤ ½

Their coefficients come from `tests/numerics/minimax.py`; `test_trigonometry` compares them with the
exact values: within 1 ulp.
"""

import math

from svsa.numerics.compilation import compiled
from svsa.numerics.fused import fma
from svsa.numerics.simd.choice import choose, greatest
from svsa.numerics.simd.rounding import floor

TWO_OVER_PI = 2.0 / math.pi
HALF_PI = (1.5707963267948966, 6.123233995736766e-17, -1.4973849048591698e-33)
"""π/2 in three parts, each the nearest double to the remainder."""
TINY = 1e-300

S = (
    -0.1666666666666663,
    0.008333333333322118,
    -0.00019841269829589634,
    2.755731362140084e-06,
    -2.5050747763136695e-08,
    1.589623008633134e-10,
)
C = (
    0.041666666666666595,
    -0.0013888888888873058,
    2.4801587288852364e-05,
    -2.7557314179465517e-07,
    2.0875700862014715e-09,
    -1.135853741844779e-11,
)
P = (
    0.16666666666665408,
    0.07500000000336965,
    0.04464285682836556,
    0.030381959135545103,
    0.022371758082349945,
    0.017359704307933002,
    0.013885239768346604,
    0.012169184378425728,
    0.006528089740386552,
    0.019527959960141346,
    -0.016223784943522127,
    0.03191195603826944,
)


@compiled
def sin_versin(x: float) -> tuple[float, float]:
    """(sin x, 1 − cos x), rad, for |x| ≤ π/4, without range reduction.

    Beyond this range both gradually lose digits: the error is 3·10⁻¹⁰ at π/2.
    """
    z = x * x
    s = fma(z, fma(z, fma(z, fma(z, fma(z, S[5], S[4]), S[3]), S[2]), S[1]), S[0])
    c = fma(z, fma(z, fma(z, fma(z, fma(z, C[5], C[4]), C[3]), C[2]), C[1]), C[0])
    return fma(x * z, s, x), fma(-z * z, c, 0.5 * z)


@compiled
def sin_cos(x: float) -> tuple[float, float]:
    """(sin x, cos x); x in rad, |x| ≤ 10⁹. NaN if x is not finite.

    x = k π/2 + r + y with |r| ≤ π/4 and y the remainder that r cannot represent (Cody and Waite,
    with a fused product, so that r is exact before its last part); k determines the quadrant.
    """
    k = floor(x * TWO_OVER_PI + 0.5)
    exact = fma(-k, HALF_PI[0], x)
    part = k * HALF_PI[1]
    r = exact - part
    # In order: the rounding error of the subtraction, that of k·HALF_PI[1], and the third part of
    # π/2.
    y = (exact - r) - part - fma(k, HALF_PI[2], fma(k, HALF_PI[1], -part))
    z = r * r
    rest = fma(z, fma(z, fma(z, fma(z, fma(z, S[5], S[4]), S[3]), S[2]), S[1]), S[0])
    sine = r + fma(r * z, rest, fma(-0.5 * z, y, y))
    rest = fma(z, fma(z, fma(z, fma(z, fma(z, C[5], C[4]), C[3]), C[2]), C[1]), C[0])
    high = fma(-0.5, z, 1.0)
    low = fma(-0.5, z, 1.0 - high)
    cosine = high + (low + fma(z * z, rest, -r * y))
    # The quadrant is computed with floats alone, so that the same lines compile for vectors.
    half = floor(0.5 * k)
    sign = 1.0 - 2.0 * (half - 2.0 * floor(0.5 * half))
    even = k == 2.0 * half
    return sign * choose(even, sine, cosine), sign * choose(even, cosine, -sine)


@compiled
def sin(x: float) -> float:
    """sin x; x in rad, |x| ≤ 10⁹. NaN where x is not finite."""
    return sin_cos(x)[0]


@compiled
def cos(x: float) -> float:
    """cos x; x in rad, |x| ≤ 10⁹. NaN where x is not finite."""
    return sin_cos(x)[1]


@compiled
def acos(x: float) -> float:
    """arccos x = 2 asin √((1 − x)/2), rad, for ½ ≤ x ≤ 1; NaN above 1."""
    z = 0.5 - 0.5 * x
    s = math.sqrt(z)
    # The rounding error of the square root, by one Newton step. At x = 1 both s and the numerator
    # are 0, and TINY prevents 0/0.
    low = 0.5 * fma(-s, s, z) / greatest(s, TINY)
    p = fma(z, fma(z, fma(z, P[11], P[10]), P[9]), P[8])
    p = fma(z, fma(z, fma(z, fma(z, p, P[7]), P[6]), P[5]), P[4])
    p = fma(z, fma(z, fma(z, fma(z, p, P[3]), P[2]), P[1]), P[0])
    return 2.0 * (s + fma(s * z, p, low))
