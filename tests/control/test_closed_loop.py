"""The closed loop with an exact model follows Eq 25; the printed sign of u makes it unstable."""

import numpy as np
import pytest
from scipy.linalg import expm

import svsa
from svsa.actuators.domain import DEFLECTION_LIMIT, INSIDE, build_domain, check_domain
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.lever import compute_lever_ratio_for_stiffness
from svsa.actuators.linearization import compute_linearization, solve_decoupling
from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS, Disturbance, Reference, State, Torque
from svsa.control.laws.feedback_linearization import (
    build_gains,
    compute_linearized_demand,
)
from svsa.control.laws.ndobc import compute_disturbance_gain, compute_ndobc
from svsa.control.limits import limit_torque
from svsa.control.observers.disturbance import compute_shares, update_disturbance_estimate
from svsa.runs.definition.command import Set
from svsa.runs.execution.run import Run
from svsa.simulation.reference.kinds.sine import compute_sine
from tests.actuators.prototype import DESIGN, NO_LOADS, K, integrate_ideal, move_plant, record
from tests.exhaustive import exhaust

GAINS_OF_POLES = {
    "the default poles": svsa.Gains.from_poles([-60.0] * 4, [-40.0] * 2),
    "distinct and complex poles": svsa.Gains.from_poles(
        [-45.0, -80.0, -30.0 + 30.0j, -30.0 - 30.0j], [-20.0 + 15.0j, -20.0 - 15.0j]
    ),
}
LEVEL = 60.0
OFF_POSITION, OFF_STIFFNESS = 0.01, 2.0


def predict_error(coefficients, e0, times):
    """The solution of Eq 25: e⁽ⁿ⁾ + c_{n−1} e⁽ⁿ⁻¹⁾ + … + c0 e = 0 from (e0, 0, 0, …)."""
    n = len(coefficients)
    companion = np.diag(np.ones(n - 1), 1)
    companion[-1] = -np.array(coefficients)
    return np.array([expm(companion * t)[0, 0] * e0 for t in times])


def compute_departure(gains, period):
    """The deviation of FL's errors from Eq 25, relative to the initial errors."""
    configuration = svsa.Configuration(
        **dict(DESIGN.changed(nominal=DESIGN.actuator, gains=gains, sampling={"period_s": period})),
        law="fl",
        position=svsa.ConstantPosition(position_rad=OFF_POSITION),
        stiffness=svsa.ConstantStiffness(stiffness_nm_per_rad=LEVEL),
    )
    run = Run(configuration)
    mu = compute_lever_ratio_for_stiffness(LEVEL - OFF_STIFFNESS, K)
    move_plant(run, theta2=2.0 * np.pi * (mu - run.mu0))
    samples = record(run, round(0.2 / period))[:: round(2e-3 / period)]
    times = samples[:, CHANNEL_INDEX["time_s"]]
    position = samples[:, CHANNEL_INDEX["position_error_rad"]]
    stiffness = samples[:, CHANNEL_INDEX["stiffness_error_nm_per_rad"]]
    e1 = predict_error(gains.position_coefficients, OFF_POSITION, times)
    e2 = predict_error(gains.stiffness_coefficients, OFF_STIFFNESS, times)
    return (
        np.abs(position - e1).max() / OFF_POSITION,
        np.abs(stiffness - e2).max() / OFF_STIFFNESS,
    )


@pytest.mark.parametrize("name", exhaust(GAINS_OF_POLES, ["the default poles"]))
def test_errors_follow_the_roots_of_eq_25_with_an_exact_model(name):
    """Both errors at once, decoupled; the rest is due to the hold and decreases with the period."""
    gains = GAINS_OF_POLES[name]
    coarse = np.array(compute_departure(gains, 4e-4))
    fine = np.array(compute_departure(gains, 1e-4))
    assert np.all(fine < 1e-3), fine
    assert np.all(fine < 0.3 * coarse), "a hold's error falls with the first power of T"


def test_outputs_are_decoupled():
    """A stiffness error alone moves the position by less than a thousandth of a degree."""
    result = svsa.simulate(
        "4b",
        "fl",
        nominal=DESIGN.actuator,
        sampling={"period_s": 1e-4},
        position=svsa.ConstantPosition(),
        stiffness=svsa.SineStiffness(
            offset_nm_per_rad=60.0, amplitude_nm_per_rad=20.0, frequency_hz=1.0
        ),
        loads=(),
        duration_s=1.0,
    )
    assert np.ptp(result.stiffness_nm_per_rad) > 30.0
    assert np.degrees(np.abs(result.position_rad).max()) < 1e-3


def build_mirrored(sign):
    """A run with all signed quantities inverted: q_d, w2 and w4, but not w6."""
    return (
        svsa.paper.get_figure("5")
        .build_configuration(load=False)
        .changed(
            position=svsa.ConstantPosition(position_rad=sign * 0.2),
            loads=(
                svsa.ConstantLoad(torque_nm=(sign * 0.8, sign * 0.3, 0.2), start_s=0.15),
                svsa.MassLoad(mass_kg=0.5, start_s=0.3),
            ),
        )
    )


ODD = [
    "position_reference_rad",
    "velocity_reference_rad_per_s",
    "position_rad",
    "velocity_rad_per_s",
    "position_estimate_rad",
    "velocity_estimate_rad_per_s",
    "motor1_position_rad",
    "motor1_velocity_rad_per_s",
    "deflection_rad",
    "position_error_rad",
    "torque1_nm",
    "disturbance_link_nm",
    "disturbance_motor1_nm",
    "estimate_link_nm",
    "estimate_motor1_nm",
]


def test_mirrored_run_is_the_mirror_of_the_run_bit_for_bit():
    """x, q_d, w2, w4 → −: all signs of link and motor 1 are inverted; θ2 and σ are equal."""
    runs = []
    for sign in (1.0, -1.0):
        run = Run(build_mirrored(sign))
        first = record(run, 500)
        run.change(
            Set("position", svsa.ConstantPosition(position_rad=sign * -0.3, transition_s=0.3))
        )
        runs.append(np.vstack([first, record(run, 500)]))
    signs = np.array([-1.0 if channel.name in ODD else 1.0 for channel in CHANNELS])
    assert np.abs(runs[0][:, CHANNEL_INDEX["deflection_rad"]]).max() > 0.01
    np.testing.assert_array_equal(runs[0], runs[1] * signs)


def solve_as_printed(nominal, gains, x, reference, estimate):
    """u = A⁻¹[−b + v + Γŵ], Eq 24 with the printed sign, which only this test uses."""
    lie = compute_linearization(nominal, x)
    y1, y2 = compute_linearized_demand(lie, gains, reference)
    gain = np.array(compute_disturbance_gain(nominal, gains, lie)).reshape(2, 3)
    compensation = gain @ np.array(estimate)
    return solve_decoupling(lie, -y1 + compensation[0], -y2 + compensation[1])


def run_until_fault(law, duration, steps=1):
    """Figure 4A without the load under this law: (end time, domain code)."""
    mu0 = compute_lever_ratio_for_stiffness(15.0, K)
    plant, nominal = build_actuator(DESIGN.actuator, mu0), build_actuator(DESIGN.nominal, mu0)
    gains, domain = build_gains(DESIGN.gains), build_domain(DESIGN.actuator, DESIGN.limits)
    x, estimate, period = State(*np.zeros(6)), Disturbance(0.0, 0.0, 0.0), 0.001
    shares = compute_shares(DESIGN.observer, period)
    for tick in range(round(duration / period)):
        code = check_domain(domain, plant, x)
        if code != INSIDE:
            return tick * period, code
        q = compute_sine(0.0, np.radians(60.0), 0.4 * np.pi, 0.0, tick * period)
        asked = law(nominal, gains, x, Reference(*q, 15.0, 0.0, 0.0), estimate)
        torque = limit_torque(asked, DESIGN.limits.torque1_nm, DESIGN.limits.torque2_nm)
        old, x = x, integrate_ideal(plant, x, torque, NO_LOADS, tick, period, steps)
        estimate = update_disturbance_estimate(nominal, shares, estimate, old, x, torque, period)
    return duration, INSIDE


def test_printed_sign_of_eq_24_leaves_the_domain_and_the_corrected_does_not():
    """The printed sign drives the error away from zero."""
    end, code = run_until_fault(solve_as_printed, 0.5)
    assert code == DEFLECTION_LIMIT
    assert end < 0.1
    assert run_until_fault(compute_ndobc, 0.5) == (0.5, INSIDE)


def test_torque_respects_its_limits_which_do_not_hide_nan():
    """±15 and ±5 N·m in Figure 4A, which reaches both; NaN must pass the limits to the guard."""
    result = svsa.simulate("4a", "ndobc", duration_s=6.0)
    assert np.abs(result.torque1_nm).max() == 15.0
    assert np.abs(result.torque2_nm).max() == 5.0
    limited = limit_torque(Torque(float("nan"), -7.0), 15.0, 5.0)
    assert np.isnan(limited.u1)
    assert limited.u2 == -5.0
