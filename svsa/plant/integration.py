"""The plant through one control period or many: classical Runge–Kutta steps, order 4."""

from svsa.compilation import compiled
from svsa.model.dynamics import ExternalLoad, compute_rate, shift
from svsa.plant.disturbances import compute_load
from svsa.plant.drive import compute_lagged_torque
from svsa.plant.friction import compute_friction
from svsa.plant.stops import hit_stops


@compiled
def compute_plant_load(bench, table, x, tick, period, time):
    """All that acts on the plant besides the motors: loads, weight of the link, friction.

    bench: `Bench`. table: `LoadTable`. x: `State`. Returns `ExternalLoad`.
    """
    load = compute_load(table, tick, period, time)
    w4, w6 = load.w4, load.w6
    if bench.static1 > 0.0:
        w4 -= compute_friction(
            x.dtheta1, bench.coulomb1, bench.static1, bench.stribeck, bench.creep1
        )
    if bench.static2 > 0.0:
        w6 -= compute_friction(
            x.dtheta2, bench.coulomb2, bench.static2, bench.stribeck, bench.creep2
        )
    return ExternalLoad(load.w2, w4, w6, load.inertia, load.gravity_moment + bench.gravity_moment)


@compiled
def integrate_period(actuator, bench, x, start, target, table, tick, period, steps):
    """X at the end of the control period that begins at `tick` (RK4).

    actuator: `Actuator`, the true plant. bench: `Bench`. x: `State`. start: `Torque` that
    the motors make at the beginning, target: `Torque` asked of them, N·m. table:
    `LoadTable`. period: T, s. steps: Runge–Kutta steps in the period, ≥ 1.
    """
    h = period / steps
    for i in range(steps):
        since = i * h
        time = tick * period + since
        u0 = compute_lagged_torque(start, target, bench.lag, since)
        u1 = compute_lagged_torque(start, target, bench.lag, since + 0.5 * h)
        u2 = compute_lagged_torque(start, target, bench.lag, since + h)
        k1 = compute_plant_rate(actuator, bench, x, u0, table, tick, period, time)
        x2 = shift(x, k1, 0.5 * h)
        k2 = compute_plant_rate(actuator, bench, x2, u1, table, tick, period, time + 0.5 * h)
        x3 = shift(x, k2, 0.5 * h)
        k3 = compute_plant_rate(actuator, bench, x3, u1, table, tick, period, time + 0.5 * h)
        x4 = shift(x, k3, h)
        k4 = compute_plant_rate(actuator, bench, x4, u2, table, tick, period, time + h)
        x = shift(shift(shift(shift(x, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0)
    return x


@compiled
def coast(actuator, bench, stops, x, torque, target, table, tick, period, count):
    """X and the motors' torque `count` periods after `tick`, the target held (RK4, one step each).

    actuator: `Actuator`, the true plant. bench: `Bench`. stops: `Stops`. x: `State`.
    torque: `Torque` that the motors make at the beginning, target: `Torque` asked of them,
    N·m. table: `LoadTable`. period: s. Returns (`State`, `Torque`).
    """
    for i in range(tick, tick + count):
        x = integrate_period(actuator, bench, x, torque, target, table, i, period, 1)
        torque = compute_lagged_torque(torque, target, bench.lag, period)
        inertia = actuator.M + compute_load(table, i, period, i * period).inertia
        x = hit_stops(stops, x, inertia, actuator.B1)
    return x, torque


@compiled
def compute_plant_rate(actuator, bench, x, torque, table, tick, period, time):
    """ẋ of the plant under the motors' torque and everything else that acts (Eq 1)."""
    load = compute_plant_load(bench, table, x, tick, period, time)
    return compute_rate(actuator, x, torque, load)
