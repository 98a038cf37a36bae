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

    theta2_min, theta2_max, deflection_max: rad.
    """

    theta2_min: float
    theta2_max: float
    deflection_max: float


@compiled
def hit_stops(stops: Stops, x: State, inertia: float, inertia1: float) -> State:
    """Return the state after an inelastic impact, or x if it is between the stops.

    The stiffness motor stands still at its stop. At the stop of the deflection link and
    principal motor go on with the velocity of their common momentum. stops: `Stops`. x:
    `State`. inertia: of the link with what hangs on it, inertia1: of motor 1, kg·m².
    """
    q, dq, theta1, dtheta1 = x.q, x.dq, x.theta1, x.dtheta1
    theta2, dtheta2 = x.theta2, x.dtheta2
    # Plain branches: only the emulator has stops, and it is never part of a batch.
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
    """Compute the total load on the plant: loads and effects such as friction.

    effects: `EffectConstants`. table: `LoadTable`. x: `State`. Returns `ExternalLoad`.
    """
    return add_resistance(effects, x, compute_load(table, tick, period, time))


@compiled
def compute_plant_rate(
    actuator: Actuator, effects: EffectConstants, x: State, torque: Torque, load: ExternalLoad
) -> State:
    """ẋ of the plant under the motors' torque, the loads and everything else that acts (Eq 1)."""
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
    """The state at the end of the control period that begins at `tick` (RK4).

    actuator: `Actuator`, the true plant. effects: `EffectConstants`. x: `State`. start: `Torque`
    that the motors make at the beginning, delayed: `Torque` after the delay, N·m. table:
    `LoadTable`. period: T, s. steps: Runge–Kutta steps in the period, ≥ 1.
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
        # The caller has computed it at the beginning of the period, for the sample.
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
    """Advance x and torque `count` periods, with the delayed torque held (RK4, one step each).

    actuator: `Actuator`, the true plant. effects: `EffectConstants`. stops: `Stops`. x: `State`.
    torque: `Torque` that the motors make at the beginning, delayed: `Torque` asked of them,
    N·m. table: `LoadTable`. period: s. Returns (`State`, `Torque`).
    """
    for i in range(tick, tick + count):
        x = integrate_period(actuator, effects, x, torque, delayed, table, i, period, 1)
        torque = compute_lagged_torque(torque, delayed, effects.current_lag, period)
        inertia = actuator.M + compute_load(table, i, period, i * period).inertia
        x = hit_stops(stops, x, inertia, actuator.B1)
    return x, torque
