"""The spring and the transmission of any actuator, for the loop and the control laws.

The constants decide which code is compiled: the lever and the spring of the SVSA (`Actuator`), or
the functions of an elastic energy, called by their address (`ElasticActuator`). s is the stiffness
coordinate, s = s0 + κ θ2: the lever ratio μ of the SVSA. φ = q − θ1, rad.
"""

import itertools
import math
from typing import NamedTuple, TypeAlias

from svsa.actuators.kinds import (
    choose_kind,
    find_margin,
    find_state,
    find_torques,
)
from svsa.actuators.lever import (
    compute_lever_ratio,
    compute_lever_ratio_for_stiffness,
    compute_lever_ratio_slope,
)
from svsa.actuators.mechanism import MAX_ELASTIC
from svsa.actuators.spring import (
    REACTION_PRINTED,
    SpringDerivatives,
    SpringState,
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

_NEWTON_STEPS, _HALVINGS = 12, 60
_FOUND = 1e-9
"""Largest relative difference of a stiffness that Newton's method has found."""


class Actuator(NamedTuple):
    """Constants of Eq 1–5 for the SVSA: Table 1 or the nominal model, SI, gear output side.

    Attributes:
        M: Inertia of the link, kg·m².
        B1: Inertia of motor 1, kg·m².
        B2: Inertia of motor 2, kg·m².
        D: Damping of the link, N·m·s/rad.
        D1: Damping of motor 1, N·m·s/rad.
        D2: Damping of motor 2, N·m·s/rad.
        K: Rotational stiffness K_s R², N·m/rad.
        gamma: Reduction γ of the spiral, 1.
        mu0: Lever ratio μ at θ2 = 0, 1.
        reaction: `REACTION_ENERGY` or `REACTION_PRINTED`.
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
    """Constants of an actuator with an elastic energy U(φ, s), SI, gear output side.

    M to D2 have the meaning of `Actuator`. The addresses are those of functions of
    `svsa.actuators.energy` in this process.

    Attributes:
        kappa: κ = ds/dθ2.
        mu0: s at θ2 = 0.
        lowest: Lower end of s.
        highest: Upper end of s.
        antagonistic: 1 if two motors pull against each other, otherwise 0.
        torques_address: Address of the function for τ_e and τ_r.
        margin_address: Address of the function for stiffness and determinant.
        state_address: Address of the function for all derivatives.
        e0: First parameter of U; e1 to e5 are the others.
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
    antagonistic: float
    torques_address: int
    margin_address: int
    state_address: int
    e0: float
    e1: float
    e2: float
    e3: float
    e4: float
    e5: float


AnyActuator: TypeAlias = Actuator | ElasticActuator


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
    found = find_torques(actuator.torques_address, s, phi, _list_values(actuator))
    return SpringTorques(found.torque, actuator.kappa * found.reaction)


@compiled
def _torques_inside_of_energy(actuator: ElasticActuator, s: float, phi: float) -> SpringTorques:
    found = find_margin(actuator.margin_address, s, phi, _list_values(actuator)).torques
    return SpringTorques(found.torque, actuator.kappa * found.reaction)


@compiled
def _stiffness_of_svsa(actuator: Actuator, s: float, phi: float) -> float:
    return compute_stiffness(s, phi, actuator.K)


@compiled
def _stiffness_of_energy(actuator: ElasticActuator, s: float, phi: float) -> float:
    return find_margin(actuator.margin_address, s, phi, _list_values(actuator)).sigma


@compiled
def _derivatives_of_svsa(actuator: Actuator, s: float, phi: float) -> SpringDerivatives:
    return compute_spring_derivatives(s, phi, actuator.K)


@compiled
def _derivatives_of_energy(actuator: ElasticActuator, s: float, phi: float) -> SpringDerivatives:
    return _state_of_energy(actuator, s, phi).derivatives


@compiled
def _state_of_svsa(actuator: Actuator, s: float, phi: float) -> SpringState:
    return SpringState(_torques_of_svsa(actuator, s, phi), _derivatives_of_svsa(actuator, s, phi))


@compiled
def _state_of_energy(actuator: ElasticActuator, s: float, phi: float) -> SpringState:
    found = find_state(actuator.state_address, s, phi, _list_values(actuator))
    reaction = actuator.kappa * found.torques.reaction
    return SpringState(SpringTorques(found.torques.torque, reaction), found.derivatives)


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
def _halve_coordinates(actuator: ElasticActuator, sigma: float) -> float:
    """The s with σ(s, 0) = σ_d, or the end of s that is nearest to it."""
    low, high = actuator.lowest, actuator.highest
    is_rising = _stiffness_of_energy(actuator, high, 0.0) > _stiffness_of_energy(actuator, low, 0.0)
    soft, stiff = choose(is_rising, low, high), choose(is_rising, high, low)
    for _i in range(_HALVINGS):
        middle = 0.5 * (soft + stiff)
        is_below = _stiffness_of_energy(actuator, middle, 0.0) < sigma
        soft, stiff = choose(is_below, middle, soft), choose(is_below, stiff, middle)
    return 0.5 * (soft + stiff)


@compiled
def _inverse_of_energy(actuator: ElasticActuator, sigma: float, _: float) -> float:
    """Newton for ln σ(s, 0) = ln σ_d, inside the ends of s; if it fails, halving."""
    low, high = actuator.lowest, actuator.highest
    s = 0.5 * (low + high)
    for _i in range(_NEWTON_STEPS):
        found = _derivatives_of_energy(actuator, s, 0.0)
        step = log(sigma / found.sigma) * found.sigma / found.sigma_mu
        s = least(greatest(s + step, low), high)
    lost = abs(_stiffness_of_energy(actuator, s, 0.0) - sigma) > _FOUND * sigma
    if some(lost):
        s = choose(lost, _halve_coordinates(actuator, sigma), s)
    return s


@compiled
def _loaded_svsa(actuator: Actuator, M: float, _: float) -> Actuator:
    a = actuator
    return Actuator(M, a.B1, a.B2, a.D, a.D1, a.D2, a.K, a.gamma, a.mu0, a.reaction)


@compiled
def _loaded_energy(actuator: ElasticActuator, M: float, _: float) -> ElasticActuator:
    a = actuator
    return ElasticActuator(
        M, a.B1, a.B2, a.D, a.D1, a.D2, a.kappa, a.mu0, a.lowest, a.highest, a.antagonistic,
        a.torques_address, a.margin_address, a.state_address, a.e0, a.e1, a.e2, a.e3, a.e4, a.e5,
    )  # fmt: skip


@compiled
def _scaled_svsa(actuator: Actuator, ratio: float, mask: tuple[float, ...]) -> Actuator:
    a = actuator
    K = a.K * ratio
    return Actuator(a.M, a.B1, a.B2, a.D, a.D1, a.D2, K, a.gamma, a.mu0, a.reaction)


@compiled
def _scaled_energy(
    actuator: ElasticActuator, ratio: float, mask: tuple[float, ...]
) -> ElasticActuator:
    a, m, r = actuator, mask, ratio - 1.0
    return ElasticActuator(
        a.M, a.B1, a.B2, a.D, a.D1, a.D2, a.kappa, a.mu0, a.lowest, a.highest, a.antagonistic,
        a.torques_address, a.margin_address, a.state_address,
        a.e0 * (1.0 + m[0] * r), a.e1 * (1.0 + m[1] * r), a.e2 * (1.0 + m[2] * r),
        a.e3 * (1.0 + m[3] * r), a.e4 * (1.0 + m[4] * r), a.e5 * (1.0 + m[5] * r),
    )  # fmt: skip


_loaded = choose_kind(_loaded_svsa, _loaded_energy)
_scaled = choose_kind(_scaled_svsa, _scaled_energy)
_torques = choose_kind(_torques_of_svsa, _torques_of_energy)
_torques_inside = choose_kind(_torques_of_svsa, _torques_inside_of_energy)
_stiffness = choose_kind(_stiffness_of_svsa, _stiffness_of_energy)
_derivatives = choose_kind(_derivatives_of_svsa, _derivatives_of_energy)
_state = choose_kind(_state_of_svsa, _state_of_energy)
_coordinate = choose_kind(_coordinate_of_svsa, _coordinate_of_energy)
_slope = choose_kind(_slope_of_svsa, _slope_of_energy)
_stiffness_slope = choose_kind(_stiffness_slope_of_svsa, _stiffness_slope_of_energy)
_inverse = choose_kind(_inverse_of_svsa, _inverse_of_energy)


@compiled
def replace_link_inertia(actuator: AnyActuator, M: float) -> AnyActuator:
    """The same actuator with another link inertia M, kg·m²."""
    return _loaded(actuator, M, 0.0)


@compiled
def scale_spring(actuator: AnyActuator, ratio: float, mask: tuple[float, ...]) -> AnyActuator:
    """The same actuator with `ratio` times the torque of its spring.

    Args:
        actuator: Constants of the actuator, or a packed one.
        ratio: Factor of the spring torque.
        mask: See `find_spring_scale`.
    """
    return _scaled(actuator, ratio, mask)


def find_spring_scale(actuator: AnyActuator) -> tuple[float, ...] | None:
    """Find the parameters of the energy whose common factor is a factor of the spring torque.

    Args:
        actuator: Constants of the actuator.

    Returns:
        1 for each of e0 to e5 that has the factor, otherwise 0; zeros for the SVSA, whose K has it;
        None if there is no such factor.
    """
    none = (0.0,) * MAX_ELASTIC
    if isinstance(actuator, Actuator):
        return none
    low, high = actuator.lowest, actuator.highest
    points = [(low + share * (high - low), phi) for share in (0.3, 0.7) for phi in (0.02, 0.1)]
    rest, elastic = actuator[:-MAX_ELASTIC], actuator[-MAX_ELASTIC:]
    used = [i for i, value in enumerate(elastic) if value != 0.0]
    for count in range(1, len(used) + 1):
        for chosen in itertools.combinations(used, count):
            mask = tuple(float(i in chosen) for i in range(MAX_ELASTIC))
            values = (value * (1.0 + one) for value, one in zip(elastic, mask, strict=True))
            doubled = ElasticActuator(*rest, *values)
            torques = [compute_torques(actuator, *point).torque for point in points]
            twice = [compute_torques(doubled, *point).torque for point in points]
            if all(
                math.isclose(two, 2.0 * one, rel_tol=1e-9)
                for one, two in zip(torques, twice, strict=True)
            ):
                return mask
    return None


@compiled
def compute_coordinate(actuator: AnyActuator, theta2: float) -> float:
    """s = s0 + κ θ2; for the SVSA the lever ratio μ (Eq 4).

    Args:
        actuator: Constants of the actuator.
        theta2: Angle of motor 2 at the gearbox output, rad.

    Returns:
        s.
    """
    return _coordinate(actuator, theta2, 0.0)


@compiled
def compute_coordinate_slope(actuator: AnyActuator) -> float:
    """κ = ds/dθ2, per rad; of the SVSA μ' = 1/(2πγ)."""
    return _slope(actuator, 0.0, 0.0)


@compiled
def compute_coordinate_for_stiffness(actuator: AnyActuator, sigma: float) -> float:
    """The s whose stiffness at φ = 0 is σ, limited to the range of s.

    Args:
        actuator: Constants of the actuator.
        sigma: σ, N·m/rad, > 0.

    Returns:
        s.
    """
    return _inverse(actuator, sigma, 0.0)


@compiled
def compute_torques(actuator: AnyActuator, s: float, phi: float) -> SpringTorques:
    """τ_e and τ_r = κ ∂U/∂s, `SpringTorques`, N·m, at s and φ (rad)."""
    return _torques(actuator, s, phi)


@compiled
def compute_torques_inside(actuator: AnyActuator, s: float, phi: float) -> SpringTorques:
    """`compute_torques` at a state whose domain is checked and whose stiffness is published.

    For an elastic energy one call computes all three.
    """
    return _torques_inside(actuator, s, phi)


@compiled
def compute_stiffness_of(actuator: AnyActuator, s: float, phi: float) -> float:
    """σ = ∂²U/∂φ² at s and φ (rad), N·m/rad."""
    return _stiffness(actuator, s, phi)


@compiled
def compute_derivatives(actuator: AnyActuator, s: float, phi: float) -> SpringDerivatives:
    """τ_e, σ and their derivatives at s and φ (rad), `SpringDerivatives` with s as μ."""
    return _derivatives(actuator, s, phi)


@compiled
def compute_spring_state(actuator: AnyActuator, s: float, phi: float) -> SpringState:
    """τ_e, τ_r and all derivatives at s and φ (rad), `SpringState`: of an energy, one call."""
    return _state(actuator, s, phi)


@compiled
def compute_stiffness_slope_of(actuator: AnyActuator, s: float) -> float:
    """g = ∂σ/∂θ2 at s and φ = 0, N·m/rad²."""
    return _stiffness_slope(actuator, s, 0.0)


@compiled
def compute_determinant_of_energy(actuator: ElasticActuator, s: float, phi: float) -> float:
    """(σ σ_s − τ_s σ_φ) at φ over its value at φ = 0, which det A(x) is a multiple of."""
    return find_margin(actuator.margin_address, s, phi, _list_values(actuator)).determinant
