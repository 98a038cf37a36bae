"""Integration of the plant: classical Runge–Kutta steps of order 4, mechanical stops."""

from typing import NamedTuple

from svsa.actuators.dynamics import (
    Actuator,
    ExternalLoad,
    accelerate,
    add_damping,
    build_rate,
    compute_deflection,
    compute_rate,
    shift,
)
from svsa.actuators.elasticity import compute_coordinate, compute_torques_inside
from svsa.actuators.signals import State, Torque
from svsa.numerics.compilation import compiled
from svsa.simulation.plant.effects import EffectConstants
from svsa.simulation.plant.effects.current_lag import compute_lagged_torque
from svsa.simulation.plant.load_table import LoadTable, compute_load
from svsa.simulation.plant.resistance import add_resistance


class Stops(NamedTuple):
    """Mechanical stops of the lever's travel and of the deflection.

    Attributes:
        theta2_min: Lower stop of motor 2, rad.
        theta2_max: Upper stop of motor 2, rad.
        deflection_max: Stop of |φ|, rad.
    """

    theta2_min: float
    theta2_max: float
    deflection_max: float


@compiled
def hit_stops(stops: Stops, x: State, inertia: float, inertia1: float) -> State:
    """Return the state after an inelastic impact, or x if it is between the stops.

    The stiffness motor is at rest at its stop. At the stop of the deflection, link and principal
    motor continue with the velocity of their common momentum.

    Args:
        stops: `Stops`.
        x: `State`.
        inertia: Inertia of the link with its load, kg·m².
        inertia1: Inertia of motor 1, kg·m².

    Returns:
        `State`.
    """
    q, dq, theta1, dtheta1 = x.q, x.dq, x.theta1, x.dtheta1
    theta2, dtheta2 = x.theta2, x.dtheta2
    # Branches: only the emulator has end stops, and it never runs in a batch.
    if theta2 < stops.theta2_min:
        theta2, dtheta2 = stops.theta2_min, max(dtheta2, 0.0)
    elif theta2 > stops.theta2_max:
        theta2, dtheta2 = stops.theta2_max, min(dtheta2, 0.0)
    phi = q - theta1
    excess = phi - min(max(phi, -stops.deflection_max), stops.deflection_max)
    if excess != 0.0:
        share = inertia1 / (inertia + inertia1)
        q -= share * excess
        theta1 += (1.0 - share) * excess
        if (dq - dtheta1) * excess > 0.0:
            dq = dtheta1 = (1.0 - share) * dq + share * dtheta1
    return State(q, dq, theta1, dtheta1, theta2, dtheta2)


@compiled
def compute_plant_load(
    effects: EffectConstants, table: LoadTable, x: State, tick: int, period: float, time: float
) -> ExternalLoad:
    """Compute the total load on the plant: loads, and effects such as friction.

    Args:
        effects: `EffectConstants`.
        table: `LoadTable`.
        x: `State`.
        tick: Tick at the beginning of the period.
        period: T, s.
        time: Session time, s.

    Returns:
        `ExternalLoad`.
    """
    return add_resistance(effects, x, compute_load(table, tick, period, time))


@compiled
def compute_plant_rate(
    actuator: Actuator, effects: EffectConstants, x: State, torque: Torque, load: ExternalLoad
) -> State:
    """ẋ of the plant with the motors' torque, the loads and all other forces (Eq 1)."""
    return compute_rate(actuator, x, torque, add_resistance(effects, x, load))


@compiled
def compute_first_rate(
    actuator: Actuator, effects: EffectConstants, x: State, torque: Torque, load: ExternalLoad
) -> State:
    """`compute_plant_rate` at the beginning of a tick, where the domain is checked, too."""
    s = compute_coordinate(actuator, x.theta2)
    F = add_damping(actuator, x, compute_torques_inside(actuator, s, compute_deflection(x)))
    return build_rate(x, accelerate(actuator, x, F, torque, add_resistance(effects, x, load)))


@compiled
def integrate_period(
    actuator: Actuator,
    effects: EffectConstants,
    x: State,
    start: Torque,
    delayed: Torque,
    table: LoadTable,
    tick: int,
    period: float,
    steps: int,
) -> State:
    """Integrate the plant over the control period that begins at `tick` (RK4).

    Args:
        actuator: `Actuator` of the true plant.
        effects: `EffectConstants`.
        x: `State` at the beginning.
        start: `Torque` of the motors at the beginning, N·m.
        delayed: `Torque` after the delay, N·m.
        table: `LoadTable`.
        tick: Number of the tick.
        period: T, s.
        steps: Runge–Kutta steps in the period, ≥ 1.

    Returns:
        `State` at the end of the period.
    """
    load = compute_load(table, tick, period, tick * period)
    torque = compute_lagged_torque(start, delayed, effects.current_lag, 0.0)
    rate = compute_plant_rate(actuator, effects, x, torque, load)
    return integrate_from(
        actuator, effects, x, rate, start, delayed, table, load, tick, period, steps
    )


@compiled
def integrate_from(
    actuator: Actuator,
    effects: EffectConstants,
    x: State,
    rate: State,
    start: Torque,
    delayed: Torque,
    table: LoadTable,
    load: ExternalLoad,
    tick: int,
    period: float,
    steps: int,
) -> State:
    """`integrate_period` where ẋ (`rate`) and the load at the beginning are known."""
    h = period / steps
    early = load
    for i in range(steps):
        since = i * h
        time = tick * period + since
        u0 = compute_lagged_torque(start, delayed, effects.current_lag, since)
        u1 = compute_lagged_torque(start, delayed, effects.current_lag, since + 0.5 * h)
        u2 = compute_lagged_torque(start, delayed, effects.current_lag, since + h)
        middle = follow_load(table, early, tick, period, time + 0.5 * h)
        late = follow_load(table, early, tick, period, time + h)
        # The caller has computed it for the sample at the beginning of the period.
        k1 = rate if i == 0 else compute_plant_rate(actuator, effects, x, u0, early)
        k2 = compute_plant_rate(actuator, effects, shift(x, k1, 0.5 * h), u1, middle)
        k3 = compute_plant_rate(actuator, effects, shift(x, k2, 0.5 * h), u1, middle)
        k4 = compute_plant_rate(actuator, effects, shift(x, k3, h), u2, late)
        x = shift(shift(shift(shift(x, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0)
        early = late
    return x


@compiled
def follow_load(
    table: LoadTable, before: ExternalLoad, tick: int, period: float, time: float
) -> ExternalLoad:
    """Compute the load at `time` (s) in the period of `tick`; `before` if none changes."""
    return compute_load(table, tick, period, time) if table.changing else before


@compiled
def coast(
    actuator: Actuator,
    effects: EffectConstants,
    stops: Stops,
    x: State,
    torque: Torque,
    delayed: Torque,
    table: LoadTable,
    tick: int,
    period: float,
    count: int,
) -> tuple[State, Torque]:
    """Advance x and torque by `count` periods with a constant delayed torque (RK4, one step each).

    Args:
        actuator: `Actuator` of the true plant.
        effects: `EffectConstants`.
        stops: `Stops`.
        x: `State`.
        torque: `Torque` of the motors at the beginning, N·m.
        delayed: Commanded `Torque`, N·m.
        table: `LoadTable`.
        tick: Number of the first tick.
        period: T, s.
        count: Number of periods.

    Returns:
        `State` and `Torque` at the end.
    """
    for i in range(tick, tick + count):
        x = integrate_period(actuator, effects, x, torque, delayed, table, i, period, 1)
        torque = compute_lagged_torque(torque, delayed, effects.current_lag, period)
        inertia = actuator.M + compute_load(table, i, period, i * period).inertia
        x = hit_stops(stops, x, inertia, actuator.B1)
    return x, torque
