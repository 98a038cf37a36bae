"""The loop with a plain Python controller, called once per tick by the compiled loop.

For the compiled loop the controller is a law like any other: the memory of that law contains the
arguments, and its function calls Python. Therefore the samples are bit-identical.
"""

import ctypes
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.control.call import BoundLaw, bind
from svsa.control.plain_law import SIGNATURE, find_named
from svsa.errors import ParameterError, Violation
from svsa.numerics.compilation import compiled
from svsa.numerics.packed import pack
from svsa.simulation.loop.deferred_signals import hold_signals
from svsa.simulation.loop.lane import (
    AT_REST,
    NO_REFERENCE,
    NO_TORQUE,
    UNDISTURBED,
    UNMOVED,
    Blocks,
    Inputs,
    LaneState,
)
from svsa.simulation.loop.loop import advance

Controller = Callable[..., tuple[float, float]]
"""Time (s), `Reference`, x̂ (`State`), ŵ (`Disturbance`) → (u1, u2), N·m. Optional by name:
`applied`, the mean actual `Torque` of the last period, and `measured`, `Positions`.
"""

_Call = ctypes.CFUNCTYPE(None, ctypes.c_void_p)


class _Exchange(NamedTuple):
    """Arguments and result of the controller."""

    reference: Reference
    x: State
    estimate: Disturbance
    applied: Torque
    measured: Positions
    answer: Torque


_ZEROS = _Exchange(NO_REFERENCE, AT_REST, UNDISTURBED, NO_TORQUE, UNMOVED, NO_TORQUE)
EXCHANGED = sum(map(len, _ZEROS))
"""Number of values that the loop and a controller exchange in a tick; the last two are the answer.
"""


class _Address(NamedTuple):
    function: int


def _build_python_call(typing: Any, address: Any, reported: Any) -> Any:
    """Build a call of the function at an address with a record's address, or with an address."""
    is_address = isinstance(reported, types.Integer)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        record = ir.IntType(8).as_pointer()
        function = ir.FunctionType(ir.VoidType(), [record]).as_pointer()
        asked = builder.inttoptr(arguments[0], function)
        place = builder.inttoptr if is_address else builder.bitcast
        builder.call(asked, [place(arguments[1], record)])
        return context.get_dummy_value()

    return types.void(types.int64, reported), generate


call_python: Any = intrinsic(_build_python_call)
"""Call the function at an address with the address of its arguments; in compiled code only."""


@compiled
def _compute_commanded(
    nominal: Any,
    address: Any,
    reported: Any,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
    measured: Positions,
) -> Torque:
    """Return the controller's torque, as `svsa.control.law.Law.control`."""
    to = reported.reference
    to.q, to.dq, to.ddq, to.dddq, to.ddddq = reference[:5]
    to.sigma, to.dsigma, to.ddsigma = reference[5:]
    at = reported.x
    at.q, at.dq, at.theta1, at.dtheta1, at.theta2, at.dtheta2 = x
    reported.estimate.w2, reported.estimate.w4, reported.estimate.w6 = estimate
    reported.applied.u1, reported.applied.u2 = applied
    y = reported.measured
    y.q, y.theta1, y.theta2 = measured
    call_python(address.function, reported)
    return Torque(reported.answer.u1, reported.answer.u2)


def advance_stepwise(
    blocks: Blocks,
    inputs: Inputs,
    lane: LaneState,
    first: int,
    samples: np.ndarray,
    controller: Controller,
) -> tuple[LaneState, int, int]:
    """Advance as `svsa.simulation.loop.loop.advance`, with the torque from `controller`.

    Exceptions of the controller are propagated.

    Raises:
        ParameterError: If the controller returns anything but two numbers, or has an unknown
            parameter.
    """
    tick, raised, named = first, list[BaseException](), _find_named(controller)

    def ask(address: int) -> None:
        nonlocal tick
        words = (ctypes.c_double * EXCHANGED).from_address(address)
        try:
            # An exception of a signal handler can be caught here, but not in the code of ctypes.
            held.handle()
            time = tick * blocks.period
            given = Reference(*words[:8]), State(*words[8:14]), Disturbance(*words[14:17])
            torque, positions = Torque(*words[17:19]), Positions(*words[19:22])
            reported: dict[str, tuple[float, ...]] = {"applied": torque, "measured": positions}
            answer = controller(time, *given, **{name: reported[name] for name in named})
            words[22:] = _read_torque(answer)
        # ctypes prints and drops an exception of a callback, also KeyboardInterrupt; therefore it
        # is stored, and raised after the compiled call.
        except BaseException as error:
            raised.append(error)
            # NaN ends the compiled loop at this tick.
            words[22:] = (np.nan, np.nan)
        tick += 1

    # ctypes frees the callback together with this object, so it must exist as long as `advance`
    # runs.
    called = _Call(ask)
    address = ctypes.cast(called, ctypes.c_void_p).value or 0
    nominal, constants, reported = pack(blocks.nominal), pack(_Address(address)), pack(_ZEROS)
    law: BoundLaw = bind(_compute_commanded, nominal, constants, reported, False)
    begun = lane._replace(memory=reported.view(np.float64))
    with hold_signals() as held:
        ended, done, code = advance(blocks, law, inputs, begun, first, samples)
    if raised:
        raise raised[0]
    return ended._replace(memory=lane.memory), done, code


def _find_named(controller: Controller) -> tuple[str, ...]:
    try:
        return find_named(controller)
    except TypeError as error:
        raise ParameterError(
            Violation("controller", None, "", SIGNATURE, finding=str(error))
        ) from None


def _read_torque(answer: object) -> Torque:
    try:
        u1, u2 = answer  # pyright: ignore[reportGeneralTypeIssues]
        return Torque(float(u1), float(u2))
    except (TypeError, ValueError):
        bound = "two torques (u1, u2) in N·m"
        raise ParameterError(Violation("the controller's answer", answer, "", bound)) from None
