"""The plant through one control period: one classical Runge–Kutta step, order 4."""

from svsa.compilation import compiled
from svsa.model.dynamics import compute_acceleration
from svsa.plant.disturbances import compute_load
from svsa.signals import State


@compiled
def shift(x, rate, step):
    """X + step · ẋ; x and rate: `State`, step: s."""
    return State(
        x.q + step * rate.q,
        x.dq + step * rate.dq,
        x.theta1 + step * rate.theta1,
        x.dtheta1 + step * rate.dtheta1,
        x.theta2 + step * rate.theta2,
        x.dtheta2 + step * rate.dtheta2,
    )


@compiled
def compute_rate(actuator, x, torque, load):
    """ẋ of Eq 1 as a `State`: velocities and accelerations."""
    acceleration = compute_acceleration(actuator, x, torque, load)
    return State(
        x.dq,
        acceleration.ddq,
        x.dtheta1,
        acceleration.ddtheta1,
        x.dtheta2,
        acceleration.ddtheta2,
    )


@compiled
def integrate_period(actuator, x, torque, table, tick, period, steps):
    """X at the end of the control period that begins at `tick`, torque held (RK4).

    actuator: `Actuator`, the true plant. x: `State`. torque: `Torque`, N·m. table:
    `LoadTable`. period: T, s. steps: Runge–Kutta steps in the period, ≥ 1.
    """
    h = period / steps
    for i in range(steps):
        start = tick * period + i * h
        load0 = compute_load(table, tick, period, start)
        load1 = compute_load(table, tick, period, start + 0.5 * h)
        load2 = compute_load(table, tick, period, start + h)
        k1 = compute_rate(actuator, x, torque, load0)
        k2 = compute_rate(actuator, shift(x, k1, 0.5 * h), torque, load1)
        k3 = compute_rate(actuator, shift(x, k2, 0.5 * h), torque, load1)
        k4 = compute_rate(actuator, shift(x, k3, h), torque, load2)
        x = shift(shift(shift(shift(x, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0)
    return x
