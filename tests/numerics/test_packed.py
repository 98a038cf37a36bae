"""Named tuples as records: the same numbers under the same names in compiled code and Python."""

from typing import NamedTuple

import numpy as np

from svsa.actuators.signals import State, Torque
from svsa.numerics.compilation import compiled
from svsa.numerics.packed import pack, pack_all, view_field


class Outer(NamedTuple):
    count: int
    shares: tuple[float, float, float]
    inner: Torque


class Numbers(NamedTuple):
    known: State
    sent: Torque


@compiled
def add_up(packed):
    o = packed[0]
    return o.count + o.shares[2] + o.inner.u2


def test_compiled_code_reads_the_numbers_by_name():
    packed = pack(Outer(2**53 + 1, (1.0, 2.0, 0.5), Torque(3.0, -0.25)))
    assert packed["count"] == 2**53 + 1
    np.testing.assert_array_equal(packed["shares"], [[1.0, 2.0, 0.5]])
    assert packed["inner"].tolist() == [(3.0, -0.25)]
    assert add_up(pack(Outer(7, (1.0, 2.0, 0.5), Torque(3.0, -0.25)))) == 7.25


def test_field_is_a_writable_view_of_its_numbers():
    packed = pack(Numbers(State(1.0, 2.0, 3.0, 4.0, 5.0, 6.0), Torque(7.0, 8.0)))
    sent = view_field(packed, "sent")
    np.testing.assert_array_equal(view_field(packed, "known"), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    sent[:] = Torque(-1.0, -2.0)
    assert packed["sent"].tolist() == [(-1.0, -2.0)]
    assert packed["known"].tolist() == [(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)]


def test_tuples_of_one_kind_share_one_type_object() -> None:
    """Numba compares equal but distinct types field by field at every call: 8 µs per tick."""
    first, second = (pack(Outer(count, (1.0, 2.0, 0.5), Torque(3.0, 0.0))) for count in (1, 2))
    assert first.dtype is second.dtype
    assert pack_all([Outer(1, (1.0, 2.0, 0.5), Torque(3.0, 0.0))] * 2).dtype is first.dtype
