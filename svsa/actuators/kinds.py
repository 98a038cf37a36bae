"""Selection of the code for an actuator's constants: the SVSA's, or that of an energy."""

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic, overload

from svsa.actuators.energy import RESULTS
from svsa.actuators.spring import SpringDerivatives, SpringState, SpringTorques, StiffnessMargin
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.elementwise import put, take
from svsa.numerics.simd.number import INLINED, VECTOR, WIDTH


def _build_call(name: str) -> Any:
    """Build a function of compiled code that calls an energy's function at an address."""
    result = RESULTS[name]

    def call_address(typing: Any, address: Any, s: Any, phi: Any, values: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            place, *numbers, tuple_of = arguments
            kinds = [s, phi, *values]
            numbers += [builder.extract_value(tuple_of, i) for i in range(len(values))]
            double = ir.DoubleType()
            kind = ir.FunctionType(context.get_value_type(result), [double] * len(kinds))
            given = [
                context.cast(builder, number, one, types.float64)
                for number, one in zip(numbers, kinds, strict=True)
            ]
            # No side effects: the compiler may merge two calls with equal arguments.
            effects = ("readnone", "nounwind")
            return builder.call(builder.inttoptr(place, kind.as_pointer()), given, attrs=effects)

        return result(address, s, phi, values), generate

    return intrinsic(call_address)


_call_torques = _build_call("compute_torques")
_call_margin = _build_call("compute_margin")
_call_state = _build_call("compute_state")


def _spread_torques(z: Any) -> SpringTorques:
    return SpringTorques(z, z)


def _spread_state(z: Any) -> SpringState:
    return SpringState(SpringTorques(z, z), SpringDerivatives(z, z, z, z, z, z, z, z, z))


def _spread_margin(z: Any) -> StiffnessMargin:
    return StiffnessMargin(SpringTorques(z, z), z, z)


def _call_each(call: Any, spread: Callable[[Any], Any]) -> Any:
    """Call `call` for floats; for vectors once per element."""
    spread = compiled(spread)

    def call_energy(address: Any, s: Any, phi: Any, values: Any) -> Any:
        raise NotImplementedError("of compiled code only")

    @overload(call_energy, jit_options=INLINED)
    def choose_call(address: Any, s: Any, phi: Any, values: Any) -> Any:
        def call_once(address: Any, s: Any, phi: Any, values: Any) -> Any:
            return call(address, s, phi, values)

        def call_vector(address: Any, s: Any, phi: Any, values: Any) -> Any:
            found = spread(s + phi)
            for i in range(WIDTH):
                one = call(take(address, i), take(s, i), take(phi, i), take(values, i))
                found = put(found, i, one)
            return found

        return call_vector if VECTOR in (s, phi) else call_once

    return call_energy


find_torques = _call_each(_call_torques, _spread_torques)
find_margin = _call_each(_call_margin, _spread_margin)
find_state = _call_each(_call_state, _spread_state)


def has_energy(kind: Any) -> bool:
    """Whether constants of this numba type are an `ElasticActuator`, or one packed."""
    return "torques_address" in kind.fields


def choose_kind(of_svsa: Any, of_energy: Any) -> Any:
    """Build a compiled function (actuator, s, φ) that selects one of two by the type of
    constants.
    """

    def compute(actuator: Any, s: Any, phi: Any) -> Any:
        raise NotImplementedError("of compiled code only")

    @overload(compute, jit_options=INLINED)
    def choose_function(actuator: Any, s: Any, phi: Any) -> Any:
        chosen = of_energy if has_energy(actuator) else of_svsa

        def call(actuator: Any, s: Any, phi: Any) -> Any:
            return chosen(actuator, s, phi)

        return call

    return compute
