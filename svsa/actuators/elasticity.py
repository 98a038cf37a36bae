"""The spring and the transmission of any actuator, for the loop and the control laws.

The constants decide which code is compiled: the lever and the spring of the SVSA (`Actuator`), or
the functions of an elastic energy, called by their address (`ElasticActuator`). s is the stiffness
coordinate, s = s0 + κ θ2: the lever ratio μ of the SVSA. φ = q − θ1, rad.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic, overload

from svsa.actuators.energy import RESULTS
from svsa.actuators.lever import (
    compute_lever_ratio,
    compute_lever_ratio_for_stiffness,
    compute_lever_ratio_slope,
)
from svsa.actuators.spring import (
    REACTION_PRINTED,
    SpringDerivatives,
    SpringTorques,
    compute_elastic_torque,
    compute_printed_reaction_torque,
    compute_reaction_torque,
    compute_spring_derivatives,
    compute_stiffness,
    compute_stiffness_slope,
)
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import log
from svsa.numerics.simd.choice import choose, greatest, least, some
from svsa.numerics.simd.each import put, take
from svsa.numerics.simd.number import INLINED, VECTOR, WIDTH

_NEWTON_STEPS = 12


class Actuator(NamedTuple):
    """The constants of Eq 1–5: Table 1 or the nominal model, SI, gear output side.

    M, B1, B2: kg·m². D, D1, D2: N·m·s/rad. K = K_s R²: N·m/rad. gamma: 1. mu0: lever
    ratio at θ2 = 0, 1. reaction: `REACTION_ENERGY` or `REACTION_PRINTED`.
    """

    M: float
    B1: float
    B2: float
    D: float
    D1: float
    D2: float
    K: float
    gamma: float
    mu0: float
    reaction: int


class ElasticActuator(NamedTuple):
    """The constants of an actuator with an elastic energy U(φ, s), SI, gear output side.

    M … D2: as of `Actuator`. kappa: κ = ds/dθ2. mu0: s at θ2 = 0. lowest, highest: ends of s.
    The addresses are those of `svsa.actuators.energy`, of this process. e0 … e5: parameters of U.
    """

    M: float
    B1: float
    B2: float
    D: float
    D1: float
    D2: float
    kappa: float
    mu0: float
    lowest: float
    highest: float
    torques_address: int
    stiffness_address: int
    derivatives_address: int
    determinant_address: int
    e0: float
    e1: float
    e2: float
    e3: float
    e4: float
    e5: float


AnyActuator: TypeAlias = Actuator | ElasticActuator


def _build_call(name: str) -> Any:
    """A function of compiled code that calls one of an energy at an address, as C would."""
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
            return builder.call(builder.inttoptr(place, kind.as_pointer()), given)

        return result(address, s, phi, values), generate

    return intrinsic(call_address)


_call_torques = _build_call("compute_torques")
_call_stiffness = _build_call("compute_stiffness")
_call_derivatives = _build_call("compute_derivatives")
_call_determinant = _build_call("compute_determinant")


def _spread_torques(z: Any) -> SpringTorques:
    return SpringTorques(z, z)


def _spread_derivatives(z: Any) -> SpringDerivatives:
    return SpringDerivatives(z, z, z, z, z, z, z, z, z)


def _spread_number(z: Any) -> Any:
    return z


def _call_each(call: Any, spread: Callable[[Any], Any]) -> Any:
    """`call` of floats; of vectors one element after the other."""
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


_find_torques = _call_each(_call_torques, _spread_torques)
_find_stiffness = _call_each(_call_stiffness, _spread_number)
_find_derivatives = _call_each(_call_derivatives, _spread_derivatives)
_find_determinant = _call_each(_call_determinant, _spread_number)


def has_energy(kind: Any) -> bool:
    """Whether constants of this numba type are an `ElasticActuator`, or one packed."""
    return "torques_address" in kind.fields


def choose_kind(of_svsa: Any, of_energy: Any) -> Any:
    """A function (actuator, s, φ) of compiled code: one of two, by the type of the constants."""

    def compute(actuator: Any, s: Any, phi: Any) -> Any:
        raise NotImplementedError("of compiled code only")

    @overload(compute, jit_options=INLINED)
    def choose_function(actuator: Any, s: Any, phi: Any) -> Any:
        chosen = of_energy if has_energy(actuator) else of_svsa

        def call(actuator: Any, s: Any, phi: Any) -> Any:
            return chosen(actuator, s, phi)

        return call

    return compute


@compiled
def _list_values(actuator: ElasticActuator) -> tuple[float, ...]:
    a = actuator
    return (a.e0, a.e1, a.e2, a.e3, a.e4, a.e5)


@compiled
def _torques_of_svsa(actuator: Actuator, s: float, phi: float) -> SpringTorques:
    torque = compute_elastic_torque(s, phi, actuator.K)
    reaction = compute_reaction_torque(s, phi, actuator.K, actuator.gamma)
    printed = actuator.reaction == REACTION_PRINTED
    if some(printed):
        torque_printed = compute_printed_reaction_torque(s, phi, actuator.K)
        reaction = choose(printed, torque_printed, reaction)
    return SpringTorques(torque, reaction)


@compiled
def _torques_of_energy(actuator: ElasticActuator, s: float, phi: float) -> SpringTorques:
    found = _find_torques(actuator.torques_address, s, phi, _list_values(actuator))
    return SpringTorques(found.torque, actuator.kappa * found.reaction)


@compiled
def _stiffness_of_svsa(actuator: Actuator, s: float, phi: float) -> float:
    return compute_stiffness(s, phi, actuator.K)


@compiled
def _stiffness_of_energy(actuator: ElasticActuator, s: float, phi: float) -> float:
    return _find_stiffness(actuator.stiffness_address, s, phi, _list_values(actuator))


@compiled
def _derivatives_of_svsa(actuator: Actuator, s: float, phi: float) -> SpringDerivatives:
    return compute_spring_derivatives(s, phi, actuator.K)


@compiled
def _derivatives_of_energy(actuator: ElasticActuator, s: float, phi: float) -> SpringDerivatives:
    return _find_derivatives(actuator.derivatives_address, s, phi, _list_values(actuator))


@compiled
def _coordinate_of_svsa(actuator: Actuator, theta2: float, _: float) -> float:
    return compute_lever_ratio(theta2, actuator.mu0, actuator.gamma)


@compiled
def _coordinate_of_energy(actuator: ElasticActuator, theta2: float, _: float) -> float:
    return actuator.mu0 + theta2 * actuator.kappa


@compiled
def _slope_of_svsa(actuator: Actuator, _: float, __: float) -> float:
    return compute_lever_ratio_slope(actuator.gamma)


@compiled
def _slope_of_energy(actuator: ElasticActuator, _: float, __: float) -> float:
    return actuator.kappa


@compiled
def _stiffness_slope_of_svsa(actuator: Actuator, s: float, _: float) -> float:
    return compute_stiffness_slope(s, actuator.K, compute_lever_ratio_slope(actuator.gamma))


@compiled
def _stiffness_slope_of_energy(actuator: ElasticActuator, s: float, _: float) -> float:
    return _derivatives_of_energy(actuator, s, 0.0).sigma_mu * actuator.kappa


@compiled
def _inverse_of_svsa(actuator: Actuator, sigma: float, _: float) -> float:
    return compute_lever_ratio_for_stiffness(sigma, actuator.K)


@compiled
def _inverse_of_energy(actuator: ElasticActuator, sigma: float, _: float) -> float:
    """Newton for ln σ(s, 0) = ln σ_d, inside the ends of s."""
    low, high = actuator.lowest, actuator.highest
    s = 0.5 * (low + high)
    for _i in range(_NEWTON_STEPS):
        found = _derivatives_of_energy(actuator, s, 0.0)
        step = log(sigma / found.sigma) * found.sigma / found.sigma_mu
        s = least(greatest(s + step, low), high)
    return s


_torques = choose_kind(_torques_of_svsa, _torques_of_energy)
_stiffness = choose_kind(_stiffness_of_svsa, _stiffness_of_energy)
_derivatives = choose_kind(_derivatives_of_svsa, _derivatives_of_energy)
_coordinate = choose_kind(_coordinate_of_svsa, _coordinate_of_energy)
_slope = choose_kind(_slope_of_svsa, _slope_of_energy)
_stiffness_slope = choose_kind(_stiffness_slope_of_svsa, _stiffness_slope_of_energy)
_inverse = choose_kind(_inverse_of_svsa, _inverse_of_energy)


@compiled
def compute_coordinate(actuator: AnyActuator, theta2: float) -> float:
    """s = s0 + κ θ2; of the SVSA the lever ratio μ (Eq 4).

    actuator: constants. theta2: rad at the gearbox output.
    """
    return _coordinate(actuator, theta2, 0.0)


@compiled
def compute_coordinate_slope(actuator: AnyActuator) -> float:
    """κ = ds/dθ2, per rad; of the SVSA μ' = 1/(2πγ)."""
    return _slope(actuator, 0.0, 0.0)


@compiled
def compute_coordinate_for_stiffness(actuator: AnyActuator, sigma: float) -> float:
    """The s whose stiffness at φ = 0 is σ, or the nearest end of s. sigma: N·m/rad, > 0."""
    return _inverse(actuator, sigma, 0.0)


@compiled
def compute_torques(actuator: AnyActuator, s: float, phi: float) -> SpringTorques:
    """τ_e and τ_r = κ ∂U/∂s, `SpringTorques`, N·m, at s and φ (rad)."""
    return _torques(actuator, s, phi)


@compiled
def compute_stiffness_of(actuator: AnyActuator, s: float, phi: float) -> float:
    """σ = ∂²U/∂φ² at s and φ (rad), N·m/rad."""
    return _stiffness(actuator, s, phi)


@compiled
def compute_derivatives(actuator: AnyActuator, s: float, phi: float) -> SpringDerivatives:
    """τ_e, σ and their derivatives at s and φ (rad), `SpringDerivatives` with s as μ."""
    return _derivatives(actuator, s, phi)


@compiled
def compute_stiffness_slope_of(actuator: AnyActuator, s: float) -> float:
    """g = ∂σ/∂θ2 at s and φ = 0, N·m/rad²."""
    return _stiffness_slope(actuator, s, 0.0)


@compiled
def compute_determinant_of_energy(actuator: ElasticActuator, s: float, phi: float) -> float:
    """(σ σ_s − τ_s σ_φ) at φ over its value at φ = 0, which det A(x) is a multiple of."""
    return _find_determinant(actuator.determinant_address, s, phi, _list_values(actuator))
