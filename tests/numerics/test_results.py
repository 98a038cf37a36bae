"""Python receives tuples from compiled functions that write numbers into an array."""

import time
from collections import namedtuple
from typing import NamedTuple

import numpy as np
import pytest
from numba.core import types
from numba.core.errors import TypingError
from numba.core.pythonapi import _boxers

from svsa.actuators.signals import Torque
from svsa.numerics.compilation import compiled
from svsa.numerics.results import MAX_NUMBERS


class Pair(NamedTuple):
    left: Torque
    rest: tuple[int, ...]
    memory: None = None


Other = namedtuple("Torque", "u1 u2")
"""Another class with the name of `Torque`."""
SEED = 2**64 - 1


@compiled
def return_value(value):
    return value


@compiled
def return_other(value):
    return value


@compiled
def return_pair(a, b=3.5):
    return Pair(Torque(a, b), (1, -2), None), a > b, a


@compiled
def return_array(rows) -> np.ndarray:
    return rows


@compiled
def return_undeclared(a) -> float:
    return Torque(a, a)


@pytest.mark.parametrize(
    "value",
    [
        Torque(1.5, -0.0), Torque(1, 2.5), (True, False), (), ((), (1,)), None,
        ((1, -(2**63), True), 2.5, (None, Torque(np.nan, np.inf))),
        (np.uint64(SEED), np.float32(0.1)),
        2.5, 7, True,
    ],
)  # fmt: skip
def test_result_has_the_types_and_values_of_the_tuple(value):
    result = return_value(value)
    assert (type(result), repr(result)) == (type(strip(value)), repr(strip(value)))


def test_classes_of_the_same_name_are_not_mixed_up():
    assert type(return_value(Torque(1.5, 2.5))) is Torque
    assert type(return_other(Other(1.5, 2.5))) is Other


def strip(value):
    """The value with Python's numbers in place of numpy's."""
    if isinstance(value, tuple):
        parts = map(strip, value)
        return type(value)(*parts) if hasattr(value, "_fields") else tuple(parts)
    return value.item() if isinstance(value, np.generic) else value


def test_arguments_may_be_left_out_or_given_by_name():
    expected = Pair(Torque(4.5, 3.5), (1, -2)), True, 4.5
    assert return_pair(4.5) == return_pair(a=4.5) == return_pair(4.5, b=3.5) == expected
    with pytest.raises(TypeError):
        return_pair(c=1.0)


def test_array_as_a_result_is_rejected_at_compilation():
    with pytest.raises(TypingError, match=r"cannot return array\(float64, 1d, C\) to Python"):
        return_array(np.zeros(2))
    with pytest.raises(TypingError, match="cannot return array"):
        return_value((1.0, np.zeros(2)))


def test_too_many_numbers_are_rejected_at_compilation():
    with pytest.raises(TypingError, match=f"more than {MAX_NUMBERS} numbers"):
        return_value((0.0,) * (MAX_NUMBERS + 1))


def test_tuple_of_a_function_annotated_as_a_number_is_rejected_at_compilation():
    with pytest.raises(TypingError, match=r"return_undeclared returns Torque.*annotated"):
        return_undeclared(1.0)


def test_compiled_code_receives_arrays_and_tuples():
    @compiled
    def add_up(rows) -> float:
        return return_array(rows)[1] + return_undeclared(2.0).u2

    assert add_up(np.array([1.0, 5.0])) == 7.0


def test_numba_compiles_no_conversion_of_a_tuple_to_python(monkeypatch):
    """The crash was in that code."""
    for kind in (types.Tuple, types.UniTuple, types.NamedTuple, types.NamedUniTuple, types.Array):
        monkeypatch.setitem(_boxers.functions, kind, None)

    @compiled
    def return_fresh(a):
        return (a, 1.5), (a, a), fresh

    fresh = time.time_ns()  # part of the code: it is not in the cache
    assert return_fresh(7) == ((7, 1.5), (7, 7), fresh)
