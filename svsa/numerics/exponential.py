"""Exponentials and logarithms, bit-identical on every machine.

Computed by additions, multiplications and exact scalings by powers of 2, as in
`svsa.numerics.trigonometry`:

    e^r = 1 + r + r²/2 + r³ E(r)                            |r| ≤ ½ ln 2
    ln(1 + f) = 2 atanh s = 2s + 2s z L(z), z = s²          s = f/(2 + f), ½√2 ≤ 1 + f ≤ √2

Their coefficients come from `tests/numerics/minimax.py`; `test_trigonometry` compares them with the
exact values.
"""

import math

from svsa.numerics.compilation import compiled
from svsa.numerics.fused import fma
from svsa.numerics.simd.choice import choose, greatest, least
from svsa.numerics.simd.power import raise_two, take_exponent, take_fraction
from svsa.numerics.simd.rounding import floor

LOG2_E = 1.4426950408889634
LN_2 = (0.6931471805599453, 2.3190468138462996e-17)
"""ln 2 in two parts, the second the nearest double to the remainder."""
HALF_SQRT_2 = 0.7071067811865476
MIN_EXPONENT, MAX_EXPONENT = -745.0, 709.0
"""Outside, eˣ is nearly zero or near the upper limit of a double."""

E = (
    0.16666666666666666,
    0.04166666666666667,
    0.008333333333333335,
    0.0013888888888883748,
    0.00019841269841260178,
    2.4801587325548874e-05,
    2.7557319254486507e-06,
    2.7557273641940693e-07,
    2.5052064183762132e-08,
    2.091468738923789e-09,
    1.6088927909400918e-10,
)
L = (
    0.3333333333333333,
    0.19999999999999968,
    0.14285714285729287,
    0.11111111107673019,
    0.09090909536281103,
    0.07692272899796757,
    0.06668336680856263,
    0.05834304510699724,
    0.06017188559825755,
)
MAX_POWER = 1010.0
H = tuple(1.0 / math.factorial(n) for n in range(2, 14))
"""The Taylor coefficients of cosh and sinh from r²/2! on; the remainder is below 10⁻¹⁷."""


@compiled
def split_exponent(x: float) -> tuple[float, float]:
    """(2^k, e^r − 1) with x = k ln 2 + r, |r| ≤ ½ ln 2; x held between the two exponents."""
    x = least(greatest(x, MIN_EXPONENT), MAX_EXPONENT)
    k = floor(x * LOG2_E + 0.5)
    exact = fma(-k, LN_2[0], x)
    y = -k * LN_2[1]
    r = exact + y
    z = r * r
    e = fma(r, fma(r, fma(r, E[10], E[9]), E[8]), E[7])
    e = fma(r, fma(r, fma(r, fma(r, e, E[6]), E[5]), E[4]), E[3])
    e = fma(r, fma(r, fma(r, e, E[2]), E[1]), E[0])
    low = (exact - r) + y
    # Two numbers instead of their product, so that `expm1` can subtract 1 from 2^k first.
    return raise_two(k), r + fma(r * z, e, fma(0.5, z, low))


@compiled
def exp(x: float) -> float:
    """eˣ; beyond `MIN_EXPONENT` and `MAX_EXPONENT` that of the bound."""
    power, grown = split_exponent(x)
    return fma(power, grown, power)


@compiled
def expm1(x: float) -> float:
    """eˣ − 1, exact to the last digits for small x too; beyond the bounds that of the bound."""
    power, grown = split_exponent(x)
    # `exp(x) - 1` would lose the digits of a small x; here power is exactly 1 then.
    return fma(power, grown, power - 1.0)


@compiled
def log(x: float) -> float:
    """ln x for 10⁻³⁰⁰ ≤ x < ∞."""
    m, e = choose(abs(x) < math.inf, take_fraction(x), x), take_exponent(x)
    # The polynomial holds from ½√2 to √2, and `take_fraction` returns ½ to 1.
    small = m < HALF_SQRT_2
    m, e = choose(small, 2.0 * m, m), choose(small, e - 1.0, e)
    f = m - 1.0
    s = f / (2.0 + f)
    z = s * s
    p = fma(z, fma(z, fma(z, fma(z, L[8], L[7]), L[6]), L[5]), L[4])
    p = fma(z, fma(z, fma(z, fma(z, p, L[3]), L[2]), L[1]), L[0])
    half = 0.5 * f * f
    rest = half - fma(s, fma(2.0 * z, p, half), e * LN_2[1])
    return choose(e == 0.0, fma(e, LN_2[0], f - rest), e * LN_2[0] - (rest - f))


@compiled
def log1p(x: float) -> float:
    """ln(1 + x) for x > −1, exact to the last digits for small x too."""
    u = 1.0 + x
    # 1 + x rounds a small x. u − 1 is exact there, so that the difference is the rounding error.
    return log(u) + (x - (u - 1.0)) / u


@compiled
def tanh(x: float) -> float:
    """tanh x = −(e^(−2|x|) − 1)/(e^(−2|x|) + 1) with the sign of x."""
    # The negative exponent cannot overflow; the sign is restored at the end.
    t = expm1(-2.0 * abs(x))
    size = -t / (2.0 + t)
    return choose(x >= 0.0, size, -size)


@compiled
def sinh_cosh(x: float) -> tuple[float, float]:
    """sinh x and cosh x for |x| ≤ 700; beyond that, values of the same magnitude with the sign of
    x.

    x = k ln 2 + r, so that sinh x = sinh(k ln 2) cosh r + cosh(k ln 2) sinh r, and the hyperbolic
    functions of k ln 2 are sums of powers of 2. For small x, k is 0 and nothing cancels.
    """
    k = floor(x * LOG2_E + 0.5)
    r = fma(-k, LN_2[1], fma(-k, LN_2[0], x))
    power = least(greatest(k, -MAX_POWER), MAX_POWER)
    up, down = raise_two(power - 1.0), raise_two(-1.0 - power)
    S, C = up - down, up + down
    z = r * r
    z2 = z * z
    # In pairs: operations in a chain wait for each other, and a chain of six takes twice as long.
    sine = fma(z2, fma(z2, fma(z, H[11], H[9]), fma(z, H[7], H[5])), fma(z, H[3], H[1]))
    cosine = fma(z2, fma(z2, fma(z, H[10], H[8]), fma(z, H[6], H[4])), fma(z, H[2], H[0]))
    sine, cosine = fma(r * z, sine, r), z * cosine
    # The 1 of cosh r is added last, where it rounds least.
    return fma(S, cosine, fma(C, sine, S)), fma(C, cosine, fma(S, sine, C))
