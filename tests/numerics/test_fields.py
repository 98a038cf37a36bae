"""Functions of each value of a tuple, in compiled functions."""

from typing import NamedTuple

import numpy as np

from svsa.numerics.compilation import compiled
from svsa.numerics.fields import each, full_like, replace_item, take


class Pair(NamedTuple):
    """Two values."""

    first: float
    second: float


class Other(NamedTuple):
    """A value of the same name in another place, of another type."""

    second: int


@compiled
def add(a, pair, c):
    return a + pair.second + c


@compiled
def evaluate(values, pairs, array):
    changed = replace_item(values, len(values) - 1, 10.0)
    sums = each(add, (values, pairs, array[0]))
    return changed, full_like(values, True), sums, take(pairs, "second"), take((values, changed), 1)


def test_items_of_each_tuple_are_arguments_of_one_call():
    values, pairs = (1.0, 2.0), (Pair(3.0, 4.0), Other(5))
    changed, full, sums, seconds, items = evaluate(values, pairs, np.array([0.5]))
    assert changed == (1.0, 10.0)
    assert full == (True, True)
    assert sums == (5.5, 7.5)
    assert seconds == (4.0, 5)
    assert items == (2.0, 10.0)
