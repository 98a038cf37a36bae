"""The law of eight runs: vectorised, or run by run if it branches on its values.

A law with an `if`, or an index, that depends on values of a run does not compile for vectors. It is
called by its address, as in the loop of one run; the rest of the tick is vectorised.
"""

from functools import cache
from typing import Any, NamedTuple

import numba
import numpy as np
from numba.core.errors import NumbaError

from svsa.actuators.dynamics import Actuator
from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.control.call import BoundLaw, Call, compute_law, is_measuring
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose
from svsa.numerics.simd.elementwise import put, take
from svsa.numerics.simd.number import WIDTH
from svsa.numerics.simd.record import Column, VectorRecord, find_kind
from svsa.simulation.loop.lane import AT_REST, NO_REFERENCE, NO_TORQUE, UNDISTURBED, UNMOVED
from svsa.simulation.loop.stepwise import EXCHANGED, call_python


def is_for_vectors(
    control: Any, nominal: Actuator, constants: tuple[Any, ...], memory: Any
) -> bool:
    """Return whether a law's function compiles for vectors; compiles it if necessary.

    Args:
        control: The law's function.
        nominal: The nominal model.
        constants: Constants of the law.
        memory: Layout of its memory, see `lay_out_record`.

    Returns:
        Whether it compiles.
    """
    return _compile(control, find_kind(_lay_out(nominal)), find_kind(_lay_out(constants)), memory)


def _lay_out(values: Any) -> Any:
    if isinstance(values, tuple):
        parts = map(_lay_out, values)
        return type(values)(*parts) if hasattr(values, "_fields") else tuple(parts)
    return values if isinstance(values, int) else Column(0)


_SIGNALS = (AT_REST, NO_REFERENCE, UNDISTURBED, NO_TORQUE)


@cache
def _compile(control: Any, nominal: Any, constants: Any, memory: Any) -> bool:
    signals = [find_kind(_lay_out(signal)) for signal in _SIGNALS]
    reported = [find_kind(_lay_out(UNMOVED))] if is_measuring(control) else []
    kinds = nominal, constants, VectorRecord(memory), *signals, numba.float64, *reported
    try:
        # Compilation is the test: numba rejects an `if` on a vector by its type.
        control.get_call_template(kinds, {})
    except NumbaError:
        return False
    return True


class Addresses(NamedTuple):
    """A `BoundLaw` as addresses: valid while its arrays exist."""

    function_address: int
    nominal_address: int
    constants_address: int
    is_measuring: int


def find_addresses(law: BoundLaw) -> Addresses:
    """Return `Addresses` of a law; the caller must keep its arrays alive."""
    words = law.nominal.ctypes.data, law.constants.ctypes.data
    return Addresses(law.function, *words, int(law.is_measuring))


class GroupLaw(NamedTuple):
    """The law of eight runs.

    Attributes:
        nominal: The nominal model.
        constants: Values, or `Addresses`.
        is_measuring: As in `BoundLaw`.
    """

    nominal: Actuator
    constants: Any
    is_measuring: bool


class GroupCall(NamedTuple):
    """A `GroupLaw` with its memory, for the active runs."""

    nominal: Actuator
    constants: Any
    memory: Any
    is_measuring: bool
    runs: bool


@compiled
def open_group_call(law: GroupLaw, memory: Any, runs: bool) -> GroupCall:
    """Build the `GroupCall` of a law for this tick."""
    return GroupCall(law.nominal, law.constants, memory, law.is_measuring, runs)


@compiled
def compute_one_by_one(
    group: GroupCall,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
    measured: Positions,
) -> Torque:
    """Compute u of the active runs one by one, `Torque`, N·m; 0 for ended ones.

    `group` contains the `Addresses` of every run's law, whose constants include the nominal model;
    its memory is (8, words), and is written. The other arguments are those of
    `svsa.control.call.compute_law`.
    """
    nothing, memories = Torque(0.0, 0.0), group.memory
    # Broadcasts the two scalars to vectors, which `put` needs below.
    torque = choose(group.runs, nothing, nothing)
    for i in range(WIDTH):
        if take(group.runs, i):
            law = take(group.constants, i)
            call = Call(
                law.function_address,
                law.nominal_address,
                law.constants_address,
                memories[i].ctypes.data,
                0,
                group.is_measuring,
            )
            commanded = compute_law(
                call,
                take(x, i),
                take(reference, i),
                take(estimate, i),
                take(applied, i),
                period,
                take(measured, i),
            )
            torque = put(torque, i, commanded)
    return torque


class PythonLaw(NamedTuple):
    """The law of eight runs as one Python function, by its address.

    It is called once per tick with the address of rows (8, `WORDS`), see `compute_in_python`.
    """

    function_address: int
    is_measuring: int = 1


WORDS = 1 + EXCHANGED
"""Values per run: whether it is active, and the values exchanged between loop and law."""


@compiled
def compute_in_python(
    group: GroupCall,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
    measured: Positions,
) -> Torque:
    """Compute u of the active runs, `Torque`, N·m, by one call of Python; 0 for ended ones.

    `group` contains a `PythonLaw`, whose memory has rows (8, `WORDS`): 1.0 if the run is active,
    the arguments of the law, and its answer. The other arguments are those of
    `svsa.control.call.compute_law`.
    """
    nothing, rows = Torque(0.0, 0.0), group.memory
    torque = choose(group.runs, nothing, nothing)
    for i in range(WIDTH):
        row = rows[i]
        row[0] = 1.0 if take(group.runs, i) else 0.0
        reached = fill(row, 1, take(reference, i))
        reached = fill(row, reached, take(x, i))
        reached = fill(row, reached, take(estimate, i))
        reached = fill(row, reached, take(applied, i))
        fill(row, reached, take(measured, i))
    call_python(take(group.constants, 0).function_address, rows.ctypes.data)
    for i in range(WIDTH):
        if take(group.runs, i):
            torque = put(torque, i, Torque(rows[i][WORDS - 2], rows[i][WORDS - 1]))
    return torque


@compiled
def fill(row: np.ndarray, first: int, values: tuple[float, ...]) -> int:
    """Write a tuple of numbers into a row from `first` on; return the next position."""
    for i in range(len(values)):
        row[first + i] = values[i]
    return first + len(values)


law: Any = None
is_reported: Any = None
"""Specialises `compute_side_by_side`: a law's function, and whether it receives the measured
positions.
"""


def compute_side_by_side(
    group: GroupCall,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
    measured: Positions,
) -> Torque:
    """Compute u of all eight, `Torque`, N·m, by `law` compiled for vectors."""
    nominal, constants, memory = group.nominal, group.constants, group.memory
    if is_reported:
        return law(nominal, constants, memory, x, reference, estimate, applied, period, measured)
    return law(nominal, constants, memory, x, reference, estimate, applied, period)
