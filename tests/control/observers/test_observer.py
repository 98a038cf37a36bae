"""The observer: its discrete form tends to Eq 10 as T → 0, decays at β and does not wind up."""

import numpy as np
import pytest

import svsa
from svsa.actuators.dynamics import build_actuator, compute_internal_torque
from svsa.actuators.lever import compute_lever_ratio_for_stiffness
from svsa.actuators.signals import CHANNEL_INDEX, Disturbance, Reference, State, Torque
from svsa.control.laws.feedback_linearization import build_gains
from svsa.control.laws.ndobc import compute_ndobc
from svsa.control.observers.disturbance import compute_shares, update_disturbance_estimate
from svsa.runs.execution.run import Run
from svsa.simulation.plant.load_table import build_load_table, schedule_load
from tests.actuators.prototype import DESIGN, NOMINAL, PLANT, build_state, integrate_ideal, record

BANDWIDTH = (40.0, 60.0, 90.0)
OBSERVER = svsa.ObserverBandwidth(bandwidth_rad_per_s=BANDWIDTH)
INERTIA = np.array([NOMINAL.M, NOMINAL.B1, NOMINAL.B2])
COARSE_S, FINE_PER_COARSE, COARSE_STEPS = 0.008, 128, 25
NOTHING = Disturbance(0.0, 0.0, 0.0)
OMEGA = 0.4 * np.pi
STATE = [
    f"{part}{quantity}"
    for part in ("", "motor1_", "motor2_")
    for quantity in ("position_rad", "velocity_rad_per_s")
]
LOAD = svsa.SineLoad(torque_nm=(1.0, 0.5, 0.2), frequency_hz=2.0)


def record_trajectory():
    """States of the plant on a fine grid, and the torque held over each coarse step."""
    fine = COARSE_S / FINE_PER_COARSE
    loads = build_load_table((schedule_load(1, LOAD, 0, fine),))
    x, states, torques = build_state(mu=0.6, phi=0.05), [], []
    for k in range(COARSE_STEPS):
        torque = Torque(0.8 * np.sin(0.5 * k) - 4.0 * x.theta1, 0.3 * np.cos(0.4 * k))
        for i in range(FINE_PER_COARSE):
            states.append(x)
            torques.append(torque)
            tick = k * FINE_PER_COARSE + i
            x = integrate_ideal(PLANT, x, torque, loads, tick, fine, 1)
    return [*states, x], torques


def observe(states, torques, stride):
    """The discrete observer with a period of `stride` fine steps; ŵ at the coarse times."""
    estimate, out = NOTHING, []
    period = stride * COARSE_S / FINE_PER_COARSE
    shares = compute_shares(OBSERVER, period)
    for i in range(0, len(torques), stride):
        estimate = update_disturbance_estimate(
            NOMINAL, shares, estimate, states[i], states[i + stride], torques[i], period
        )
        if (i + stride) % FINE_PER_COARSE == 0:
            out.append(estimate)
    return np.array(out)


def integrate_equation_10(states, torques):
    """Eq 10 by RK4 along the same states: ŵ = z + k v, ż = −(k/J)(z + k v + F + u)."""
    beta = np.array(BANDWIDTH)
    gain = beta * INERTIA
    velocity = np.array([(x.dq, x.dtheta1, x.dtheta2) for x in states])
    force = np.array([compute_internal_torque(NOMINAL, x) for x in states])
    step = 2.0 * COARSE_S / FINE_PER_COARSE
    z, out = -gain * velocity[0], []
    for i in range(0, len(torques), 2):
        u = np.array([0.0, *torques[i]])
        old, mid, new = (gain * velocity[i + n] + force[i + n] + u for n in range(3))
        k1 = -beta * (z + old)
        k2 = -beta * (z + 0.5 * step * k1 + mid)
        k3 = -beta * (z + 0.5 * step * k2 + mid)
        k4 = -beta * (z + step * k3 + new)
        z = z + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        if (i + 2) % FINE_PER_COARSE == 0:
            out.append(z + gain * velocity[i + 2])
    return np.array(out)


def test_discrete_observer_tends_to_eq_10_as_the_period_tends_to_zero():
    """With order 2, that of the trapezoidal rule; a held velocity would give order 1."""
    states, torques = record_trajectory()
    continuous = integrate_equation_10(states, torques)
    strides = np.array([128, 64, 32, 16])
    errors = [np.abs(observe(states, torques, s) - continuous).max() for s in strides]
    assert np.all(np.diff(errors) < 0.0), errors
    slope = np.polyfit(np.log(strides), np.log(errors), 1)[0]
    assert slope == pytest.approx(2.0, abs=0.3), errors
    assert errors[-1] < 1e-3 * np.abs(continuous).max()


def simulate_exact_model(observer, torque_nm, duration, **changes):
    """A run whose nominal model equals the plant, under a constant load from t = 0."""
    return svsa.simulate(
        "4b",
        nominal=DESIGN.actuator,
        observer=svsa.ObserverBandwidth(bandwidth_rad_per_s=observer),
        loads=(svsa.ConstantLoad(torque_nm=torque_nm),),
        duration_s=duration,
        **changes,
    )


def test_estimation_error_of_a_constant_disturbance_decays_at_beta():
    """Eq 12: e_w = w e^(−βt) on each channel with its own β, for any motion."""
    bandwidth, w = (30.0, 60.0, 90.0), (0.4, -0.5, 0.3)
    result = simulate_exact_model(bandwidth, w, 0.1)
    for part, beta, torque in zip(("link", "motor1", "motor2"), bandwidth, w, strict=True):
        error = torque - getattr(result, f"estimate_{part}_nm")
        expected = torque * np.exp(-beta * result.time_s)
        assert np.abs(error - expected).max() < 4e-4 * abs(torque), part


def test_true_disturbance_on_an_exact_model_is_the_load():
    """The plotted reference of ŵ: Eq 6–9, where only the load is unmodelled."""
    w = (0.4, -0.5, 0.3)
    result = simulate_exact_model((60.0,) * 3, w, 0.05)
    for part, torque in zip(("link", "motor1", "motor2"), w, strict=True):
        true = getattr(result, f"disturbance_{part}_nm")
        np.testing.assert_allclose(true, torque, rtol=0, atol=1e-11)


def test_estimate_does_not_wind_up_in_saturation():
    """A limit that holds motor 1 at its stop all the time: ŵ still tends to w.

    The observer gets the actual torque. With the commanded torque its estimate would be wrong.
    """
    limits = DESIGN.limits.changed(torque1_nm=0.05, torque2_nm=0.02)
    result = simulate_exact_model((60.0,) * 3, (0.02, 0.0, 0.0), 0.3, limits=limits)
    assert result.fault is None
    saturated = np.abs(result.torque1_nm) == 0.05
    assert saturated.mean() > 0.9
    late = result.time_s > 0.2
    for part, torque in (("link", 0.02), ("motor1", 0.0), ("motor2", 0.0)):
        error = getattr(result, f"estimate_{part}_nm")[late] - torque
        assert np.abs(error).max() < 1e-3, part
    assert abs(replay_with_commanded_torque(result).w4) > 0.1


def replay_with_commanded_torque(result):
    """The last estimate of a run if the observer received the commanded instead of the limited
    torque.
    """
    mu0 = compute_lever_ratio_for_stiffness(60.0, NOMINAL.K)
    nominal, gains = build_actuator(DESIGN.actuator, mu0), build_gains(DESIGN.gains)
    shares = compute_shares(DESIGN.observer, 0.001)
    frame = result.to_dataframe()
    estimate, states = NOTHING, [State(*row) for row in frame[STATE].to_numpy()]
    references = frame.filter(regex="reference").to_numpy()
    for old, new, (q, dq, sigma) in zip(states[:-1], states[1:], references[:-1], strict=True):
        reference = Reference(
            q, dq, -(OMEGA**2) * q, -(OMEGA**2) * dq, OMEGA**4 * q, sigma, 0.0, 0.0
        )
        asked = compute_ndobc(nominal, gains, old, reference, NOTHING)
        estimate = update_disturbance_estimate(nominal, shares, estimate, old, new, asked, 0.001)
    return estimate


def test_one_update_from_rest_is_the_observer_gain():
    """By hand: at rest with torque u and no motion the unexplained torque is −u, on its channel."""
    rest = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    nominal = build_actuator(DESIGN.nominal, 0.5)
    found = update_disturbance_estimate(
        nominal, compute_shares(OBSERVER, 0.001), NOTHING, rest, rest, Torque(0.7, -0.2), 0.001
    )
    assert found.w2 == 0.0
    assert found.w4 == pytest.approx(-0.7 * (1.0 - np.exp(-0.06)), rel=1e-12)
    assert found.w6 == pytest.approx(0.2 * (1.0 - np.exp(-0.09)), rel=1e-12)


def test_observer_is_updated_with_the_estimate_before_the_law_uses_it():
    """The first sample acts on ŵ = 0, the second on the estimate of the first period."""
    run = Run(svsa.paper.get_figure("4a").build_configuration())
    start = run.lanes[0].x
    sample = dict(zip(CHANNEL_INDEX, record(run, 1)[0], strict=True))
    torque = Torque(sample["torque1_nm"], sample["torque2_nm"])
    expected = update_disturbance_estimate(
        build_actuator(DESIGN.nominal, run.mu0),
        compute_shares(DESIGN.observer, 0.001),
        NOTHING,
        start,
        run.lanes[0].x,
        torque,
        0.001,
    )
    assert run.lanes[0].estimate == pytest.approx(expected, rel=1e-12)
    used, parts = run.lanes[0].estimate, ("link", "motor1", "motor2")
    assert [sample[f"estimate_{part}_nm"] for part in parts] == [0.0, 0.0, 0.0]
    after = dict(zip(CHANNEL_INDEX, record(run, 1)[0], strict=True))
    assert [after[f"estimate_{part}_nm"] for part in parts] == list(used)
