"""The coupled plant of an arm: Eq 1 of both joints with M(q), C and g in place of M q̈.

    M(q) q̈ + C(q, q̇) + g(q) = −D q̇ − τ_e + τ_ext + Jᵀ f

The motors are those of single joints. Integration: classical Runge–Kutta steps of order 4.
"""

import numpy as np

from svsa.actuators.arm.dynamics import (
    Arm,
    Point,
    add_tip_mass,
    compute_arm_acceleration,
    compute_tip_position,
    compute_tip_torque,
    compute_tip_velocity,
    turn,
)
from svsa.actuators.dynamics import (
    Acceleration,
    ExternalLoad,
    InternalTorque,
    accelerate,
    build_rate,
    compute_internal_torque,
    shift,
)
from svsa.actuators.signals import State, Torque
from svsa.numerics.compilation import compiled
from svsa.numerics.fields import each, take
from svsa.simulation.arm.lane import ArmBlocks, ArmInputs, States
from svsa.simulation.arm.tip_loads import TipAction, compute_wall_force
from svsa.simulation.loop.lane import Blocks
from svsa.simulation.plant.effects.current_lag import compute_lagged_torque
from svsa.simulation.plant.integration import follow_load
from svsa.simulation.plant.resistance import add_resistance

_Loads = tuple[ExternalLoad, ...]
_Torques = tuple[Torque, ...]


@compiled
def compute_joint_torque(F: InternalTorque, load: ExternalLoad, by_tip: float) -> float:
    """−D q̇ − τ_e + τ_ext of one joint and the part of a force at the tip, N·m."""
    return F.link + load.w2 + by_tip


@compiled
def compute_joint_rate(
    blocks: Blocks, x: State, F: InternalTorque, u: Torque, load: ExternalLoad, ddq: float
) -> State:
    """ẋ of one joint, `State`, where the acceleration of its link, rad/s², is known."""
    motors = accelerate(blocks.plant, x, F, u, load)
    return build_rate(x, Acceleration(ddq, motors.ddtheta1, motors.ddtheta2))


@compiled
def compute_arm_rate(
    blocks: ArmBlocks,
    arm: Arm,
    table: np.ndarray,
    tick: int,
    x: States,
    u: _Torques,
    loads: _Loads,
    force: Point,
) -> States:
    """ẋ of all joints. arm: with the mass at its tip. force: at the tip, N.

    table: of the loads at the tip, whose walls act on the tip at x.
    """
    resisted = each(add_resistance, (take(blocks.joints, "effects"), x, loads))
    F = each(compute_internal_torque, (take(blocks.joints, "plant"), x))
    angles, dq = turn(take(x, "q")), take(x, "dq")
    if table.shape[0] > 0:
        tip = compute_tip_position(arm, angles)
        wall = compute_wall_force(table, tick, tip, compute_tip_velocity(arm, angles, dq))
        force = Point(force.x + wall.x, force.y + wall.y)
    by_tip = compute_tip_torque(arm, angles, force)
    torque = each(compute_joint_torque, (F, resisted, by_tip))
    ddq = compute_arm_acceleration(arm, angles, dq, torque)
    return each(compute_joint_rate, (blocks.joints, x, F, u, resisted, ddq))


@compiled
def integrate_arm(
    blocks: ArmBlocks,
    inputs: ArmInputs,
    x: States,
    rate: States,
    start: _Torques,
    delayed: _Torques,
    loads: _Loads,
    tip: TipAction,
    tick: int,
) -> States:
    """The states at the end of the control period that begins at `tick` (RK4).

    rate: ẋ at its beginning. start: the motors' torques then, delayed: after the delay, N·m. loads:
    on the joints then. tip: masses and forces at the tip.
    """
    period, steps, table = blocks.joints[0].period, blocks.joints[0].steps, inputs.tip
    lags, tables = take(take(blocks.joints, "effects"), "current_lag"), take(inputs.joints, "loads")
    arm, force = add_tip_mass(blocks.arm, tip.mass), tip.force
    h, early = period / steps, loads
    for i in range(steps):
        since = i * h
        time = tick * period + since
        u0 = each(compute_lagged_torque, (start, delayed, lags, since))
        u1 = each(compute_lagged_torque, (start, delayed, lags, since + 0.5 * h))
        u2 = each(compute_lagged_torque, (start, delayed, lags, since + h))
        middle = each(follow_load, (tables, early, tick, period, time + 0.5 * h))
        late = each(follow_load, (tables, early, tick, period, time + h))
        k1 = rate
        if i > 0:
            k1 = compute_arm_rate(blocks, arm, table, tick, x, u0, early, force)
        half = each(shift, (x, k1, 0.5 * h))
        k2 = compute_arm_rate(blocks, arm, table, tick, half, u1, middle, force)
        half = each(shift, (x, k2, 0.5 * h))
        k3 = compute_arm_rate(blocks, arm, table, tick, half, u1, middle, force)
        end = each(shift, (x, k3, h))
        k4 = compute_arm_rate(blocks, arm, table, tick, end, u2, late, force)
        x = each(shift, (x, k1, h / 6.0))
        x = each(shift, (x, k2, h / 3.0))
        x = each(shift, (x, k3, h / 3.0))
        x = each(shift, (x, k4, h / 6.0))
        early = late
    return x
