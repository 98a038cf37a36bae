"""The dynamics: Eq 1 as torques on three inertias, and the disturbance of Eq 6–9.

J q̈ = F(x) + u + w on link, principal motor and stiffness motor, with the inertias
J = (M, B1, B2) and the internal torques F. The true plant and the nominal model are the
same functions with other constants.
"""

from typing import Any, NamedTuple

from svsa.actuators.elasticity import (
    Actuator,
    AnyActuator,
    ElasticActuator,
    compute_coordinate,
    compute_torques,
)
from svsa.actuators.energy import compile_energy
from svsa.actuators.installed import get_mechanism
from svsa.actuators.mechanism import MAX_ELASTIC
from svsa.actuators.parameters import ActuatorParameters, MechanismParameters, get_mechanism_name
from svsa.actuators.signals import Disturbance, State, Torque
from svsa.actuators.spring import REACTION_ENERGY, REACTION_PRINTED, SpringTorques
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, some
from svsa.numerics.trigonometry import sin


def build_actuator(parameters: MechanismParameters, s0: float) -> Any:
    """Build the constants of an actuator from validated parameters.

    Args:
        parameters: Parameters of the plant or of the nominal model.
        s0: Stiffness coordinate at θ2 = 0; for the SVSA the lever ratio μ0.

    Returns:
        `Actuator` for the SVSA, otherwise `ElasticActuator`.
    """
    p = parameters
    inertias = p.link_inertia_kg_m2, p.motor1_inertia_kg_m2, p.motor2_inertia_kg_m2
    dampings = (
        p.link_damping_nms_per_rad,
        p.motor1_damping_nms_per_rad,
        p.motor2_damping_nms_per_rad,
    )
    if isinstance(p, ActuatorParameters):
        return Actuator(
            *inertias,
            *dampings,
            K=p.rotational_stiffness_nm_per_rad,
            gamma=p.spiral_reduction,
            mu0=float(s0),
            reaction=REACTION_PRINTED if p.reaction_torque == "printed" else REACTION_ENERGY,
        )
    mechanism = get_mechanism(get_mechanism_name(p))
    addresses = compile_energy(mechanism).addresses
    return ElasticActuator(
        *inertias,
        *dampings,
        mechanism.compute_slope(p),
        float(s0),
        *mechanism.coordinate,
        float(mechanism.antagonistic),
        addresses["compute_torques"],
        addresses["compute_margin"],
        addresses["compute_state"],
        *[*mechanism.list_elastic(p), *[0.0] * MAX_ELASTIC][:MAX_ELASTIC],
    )


class ExternalLoad(NamedTuple):
    """The external load on the plant at one instant.

    Attributes:
        w2: Torque on the link, N·m.
        w4: Torque on motor 1, N·m.
        w6: Torque on motor 2, N·m.
        inertia: Inertia that is added to M, kg·m².
        gravity_moment: m g r of a hanging mass, N·m; its torque is −m g r sin q.
    """

    w2: float
    w4: float
    w6: float
    inertia: float
    gravity_moment: float


class Acceleration(NamedTuple):
    """q̈, θ̈1, θ̈2, rad/s²."""

    ddq: float
    ddtheta1: float
    ddtheta2: float


class InternalTorque(NamedTuple):
    """F(x) of Eq 1 on link, motor 1 and motor 2, N·m: damping, spring and reaction."""

    link: float
    motor1: float
    motor2: float


@compiled
def compute_deflection(x: State) -> float:
    """φ = q − θ1, rad (Eq 1)."""
    return x.q - x.theta1


@compiled
def compute_internal_torque(actuator: AnyActuator, x: State) -> InternalTorque:
    """F = (−D q̇ − τ_e, −D1 θ̇1 + τ_e, −D2 θ̇2 − τ_r), N·m: Eq 1 without u and w.

    Args:
        actuator: `Actuator`.
        x: `State`.

    Returns:
        `InternalTorque`, N·m.
    """
    phi = compute_deflection(x)
    spring = compute_torques(actuator, compute_coordinate(actuator, x.theta2), phi)
    return add_damping(actuator, x, spring)


@compiled
def add_damping(actuator: AnyActuator, x: State, spring: SpringTorques) -> InternalTorque:
    """`compute_internal_torque` where those of the spring at x, `SpringTorques`, are known."""
    return InternalTorque(
        -actuator.D * x.dq - spring.torque,
        -actuator.D1 * x.dtheta1 + spring.torque,
        -actuator.D2 * x.dtheta2 - spring.reaction,
    )


@compiled
def compute_acceleration(
    actuator: AnyActuator, x: State, u: Torque, load: ExternalLoad
) -> Acceleration:
    """q̈, θ̈1, θ̈2 of Eq 1 under the torques u and the external load.

    Args:
        actuator: `Actuator`.
        x: `State`.
        u: `Torque`, N·m.
        load: `ExternalLoad`.

    Returns:
        Accelerations, rad/s².
    """
    return accelerate(actuator, x, compute_internal_torque(actuator, x), u, load)


@compiled
def accelerate(
    actuator: AnyActuator, x: State, F: InternalTorque, u: Torque, load: ExternalLoad
) -> Acceleration:
    """`compute_acceleration` where F = F(x), `InternalTorque`, N·m, is known."""
    gravity = 0.0
    weighs = load.gravity_moment != 0.0
    if some(weighs):
        gravity = choose(weighs, load.gravity_moment * sin(x.q), gravity)
    return Acceleration(
        (F.link - gravity + load.w2) * (1.0 / (actuator.M + load.inertia)),
        (F.motor1 + u.u1 + load.w4) * (1.0 / actuator.B1),
        (F.motor2 + u.u2 + load.w6) * (1.0 / actuator.B2),
    )


@compiled
def compute_rate(actuator: AnyActuator, x: State, u: Torque, load: ExternalLoad) -> State:
    """ẋ = f(x) + g(x)u + p(x)w of Eq 9, as a `State` of velocities and accelerations."""
    return build_rate(x, compute_acceleration(actuator, x, u, load))


@compiled
def build_rate(x: State, acceleration: Acceleration) -> State:
    """ẋ, as a `State` of the velocities of x and of accelerations, rad/s²."""
    return State(
        x.dq,
        acceleration.ddq,
        x.dtheta1,
        acceleration.ddtheta1,
        x.dtheta2,
        acceleration.ddtheta2,
    )


@compiled
def shift(x: State, rate: State, step: float) -> State:
    """x + step · ẋ; x and rate: `State`, step: s."""
    return State(
        x.q + step * rate.q,
        x.dq + step * rate.dq,
        x.theta1 + step * rate.theta1,
        x.dtheta1 + step * rate.dtheta1,
        x.theta2 + step * rate.theta2,
        x.dtheta2 + step * rate.dtheta2,
    )


@compiled
def compute_disturbance(
    nominal: AnyActuator, x: State, u: Torque, acceleration: Acceleration
) -> Disturbance:
    """w = J_n q̈ − F_n(x) − u: the torque that the nominal model does not explain (Eq 6–9).

    Args:
        nominal: `Actuator` of the nominal model.
        x: `State`.
        u: `Torque`, N·m.
        acceleration: True accelerations of the three bodies, rad/s².

    Returns:
        `Disturbance`, N·m, positive in the direction of growing angles.
    """
    return compute_unexplained_torque(nominal, compute_internal_torque(nominal, x), u, acceleration)


@compiled
def compute_unexplained_torque(
    nominal: AnyActuator, F: InternalTorque, u: Torque, acceleration: Acceleration
) -> Disturbance:
    """`compute_disturbance` where F = F_n(x), `InternalTorque`, N·m, is known."""
    return Disturbance(
        nominal.M * acceleration.ddq - F.link,
        nominal.B1 * acceleration.ddtheta1 - F.motor1 - u.u1,
        nominal.B2 * acceleration.ddtheta2 - F.motor2 - u.u2,
    )
