"""Eight doubles side by side: each element has the bits that the float on its own has.

These tests cover the internal interfaces of numba that the lab uses: if a release changes them, a
test fails.
"""

import math
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numba.core.errors import TypingError

from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp, expm1, log, log1p, tanh
from svsa.numerics.fused import fma
from svsa.numerics.simd.choice import choose, greatest, least, some
from svsa.numerics.simd.memory import load, store
from svsa.numerics.simd.number import WIDTH
from svsa.numerics.trigonometry import acos, sin_cos

SPECIAL = (0.0, -0.0, math.inf, -math.inf, math.nan, 5e-324, 1e308, -1.0, 0.5)
NUMBERS = st.floats(allow_nan=True, width=64) | st.sampled_from(SPECIAL)
ROW = st.lists(NUMBERS, min_size=WIDTH, max_size=WIDTH)


class Pair(NamedTuple):
    first: float
    second: float


@compiled
def calculate(x, y):
    total = x + y * 2.0 - 3 / (x - 0.25) + fma(x, y, -x)
    total += np.floor(x) * math.sqrt(abs(y))
    return total, -x * y + total


@compiled
def decide(x, y):
    inside = (x < y) & (x >= -2.0) | (y == 0.5) | (x != x)
    chosen = choose(inside, Pair(x + y, 1.0), Pair(-x, y))
    return chosen.first * chosen.second, least(x, y) - greatest(y, 0.5)


@compiled
def calculate_functions(x, y):
    s, c = sin_cos(x)
    a = acos(0.5 + abs(y))
    return s - c * a, exp(x) + expm1(y) * log(abs(x)) + log1p(abs(y)) - tanh(x)


@compiled
def run_vectors(function, rows, out):
    a, b = function(load(rows, 0), load(rows, 1))
    store(out, 0, a)
    store(out, 1, b)


@compiled
def evaluate_some(rows):
    return some(load(rows, 0) > load(rows, 1))


def assert_same_bits(a: np.ndarray, b: np.ndarray) -> None:
    both = np.isnan(a) & np.isnan(b)
    np.testing.assert_array_equal(
        np.where(both, 0, a.view(np.int64)), np.where(both, 0, b.view(np.int64))
    )


@pytest.mark.exhaustive
@pytest.mark.parametrize("function", [calculate, decide])
@settings(max_examples=200)
@given(x=ROW, y=ROW)
def test_element_has_the_bits_of_the_float(function, x, y) -> None:
    rows, out = np.array([x, y]), np.empty((2, WIDTH))
    run_vectors(function, rows, out)
    assert_same_bits(out, np.array([function(*pair) for pair in rows.T]).T)


@pytest.mark.exhaustive
@settings(max_examples=200)
@given(
    x=st.lists(st.floats(1e-250, 1e9) | st.floats(-1e9, -1e-250), min_size=WIDTH, max_size=WIDTH),
    y=st.lists(st.floats(0.0, 0.5), min_size=WIDTH, max_size=WIDTH),
)
def test_compiled_functions_are_equal_in_a_vector(x, y) -> None:
    rows, out = np.array([x, y]), np.empty((2, WIDTH))
    run_vectors(calculate_functions, rows, out)
    assert_same_bits(out, np.array([calculate_functions(*pair) for pair in rows.T]).T)


def test_least_and_greatest_propagate_nan_by_argument_order() -> None:
    """As `min` and `max`: a limit of NaN is NaN, which the guard then detects."""
    limit = compiled(lambda u, bound: least(greatest(u, -bound), bound))
    assert math.isnan(limit(math.nan, 3.0))
    assert limit(5.0, 3.0) == 3.0
    assert limit(-5.0, 3.0) == -3.0
    assert (least(math.nan, 1.0) is math.nan) and least(1.0, math.nan) == 1.0
    assert limit.py_func(-5.0, 3.0) == -3.0, "in Python too"


@pytest.mark.parametrize("element", range(WIDTH))
def test_some_is_true_for_one_element(element: int) -> None:
    rows = np.zeros((2, WIDTH))
    assert not evaluate_some(rows)
    rows[0, element] = 1.0
    assert evaluate_some(rows)


def test_branch_on_a_vector_is_rejected() -> None:
    @compiled
    def branch(rows):
        if load(rows, 0) > 0.0:
            return 1.0
        return 0.0

    with pytest.raises(TypingError, match="mask"):
        branch(np.zeros((1, WIDTH)))


def test_machine_code_uses_vector_instructions() -> None:
    """Multiply-adds of eight, or of the halves or quarters that a narrower machine has."""
    run_vectors(calculate, np.ones((2, WIDTH)), np.empty((2, WIDTH)))
    code = next(iter(run_vectors.inspect_llvm().values()))
    assert "llvm.fma.v8f64" in code
    assert "fmul double" not in code
