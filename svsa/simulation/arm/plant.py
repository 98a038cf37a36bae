"""The coupled plant of an arm: Eq 1 of both joints with M(q), C and g in place of M q̈.

    M(q) q̈ + C(q, q̇) + g(q) = −D q̇ − τ_e + τ_ext + Jᵀ f

The motors are those of single joints. Integration: classical Runge–Kutta steps of order 4.
"""

import numpy as np

from svsa.actuators.arm.dynamics import (
    Arm,
    Joints,
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
from svsa.simulation.arm.lane import ArmBlocks, ArmInputs, States
from svsa.simulation.arm.tip_loads import TipAction, compute_wall_force
from svsa.simulation.loop.lane import Blocks
from svsa.simulation.plant.effects.current_lag import compute_lagged_torque
from svsa.simulation.plant.integration import follow_load
from svsa.simulation.plant.resistance import add_resistance

_Loads = tuple[ExternalLoad, ExternalLoad]
_Torques = tuple[Torque, Torque]


@compiled
def compute_link_torque(F: InternalTorque, load: ExternalLoad) -> float:
    """−D q̇ − τ_e + τ_ext of one joint, N·m."""
    return F.link + load.w2


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
    """ẋ of both joints. arm: with the mass at its tip. u, loads: pairs. force: at the tip, N.

    table: of the loads at the tip, whose walls act on the tip at x.
    """
    x1, x2 = x
    joint1, joint2 = blocks.joint1, blocks.joint2
    load1 = add_resistance(joint1.effects, x1, loads[0])
    load2 = add_resistance(joint2.effects, x2, loads[1])
    F1 = compute_internal_torque(joint1.plant, x1)
    F2 = compute_internal_torque(joint2.plant, x2)
    angles, dq = turn(Joints(x1.q, x2.q)), Joints(x1.dq, x2.dq)
    if table.shape[0] > 0:
        tip = compute_tip_position(arm, angles)
        wall = compute_wall_force(table, tick, tip, compute_tip_velocity(arm, angles, dq))
        force = Point(force.x + wall.x, force.y + wall.y)
    by_tip = compute_tip_torque(arm, angles, force)
    torque = Joints(
        compute_link_torque(F1, load1) + by_tip.joint1,
        compute_link_torque(F2, load2) + by_tip.joint2,
    )
    ddq = compute_arm_acceleration(arm, angles, dq, torque)
    return (
        compute_joint_rate(joint1, x1, F1, u[0], load1, ddq.joint1),
        compute_joint_rate(joint2, x2, F2, u[1], load2, ddq.joint2),
    )


@compiled
def shift_both(x: States, rate: States, step: float) -> States:
    """x + step · ẋ of both joints. step: s."""
    return shift(x[0], rate[0], step), shift(x[1], rate[1], step)


@compiled
def lag_both(blocks: ArmBlocks, start: _Torques, delayed: _Torques, since: float) -> _Torques:
    """What the motors make `since` seconds after the beginning of the tick, N·m."""
    lag1, lag2 = blocks.joint1.effects.current_lag, blocks.joint2.effects.current_lag
    return (
        compute_lagged_torque(start[0], delayed[0], lag1, since),
        compute_lagged_torque(start[1], delayed[1], lag2, since),
    )


@compiled
def follow_both(inputs: ArmInputs, before: _Loads, tick: int, period: float, time: float) -> _Loads:
    """The loads on both joints at `time` (s) in the period of `tick`."""
    return (
        follow_load(inputs.joint1.loads, before[0], tick, period, time),
        follow_load(inputs.joint2.loads, before[1], tick, period, time),
    )


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
    period, steps, table = blocks.joint1.period, blocks.joint1.steps, inputs.tip
    arm, force = add_tip_mass(blocks.arm, tip.mass), tip.force
    h, early = period / steps, loads
    for i in range(steps):
        since = i * h
        time = tick * period + since
        u0 = lag_both(blocks, start, delayed, since)
        u1 = lag_both(blocks, start, delayed, since + 0.5 * h)
        u2 = lag_both(blocks, start, delayed, since + h)
        middle = follow_both(inputs, early, tick, period, time + 0.5 * h)
        late = follow_both(inputs, early, tick, period, time + h)
        k1 = rate
        if i > 0:
            k1 = compute_arm_rate(blocks, arm, table, tick, x, u0, early, force)
        half = shift_both(x, k1, 0.5 * h)
        k2 = compute_arm_rate(blocks, arm, table, tick, half, u1, middle, force)
        half = shift_both(x, k2, 0.5 * h)
        k3 = compute_arm_rate(blocks, arm, table, tick, half, u1, middle, force)
        end = shift_both(x, k3, h)
        k4 = compute_arm_rate(blocks, arm, table, tick, end, u2, late, force)
        x = shift_both(x, k1, h / 6.0)
        x = shift_both(x, k2, h / 3.0)
        x = shift_both(x, k3, h / 3.0)
        x = shift_both(x, k4, h / 6.0)
        early = late
    return x
