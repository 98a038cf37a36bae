"""Sums of products are rounded once in compiled functions."""

import numpy as np
import pytest

from svsa.numerics.compilation import compiled

A = 1.0 + 2.0**-30
ONCE, TWICE = 2.0**-29 + 2.0**-60, 2.0**-29
"""A² − 1, exact, and with the product rounded first."""


@compiled
def add(a, b, c):
    return a * b + c, c + a * b


@compiled
def subtract(a, b, c):
    return a * b - c, c - a * b


@compiled
def keep(a, b, c):
    product = a * b
    return product - c


@compiled
def square_and_add(a, c):
    return add(a, a, c)[0]


def test_product_in_a_sum_is_rounded_once() -> None:
    assert add(A, A, -1.0) == (ONCE, ONCE)
    assert subtract(A, A, 1.0) == (ONCE, -ONCE)


def test_named_product_is_rounded_first() -> None:
    assert keep(A, A, 1.0) == TWICE


def test_inlining_does_not_change_the_rounding() -> None:
    assert square_and_add(A, -1.0) == ONCE


@pytest.mark.parametrize("numbers", [(7, 3, 1), (np.uint64(7), np.uint64(3), np.uint64(1))])
def test_integers_remain_integers(numbers: tuple[int, int, int]) -> None:
    assert add(*numbers) == (22, 22)
    assert all(isinstance(total, int) for total in add(*numbers))


def test_sums_of_arrays_are_unchanged() -> None:
    total, _ = add(2.0, np.array([1.0, 2.0]), np.array([0.5, 0.5]))
    assert total.tolist() == [2.5, 4.5]
