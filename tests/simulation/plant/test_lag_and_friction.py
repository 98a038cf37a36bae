"""From the commanded torque to the motion: limits, delay, lag and friction."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import svsa
from svsa.actuators.signals import CHANNEL_INDEX, State, Torque
from svsa.control.call import build_call
from svsa.runs.execution.blocks import bind_law, build_blocks
from svsa.runs.execution.run import Run
from svsa.simulation.loop.lane import AT_REST, NO_TORQUE, UNDISTURBED, UNMOVED, Inputs
from svsa.simulation.loop.loop import decide
from svsa.simulation.loop.loop import delay as delay_torque
from svsa.simulation.plant.effects import build_effect_constants
from svsa.simulation.plant.effects.current_lag import (
    CurrentLag,
    compute_lagged_torque,
    compute_late_torque,
    compute_mean_torque,
)
from svsa.simulation.plant.effects.delay_samples import MAX_DELAY_SAMPLES
from svsa.simulation.plant.effects.friction import Friction, compute_friction
from svsa.simulation.plant.integration import integrate_period
from svsa.simulation.reference.transition import build_stack
from tests.actuators.prototype import DESIGN, IDEAL_BENCH, NO_LOADS, PLANT, drawn, record

T = 0.001
START, TARGET = Torque(-1.0, 0.5), Torque(3.0, -0.2)
COULOMB, STATIC, STRIBECK, CREEP = 0.2, 0.26, 0.1, 0.01
FREE = PLANT._replace(mu0=0.0, D=0.0, D1=0.0, D2=0.0, K=1e-30)

speeds = st.floats(-20.0, 20.0)


def build_friction_bench(period=T, **changes):
    return build_effect_constants(
        svsa.Effects(friction=Friction(**changes)), 0, DESIGN.actuator, period
    )


@pytest.mark.parametrize("lag", [1e-5, 5e-4, 0.05])
def test_lagged_torque_solves_its_differential_equation(lag):
    """τ u̇ = u* − u: initial value, 63.2 % of the step after τ, and the slope at each time."""
    assert compute_lagged_torque(START, TARGET, lag, 0.0) == pytest.approx(START)
    after = compute_lagged_torque(START, TARGET, lag, lag)
    assert after.u1 == pytest.approx(3.0 - 4.0 / math.e, rel=1e-14)
    assert after.u2 == pytest.approx(-0.2 + 0.7 / math.e, rel=1e-14)
    step = 1e-4 * lag
    for since in (0.3 * lag, 2.0 * lag):
        near, at, far = (
            compute_lagged_torque(START, TARGET, lag, since + k * step) for k in (-1, 0, 1)
        )
        assert lag * (far.u1 - near.u1) / (2 * step) == pytest.approx(3.0 - at.u1, rel=1e-6)
        assert lag * (far.u2 - near.u2) / (2 * step) == pytest.approx(-0.2 - at.u2, rel=1e-6)


@pytest.mark.parametrize("lag", [1e-5, 5e-4, 0.05])
def test_mean_torque_is_the_integral_over_the_period(lag):
    """The observer receives the actual impulse of the motor, divided by T."""
    from scipy.integrate import quad

    found = compute_mean_torque(START, TARGET, lag, T)
    for index in (0, 1):
        whole, _ = quad(
            lambda t, i=index: compute_lagged_torque(START, TARGET, lag, t)[i],
            0.0,
            T,
            points=[min(5.0 * lag, 0.5 * T)],
            epsabs=1e-14,
        )
        assert found[index] == pytest.approx(whole / T, rel=1e-9)


def test_zero_lag_is_no_lag():
    """At τ = 0 the commanded torque immediately, bit for bit; for τ → 0 it tends to it."""
    for since in (0.0, T):
        assert compute_lagged_torque(START, TARGET, 0.0, since) == TARGET
    assert compute_mean_torque(START, TARGET, 0.0, T) == TARGET
    gaps = [
        abs(compute_mean_torque(START, TARGET, lag, T).u1 - TARGET.u1) for lag in (1e-4, 1e-5, 1e-6)
    ]
    np.testing.assert_allclose(gaps, [4.0 * 1e-1, 4.0 * 1e-2, 4.0 * 1e-3], rtol=1e-3)


def test_plant_integrates_the_lag_inside_the_period():
    """A free motor gains (T/B) times the mean torque, not the commanded torque, by RK4."""
    effects = svsa.Effects(current_lag=CurrentLag(time_constant_s=5e-4))
    bench = build_effect_constants(effects, 0, DESIGN.actuator, T)
    mean = compute_mean_torque(START, TARGET, bench.current_lag, T)
    end = integrate_period(FREE, bench, AT_REST, START, TARGET, NO_LOADS, 0, T, 16)
    assert end.dtheta1 == pytest.approx(T * mean.u1 / FREE.B1, rel=1e-6)
    assert end.dtheta2 == pytest.approx(T * mean.u2 / FREE.B2, rel=1e-6)


@drawn
@given(speeds)
def test_friction_is_odd_and_dissipative(speed):
    friction = compute_friction(speed, COULOMB, STATIC, STRIBECK, CREEP)
    assert friction == -compute_friction(-speed, COULOMB, STATIC, STRIBECK, CREEP)
    assert friction * speed >= 0.0
    assert abs(friction) <= STATIC


def test_friction_has_a_breakaway_peak_and_is_coulomb_at_speed():
    """It rises to nearly τ_s, then decreases to τ_c; with τ_s = τ_c there is no peak."""
    speed = np.linspace(0.0, 1.0, 5001)
    friction = np.array([compute_friction(v, COULOMB, STATIC, STRIBECK, CREEP) for v in speed])
    top = int(friction.argmax())
    assert CREEP < speed[top] < STRIBECK
    assert 0.95 * STATIC < friction[top] < STATIC
    assert np.all(np.diff(friction[: top + 1]) > 0.0)
    assert np.all(np.diff(friction[top:]) <= 0.0)
    assert friction[-1] == pytest.approx(COULOMB, rel=1e-12)
    flat = [compute_friction(v, COULOMB, COULOMB, STRIBECK, CREEP) for v in speed]
    assert np.all(np.diff(flat) >= 0.0)


@pytest.mark.parametrize("period", [1e-4, 1e-3, 0.02])
@pytest.mark.parametrize("coulomb", [0.02, 0.2, 5.0])
def test_motor_below_breakaway_torque_creeps_and_settles(period, coulomb):
    """One Runge–Kutta step per period is sufficient: below the creep velocity, without
    oscillation.
    """
    bench = build_friction_bench(period, coulomb1_nm=coulomb, coulomb2_nm=coulomb)
    torque, x, speed = Torque(0.7 * coulomb, -0.7 * coulomb), AT_REST, []
    for tick in range(300):
        x = integrate_period(FREE, bench, x, torque, torque, NO_LOADS, tick, period, 1)
        speed.append((x.dtheta1, -x.dtheta2))
    speed = np.array(speed)
    assert np.all(speed > 0.0)
    assert np.all(speed < (bench.friction.creep1, bench.friction.creep2))
    np.testing.assert_allclose(speed[-1], speed[-2], rtol=1e-3)


def test_motor_above_breakaway_torque_moves():
    bench, x, torque = build_friction_bench(), AT_REST, Torque(0.3, -0.15)
    for tick in range(500):
        x = integrate_period(FREE, bench, x, torque, torque, NO_LOADS, tick, T, 1)
    assert x.dtheta1 == pytest.approx(0.5 * (0.3 - 0.2) / FREE.B1, rel=0.15)
    assert x.dtheta2 == pytest.approx(-0.5 * (0.15 - 0.1) / FREE.B2, rel=0.15)


def test_friction_of_one_motor_does_not_affect_the_other():
    bench = build_friction_bench(coulomb1_nm=0.0)
    x = State(0.0, 0.0, 0.0, 1.0, 0.0, 1.0)
    end = integrate_period(FREE, bench, x, *(Torque(0.0, 0.0),) * 2, NO_LOADS, 0, T, 1)
    assert end.dtheta1 == 1.0
    assert end.dtheta2 == pytest.approx(1.0 - T * 0.1 / FREE.B2, rel=1e-3)


@pytest.mark.parametrize("samples", range(MAX_DELAY_SAMPLES + 1))
def test_delay_of_d_samples_is_exactly_d_samples(samples):
    """First zeros; then each torque once, in order, d samples late."""
    bench = IDEAL_BENCH._replace(delay_samples=samples)
    asked, due = (0.0,) * (2 * MAX_DELAY_SAMPLES + 2), []
    for k in range(1, 21):
        asked, torque = delay_torque(bench, asked, Torque(float(k), -float(k)))
        due.append(torque)
    expected = [max(0.0, float(k - samples)) for k in range(1, 21)]
    assert due == [Torque(k, -k) for k in expected]


@pytest.mark.parametrize("law", ["fl", "ndobc"])
@pytest.mark.parametrize("samples", [0, 1, 3, 5])
def test_torque_of_the_law_acts_d_samples_later(law, samples):
    """Until the first torque the plant is at rest, so the commanded torque is known."""
    configuration = svsa.paper.get_figure("4b").build_configuration(law)
    run = Run(configuration.changed(effects=svsa.Effects(delay_samples=samples)))
    found = record(run, 2 * samples + 1)[:, CHANNEL_INDEX["torque1_nm"]]
    blocks = build_blocks(configuration, configuration.lanes[0], run.mu0)
    stacks = build_stack(configuration.position), build_stack(configuration.stiffness)
    inputs, law = Inputs(*stacks, NO_LOADS), bind_law(configuration, configuration.lanes[0], blocks)
    call = build_call(law, run.lanes[0].memory)
    asked = [
        decide(blocks, call, inputs, AT_REST, UNDISTURBED, NO_TORQUE, UNMOVED, k)[1].u1
        for k in range(samples + 1)
    ]
    assert np.all(found[:samples] == 0.0)
    np.testing.assert_array_equal(found[samples:], asked)


def test_observer_receives_the_actual_and_not_the_commanded_torque():
    """With an exact model ŵ converges at β, for any delay and lag of the torque."""
    w = 0.3
    result = svsa.simulate(
        "4b",
        nominal=DESIGN.actuator,
        effects=svsa.Effects(delay_samples=3, current_lag=CurrentLag(time_constant_s=2e-3)),
        loads=(svsa.ConstantLoad(torque_nm=(0.0, w, 0.0)),),
        duration_s=0.1,
    )
    assert np.ptp(result.torque1_nm) > 0.3
    expected = w * (1.0 - np.exp(-60.0 * result.time_s))
    assert np.abs(result.estimate_motor1_nm - expected).max() < 2e-3 * w


def test_torque_limits_can_be_switched_off():
    """Figure 4A commands more than ±15 and ±5 N·m under the load; without limits it acts."""
    assert np.abs(svsa.simulate("4a", duration_s=6.0).torque1_nm).max() == 15.0
    free = svsa.simulate("4a", duration_s=6.0, effects=svsa.Effects(torque_limits=False))
    assert np.abs(free.torque1_nm).max() > 15.0
    assert np.abs(free.torque2_nm).max() > 5.0
    assert free.fault is None


@pytest.mark.parametrize("lag", [0.0, 4e-4])
@pytest.mark.parametrize("latency", [0.0, 3e-4, 1e-3])
def test_delayed_torque_has_two_lags_in_series(lag, latency):
    """Compared with the integral of the current loop in small steps."""
    before = Torque(1.0, 2.0)
    end, mean = compute_late_torque(START, before, TARGET, lag, latency, T)
    steps = 20_000
    made, total = np.array(START), np.zeros(2)
    if lag == 0.0:
        made = np.array(before if latency else TARGET)
    for k in range(steps):
        aim = np.array(before if (k + 0.5) * T / steps < latency else TARGET)
        rest = math.exp(-T / steps / lag) if lag else 0.0
        middle = aim + (made - aim) * (math.exp(-0.5 * T / steps / lag) if lag else 0.0)
        total += middle / steps
        made = aim + (made - aim) * rest
    np.testing.assert_allclose(mean, total, rtol=1e-6)
    if latency < T:
        np.testing.assert_allclose(end, made, rtol=1e-9)
