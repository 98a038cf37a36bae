"""The equations' own sine, cosine, arc cosine and exponentials against 50-digit arithmetic."""

import math
import re
from collections.abc import Callable, Iterable

import llvmlite.binding as llvm
import mpmath
import numba
import numpy as np
import pytest
from numpy.testing import assert_array_equal

from svsa.numerics import exponential, trigonometry
from svsa.numerics.exponential import exp, expm1, log, log1p, sinh_cosh, tanh
from svsa.numerics.fused import fma
from svsa.numerics.trigonometry import acos, cos, sin, sin_cos, sin_versin
from tests.numerics.minimax import KERNELS, find_coefficients

RANDOM = np.random.default_rng(4)
COUNT = 1000

AROUND_ZERO = RANDOM.uniform(-math.pi / 4, math.pi / 4, COUNT)
SMALL = RANDOM.choice([-1.0, 1.0], COUNT) * 10.0 ** RANDOM.uniform(-300, 0, COUNT)
TURNS = RANDOM.uniform(-1e4, 1e4, COUNT)
LONG_SESSION = RANDOM.uniform(-1e9, 1e9, COUNT)
NEAR_QUADRANTS = RANDOM.integers(-(10**6), 10**6, COUNT) * (math.pi / 2)
ANGLES = np.concatenate([AROUND_ZERO, SMALL, TURNS, LONG_SESSION, NEAR_QUADRANTS])


def find_worst(
    function: Callable[[float], float], exact: Callable, places: Iterable[float]
) -> float:
    """Return the largest error in units of the last place."""
    worst = 0.0
    with mpmath.workdps(50):
        for place in places:
            true = exact(mpmath.mpf(float(place)))
            error = float(abs(mpmath.mpf(function(float(place))) - true))
            worst = max(worst, error / math.ulp(float(true)))
    return worst


def test_sine_and_cosine_are_within_one_unit_of_the_last_place() -> None:
    assert find_worst(sin, mpmath.sin, ANGLES) < 0.8
    assert find_worst(cos, mpmath.cos, ANGLES) < 0.8


def test_sine_and_versine_of_small_angles_need_no_reduction() -> None:
    """Within one unit of the last place up to π/4, 10⁻⁹ beyond it up to π/2."""
    assert find_worst(lambda x: sin_versin(x)[0], mpmath.sin, AROUND_ZERO) < 1.0
    exact = lambda x: 2 * mpmath.sin(x / 2) ** 2  # noqa: E731
    assert find_worst(lambda x: sin_versin(x)[1], exact, AROUND_ZERO) < 1.5
    for x in np.linspace(-math.pi / 2, math.pi / 2, 101):
        assert sin_versin(x) == pytest.approx((math.sin(x), 1.0 - math.cos(x)), abs=1e-9)


def test_combined_functions_equal_the_single_functions() -> None:
    assert [sin_cos(x) for x in TURNS] == [(sin(x), cos(x)) for x in TURNS]


def test_arc_cosine_is_within_one_unit_of_the_last_place() -> None:
    """From ½ to 1; near 1 to the resolution of a double."""
    near_one = 1.0 - 2.0 ** -RANDOM.uniform(1.0, 53.0, COUNT)
    places = np.concatenate([RANDOM.uniform(0.5, 1.0, COUNT), near_one])
    assert find_worst(acos, mpmath.acos, places) < 0.8
    assert acos(1.0) == 0.0
    assert math.isnan(acos(1.0 + 1e-15))


@pytest.mark.parametrize(
    ("function", "exact", "places", "bound"),
    [
        (exp, mpmath.exp, RANDOM.uniform(-700.0, 700.0, COUNT), 1.0),
        (expm1, mpmath.expm1, RANDOM.uniform(-3.0, 3.0, COUNT), 1.5),
        (expm1, mpmath.expm1, SMALL, 1.0),
        (log, mpmath.log, 10.0 ** RANDOM.uniform(-300, 300, COUNT), 1.5),
        (log, mpmath.log, RANDOM.uniform(0.0, 2.0, COUNT), 1.5),
        (log1p, mpmath.log1p, RANDOM.uniform(0.0, 3.0, COUNT), 1.5),
        (log1p, mpmath.log1p, np.abs(SMALL), 1.5),
        (tanh, mpmath.tanh, RANDOM.uniform(-20.0, 20.0, COUNT), 3.0),
        (tanh, mpmath.tanh, SMALL, 3.0),
        (lambda x: sinh_cosh(x)[0], mpmath.sinh, RANDOM.uniform(-700.0, 700.0, COUNT), 1.5),
        (lambda x: sinh_cosh(x)[0], mpmath.sinh, RANDOM.uniform(-3.0, 3.0, COUNT), 2.5),
        (lambda x: sinh_cosh(x)[0], mpmath.sinh, SMALL, 1.5),
        (lambda x: sinh_cosh(x)[1], mpmath.cosh, RANDOM.uniform(-3.0, 3.0, COUNT), 1.5),
        (lambda x: sinh_cosh(x)[1], mpmath.cosh, RANDOM.uniform(-700.0, 700.0, COUNT), 1.5),
    ],
)
def test_exponentials_and_logarithms_are_within_their_bounds(
    function: Callable, exact: Callable, places: np.ndarray, bound: float
) -> None:
    """In units of the last place."""
    assert find_worst(function, exact, places) < bound


def test_infinite_and_nan_arguments_give_the_limit_or_nan() -> None:
    for x in (math.nan, math.inf, -math.inf):
        assert all(math.isnan(value) for value in sin_cos(x))
    for function in (exp, expm1, acos, tanh):
        assert math.isnan(function(math.nan))
    assert exp(-1e300) == pytest.approx(0.0, abs=1e-300)
    assert expm1(-1e300) == -1.0
    assert math.isfinite(exp(1e300))
    assert (tanh(1e300), tanh(-1e300)) == (1.0, -1.0)
    assert all(math.isnan(value) for value in sinh_cosh(math.nan))
    assert [value > 1e300 for value in (-sinh_cosh(-800.0)[0], *sinh_cosh(800.0))] == [True] * 3


@pytest.mark.parametrize(
    ("module", "symbol", "name"),
    [
        (trigonometry, "S", "SINE"),
        pytest.param(trigonometry, "C", "COSINE", marks=pytest.mark.exhaustive),
        pytest.param(trigonometry, "P", "ARC_SINE", marks=pytest.mark.exhaustive),
        pytest.param(exponential, "E", "EXPONENTIAL", marks=pytest.mark.exhaustive),
        pytest.param(exponential, "L", "LOGARITHM", marks=pytest.mark.exhaustive),
    ],
)
def test_coefficients_are_those_of_the_exchange_algorithm(
    module: object, symbol: str, name: str
) -> None:
    assert_array_equal(getattr(module, symbol), find_coefficients(KERNELS[name]))


def test_split_constants_are_the_nearest_doubles_of_the_remainders() -> None:
    with mpmath.workdps(80):
        for whole, parts in (
            (mpmath.pi / 2, trigonometry.HALF_PI),
            (mpmath.log(2), exponential.LN_2),
        ):
            left = +whole
            for part in parts:
                assert part == float(left)
                left -= mpmath.mpf(part)


def test_fused_product_is_rounded_once() -> None:
    """(1 + 2⁻³⁰)² − 1 = 2⁻²⁹ + 2⁻⁶⁰, of which two roundings keep only the first."""
    compiled = numba.njit(lambda a, b, c: fma(a, b, c))
    assert compiled(1.0 + 2.0**-30, 1.0 + 2.0**-30, -1.0) == 2.0**-29 + 2.0**-60


@pytest.mark.parametrize("triple", ["aarch64-unknown-linux-gnu", "x86_64-unknown-linux-gnu"])
def test_compiler_fuses_explicit_multiply_adds_only(triple: str) -> None:
    """Code that numba passes to LLVM, compiled for two machines with a multiply-add."""
    apart = _compile_for(triple, numba.njit(lambda a, b, c: a * b + c))
    fused = _compile_for(triple, numba.njit(lambda a, b, c: fma(a, b, c)))
    multiply_add = re.compile(r"\bv?fn?m(add|sub)\w*")
    assert not multiply_add.search(apart)
    assert multiply_add.search(fused)


def _compile_for(triple: str, function: Callable) -> str:
    """Return the assembly of a compiled function of three numbers for another machine."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    function(1.0, 2.0, 3.0)
    (code,) = function.inspect_llvm().values()  # pyright: ignore[reportFunctionMemberAccess]
    code = re.sub(r'target triple = ".*"', f'target triple = "{triple}"', code)
    code = re.sub(r'target datalayout = ".*"\n', "", code)
    features = "+fma" if triple.startswith("x86") else ""
    machine = llvm.Target.from_triple(triple).create_target_machine(
        opt=3, reloc="pic", features=features
    )
    return machine.emit_assembly(llvm.parse_assembly(code))
