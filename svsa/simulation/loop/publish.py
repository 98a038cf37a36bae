"""Writing of one tick's sample into its row."""

from collections.abc import Callable
from typing import Any, cast

import numpy as np
from numba.core import types
from numba.core.cgutils import get_item_pointer
from numba.extending import intrinsic
from numba.np.arrayobj import make_array

from svsa.actuators.domain import compute_deflection_limit
from svsa.actuators.dynamics import (
    Acceleration,
    InternalTorque,
    compute_deflection,
    compute_internal_torque,
    compute_unexplained_torque,
)
from svsa.actuators.elasticity import compute_coordinate, compute_stiffness_of
from svsa.actuators.signals import Positions, Reference, Sample, State, Torque
from svsa.control.call import Call, read_estimate
from svsa.control.observers.spring import NO_ESTIMATE, SpringEstimate, read_spring, update_spring
from svsa.numerics.compilation import compiled
from svsa.simulation.loop.lane import Action, Blocks, LaneState
from svsa.simulation.plant.sensors import read_positions


@intrinsic
def _write_sample(typing: Any, row: Any, sample: Any) -> Any:
    if not isinstance(row, types.Array) or not isinstance(
        sample, types.NamedUniTuple | types.NamedTuple
    ):
        return None

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        array = make_array(row)(context, builder, value=arguments[0])
        for column, kind in enumerate(sample):
            value = builder.extract_value(arguments[1], column)
            place = context.get_constant(types.intp, column)
            pointer = get_item_pointer(context, builder, row, array, [place])
            builder.store(context.cast(builder, value, kind, row.dtype), pointer)
        return context.get_dummy_value()

    return types.void(row, sample), generate


write_sample = cast("Callable[[np.ndarray, Sample], None]", _write_sample)
"""Write a `Sample` into its row, (channels,), in compiled functions only. A loop over its fields
would first store them in memory one by one, which costs 5 % of a run.
"""


@compiled
def compute_nominal_torque(blocks: Blocks, lane: LaneState, F: InternalTorque) -> InternalTorque:
    """F_n(x), `InternalTorque`, N·m, of the true state; `F` is that of x̂, which is often the same
    state.
    """
    x, y = lane.x, lane.known
    if (x.q, x.dq, x.theta1, x.dtheta1, x.theta2, x.dtheta2) == (
        y.q, y.dq, y.theta1, y.dtheta1, y.theta2, y.dtheta2,
    ):  # fmt: skip
        return F
    return compute_internal_torque(blocks.nominal, x)


@compiled
def estimate_spring(
    blocks: Blocks, spring: np.ndarray, known: State, measured: Positions, applied: Torque
) -> tuple[float, SpringEstimate]:
    """Update the spring estimator by the period that has ended.

    Args:
        blocks: `Blocks`, whose estimator is on.
        spring: Packed `Spring`, written.
        known: x̂ at its end, `State`.
        measured: Measured `Positions` there, rad.
        applied: Mean `Torque` during it, N·m.

    Returns:
        Nominal stiffness at x̂, N·m/rad, and `SpringEstimate`.
    """
    nominal, constants, state = blocks.nominal, blocks.spring, spring[0]
    update_spring(constants, state, nominal, measured, known.dtheta1, applied.u1, blocks.period)
    s = compute_coordinate(nominal, known.theta2)
    sigma = compute_stiffness_of(nominal, s, compute_deflection(known))
    return sigma, read_spring(constants, state)


@compiled
def publish(
    runs: bool,
    blocks: Blocks,
    reference: Reference,
    lane: LaneState,
    F: InternalTorque,
    call: Call,
    action: Action,
    tick: int,
    row: np.ndarray,
) -> np.ndarray:
    """Write one `Sample` into its row, (channels,), and return it.

    `runs` is whether the lane is running, here always; `F` is F_n(x̂); `call` is that of the law,
    after its call; `action` has the effects of its torque.
    """
    torque, rate = action.actual, action.rate
    # Read after the law was called: a law with an observer of its own updates it in the call.
    estimate = read_estimate(call, lane.estimate)
    x, known = lane.x, lane.known
    phi = compute_deflection(x)
    mu = compute_coordinate(blocks.plant, x.theta2)
    sigma = compute_stiffness_of(blocks.plant, mu, phi)
    nominal_sigma, spring = 0.0, NO_ESTIMATE
    if blocks.spring.every > 0.0:
        measured = read_positions(blocks.effects, x, tick)
        nominal_sigma, spring = estimate_spring(blocks, lane.spring, known, measured, lane.applied)
    acceleration = Acceleration(rate.dq, rate.dtheta1, rate.dtheta2)
    F = compute_nominal_torque(blocks, lane, F)
    w = compute_unexplained_torque(blocks.nominal, F, torque, acceleration)
    values = Sample(
        time_s=tick * blocks.period,
        position_reference_rad=reference.q,
        velocity_reference_rad_per_s=reference.dq,
        stiffness_reference_nm_per_rad=reference.sigma,
        position_rad=x.q,
        velocity_rad_per_s=x.dq,
        position_estimate_rad=known.q,
        velocity_estimate_rad_per_s=known.dq,
        motor1_position_rad=x.theta1,
        motor1_velocity_rad_per_s=x.dtheta1,
        motor2_position_rad=x.theta2,
        motor2_velocity_rad_per_s=x.dtheta2,
        deflection_rad=phi,
        deflection_limit_rad=compute_deflection_limit(blocks.domain, blocks.plant, mu),
        lever_ratio=mu,
        stiffness_nm_per_rad=sigma,
        position_error_rad=reference.q - x.q,
        stiffness_error_nm_per_rad=reference.sigma - sigma,
        torque1_nm=torque.u1,
        torque2_nm=torque.u2,
        disturbance_link_nm=w.w2,
        disturbance_motor1_nm=w.w4,
        disturbance_motor2_nm=w.w6,
        estimate_link_nm=estimate.w2,
        estimate_motor1_nm=estimate.w4,
        estimate_motor2_nm=estimate.w6,
        position_residual_rad=0.0,
        stiffness_residual_nm_per_rad=0.0,
        payload_estimate_kg=0.0,
        stiffness_estimate_nm_per_rad=spring.ratio * nominal_sigma,
        stiffness_deviation_nm_per_rad=spring.deviation * nominal_sigma,
        spring_ratio=spring.ratio,
        spring_ratio_deviation=spring.deviation,
        spring_misfit=spring.misfit,
    )
    write_sample(row, values)
    return row
