"""Torque limits of the motors."""

from svsa.actuators.elasticity import Actuator, AnyActuator, ElasticActuator
from svsa.actuators.kinds import choose_kind
from svsa.actuators.signals import Torque
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, greatest, least, some


@compiled
def limit_torque(torque: Torque, torque1_max: float, torque2_max: float) -> Torque:
    """Clip both torques to ± their limits, N·m; NaN remains NaN."""
    return Torque(
        least(greatest(torque.u1, -torque1_max), torque1_max),
        least(greatest(torque.u2, -torque2_max), torque2_max),
    )


@compiled
def split_torque(u: Torque) -> Torque:
    """Return torques (ua, ub) of antagonistic motors, N·m: u1 = ua + ub, u2 = ua − ub."""
    return Torque(0.5 * (u.u1 + u.u2), 0.5 * (u.u1 - u.u2))


@compiled
def _limit_of_svsa(plant: Actuator, torque: Torque, most: Torque) -> Torque:
    return limit_torque(torque, most.u1, most.u2)


@compiled
def _limit_of_energy(plant: ElasticActuator, torque: Torque, most: Torque) -> Torque:
    limited = limit_torque(torque, most.u1, most.u2)
    are_pair = plant.antagonistic > 0.0
    if some(are_pair):
        pair = limit_torque(split_torque(torque), most.u1, most.u2)
        limited = choose(are_pair, Torque(pair.u1 + pair.u2, pair.u1 - pair.u2), limited)
    return limited


_limit = choose_kind(_limit_of_svsa, _limit_of_energy)


@compiled
def limit_motors(plant: AnyActuator, torque: Torque, most: Torque) -> Torque:
    """Limit the torques of the real motors: for antagonistic ones ua and ub, not their sum.

    Args:
        plant: Constants of the plant.
        torque: u1 and u2, N·m.
        most: Limits of motor 1 (a) and motor 2 (b), N·m.

    Returns:
        Limited u1 and u2, N·m.
    """
    return _limit(plant, torque, most)


@compiled
def _at_limit_of_svsa(plant: Actuator, torque: Torque, most: Torque) -> bool:
    return (abs(torque.u1) >= most.u1) | (abs(torque.u2) >= most.u2)


@compiled
def _at_limit_of_energy(plant: ElasticActuator, torque: Torque, most: Torque) -> bool:
    pair = split_torque(torque)
    u1 = choose(plant.antagonistic > 0.0, pair.u1, torque.u1)
    u2 = choose(plant.antagonistic > 0.0, pair.u2, torque.u2)
    return (abs(u1) >= most.u1) | (abs(u2) >= most.u2)


_at_limit = choose_kind(_at_limit_of_svsa, _at_limit_of_energy)


@compiled
def are_at_limit(plant: AnyActuator, torque: Torque, most: Torque) -> bool:
    """Return whether a real motor is at or above its torque limit.

    Args:
        plant: Constants of the plant.
        torque: u1 and u2, N·m.
        most: Limits of motor 1 (a) and motor 2 (b), N·m.
    """
    return _at_limit(plant, torque, most)
