"""Theorem 1: the loop near rest under model error, load ramps and sampling."""

import math

import numpy as np
import pytest

import svsa
from svsa.analysis.design.closed_loop import connect, linearize_law, linearize_loop
from svsa.analysis.design.rate_gain import (
    compute_floor,
    compute_formula,
    compute_rate_gain,
    simulate_ramp,
)
from svsa.analysis.design.robustness import find_stable_ranges
from svsa.analysis.design.sampled_loop import find_fastest_observer, linearize_tick
from svsa.analysis.design.stability import assess
from svsa.control.installed import get_law
from svsa.runs.definition.configuration import Configuration
from tests.exhaustive import exhaust

FASTEST_ON_RIG = {5.0: 236.0, 15.0: 249.0, 30.0: 263.0, 60.0: 278.0}
"""Fastest observer bandwidth in rad/s by stiffness in N·m/rad."""


def build(law: str = "ndobc", beta: float = 60.0, **changes: object) -> Configuration:
    observer = svsa.ObserverBandwidth(bandwidth_rad_per_s=(beta, beta, beta))
    figure = svsa.paper.get_figure("4a").build_configuration(law, load=False)
    return figure.changed(observer=observer, **changes)


@pytest.mark.parametrize(("sigma", "slowest"), [(15.0, -20.1), (60.0, -20.3)])
def test_loop_with_table_1_is_hurwitz(sigma, slowest):
    loop = linearize_loop(build(), sigma)
    assert loop.slowest == pytest.approx(slowest, abs=0.05)
    assert loop.is_hurwitz
    assert loop.least_damping >= 0.41


def test_least_damping_is_at_low_stiffness():
    assert linearize_loop(build(), 15.0).least_damping == pytest.approx(0.41, abs=0.005)


def test_exact_model_has_the_placed_poles():
    """Each polynomial of Eq 25 and, independent of it, the observer's −β."""
    c = build(beta=90.0, gains=svsa.Gains.from_poles([-30.0, -40.0, -50.0, -70.0], [-20.0, -25.0]))
    exact = c.changed(actuator=c.nominal)
    placed = [-90.0, -90.0, -90.0, -70.0, -50.0, -40.0, -30.0, -25.0, -20.0]
    found = np.sort(linearize_loop(exact, 15.0).poles.real)
    assert found == pytest.approx(placed, rel=1e-3)


@pytest.mark.parametrize("law", ["ndobc", "fl", "fl_integral", "pi_observer", "lqi", "pid"])
@pytest.mark.parametrize("sigma", [15.0, 60.0])
def test_sampled_loop_tends_to_the_continuous_loop_at_short_periods(law, sigma):
    """Any control law with its memory: ln z / T of the loop at 10 kHz, slow poles to 2 %."""
    c = build(law)
    loop = linearize_loop(c, sigma)
    fast = c.changed(sampling=c.sampling.changed(period_s=1e-4))
    z = np.linalg.eigvals(linearize_tick(fast, sigma).A).astype(complex)
    s = np.log(z[np.abs(z) > 0.5]) / 1e-4
    for pole in loop.poles[np.abs(loop.poles) < 120.0]:
        assert np.min(np.abs(s - pole)) < 0.02 * abs(pole)


@pytest.mark.parametrize("law", ["pi_observer", "adrc", "linear_dob", "ndobc_w", "nmpc", "esp"])
def test_law_is_linearized_after_its_initialization(law):
    """Laws with their own observer start at the first measurement; at rest they leave no error."""
    loop = linearize_tick(build(law), 15.0)
    assert loop.radius < 1.0 + 1e-9
    still, *_ = np.linalg.lstsq(np.eye(len(loop.A)) - loop.A, loop.W[:, 0])
    assert abs(still[0]) < 1e-6


@pytest.mark.parametrize("law", ["ndobc_w", "adrc", "linear_dob"])
def test_law_without_a_continuous_model_is_rejected_by_name(law):
    title = get_law(law).title
    with pytest.raises(svsa.ParameterError, match=f"law is '{title}': it must be a law whose cont"):
        assess(build(law), 15.0)


@pytest.mark.parametrize("sigma", [15.0, 60.0])
def test_super_twisting_is_a_damped_linear_loop_within_its_boundary_layer(sigma):
    """With √(L|s|) tanh(s/d) the layer had no damping: a small error became a cycle of 0.0065°."""
    loop = assess(build("super_twisting"), sigma).loop
    assert loop.slowest < -15.0
    assert loop.least_damping > 0.25
    nudged = svsa.simulate(
        build("super_twisting"),
        position=svsa.ConstantPosition(),
        stiffness=svsa.ConstantStiffness(stiffness_nm_per_rad=sigma),
        loads=[svsa.PulseLoad(torque_nm=(0.01, 0.0, 0.0), duration_s=0.01)],
        duration_s=3.0,
    )
    error = np.abs(nudged.position_error_rad)
    assert error.max() > 1e-5
    assert error[-500:].max() < 1e-6 * error.max()


def test_each_parameter_has_its_range():
    """Found on a grid of 5 %: stable at each bound, unstable one step further."""
    ranges = {one.symbol: one for one in find_stable_ranges(build(), 15.0)}
    for low, high, symbol in ((0.24, 3.66, "M"), (None, 4.25, "B1"), (None, 9.0, "B2")):
        found = ranges[symbol]
        assert found.high is not None
        assert high <= found.high <= 1.055 * high
        if low is None:
            assert found.low is None
        else:
            assert found.low is not None
            assert low / 1.055 <= found.low <= low
    assert ranges["M"].present == pytest.approx(0.0103 / 0.0153)


@pytest.mark.parametrize("side", ["low", "high"])
def test_simulation_agrees_with_the_range_of_the_inertia(side):
    """A small deviation decays just inside the range and grows just outside it."""
    c = build()
    found = next(one for one in find_stable_ranges(c, 15.0) if one.symbol == "M")
    end = getattr(found, side)

    def measure_growth(ratio: float) -> float:
        M = ratio * c.nominal.link_inertia_kg_m2
        run = svsa.simulate(
            c.changed(actuator=c.nominal.changed(link_inertia_kg_m2=M)),
            position=svsa.ConstantPosition(),
            effects=svsa.IDEAL.changed(torque_limits=False),
            sampling=c.sampling.changed(period_s=1e-4),
            loads=[svsa.PulseLoad(torque_nm=(1e-4, 0.0, 0.0), duration_s=0.01)],
            duration_s=1.5,
        )
        assert run.fault is None
        error = np.abs(run.position_error_rad)
        return float(error[-3000:].max() / error[6000:9000].max())

    inward = 1.1 if side == "low" else 1.0 / 1.1
    assert measure_growth(end * inward) < 1.0
    assert measure_growth(end / inward) > 1.0


@pytest.mark.parametrize(("beta", "degrees"), [(30.0, 0.267), (60.0, 0.168), (120.0, 0.119)])
def test_error_under_a_load_ramp_matches_the_formula(beta, degrees):
    c = build(beta=beta)
    gain = compute_rate_gain(linearize_loop(c, 15.0))
    formula = compute_formula(c, 15.0)
    assert formula is not None
    assert math.degrees(formula) == pytest.approx(degrees, abs=5e-4)
    assert gain.ramp == pytest.approx(formula, rel=1e-6)
    assert gain.l1 >= gain.ramp
    for rate in (0.1, 1.0, 2.0):
        ramp = simulate_ramp(c, 15.0, rate)
        assert math.degrees(ramp.gain) == pytest.approx(degrees, abs=6e-4)
        assert ramp.lag == pytest.approx(1.0 / beta, rel=2e-3)


def test_no_observer_gain_gives_an_error_below_the_floor():
    floor = compute_floor(build())
    assert floor is not None
    assert math.degrees(floor) == pytest.approx(0.069, abs=5e-4)
    fast = compute_formula(build(beta=1000.0), 15.0)
    assert fast is not None
    assert floor < fast < 1.1 * floor


def test_worst_torque_of_bounded_rate_has_the_reported_effect():
    """w whose rate switches with the sign of the impulse response, read backwards from the end."""
    c = build(actuator=build().nominal)
    loop = linearize_loop(c, 15.0)
    gain = compute_rate_gain(loop)
    step, count = 1e-3, 1500
    before = np.linalg.solve(loop.A.T, loop.C[0])
    from scipy.linalg import expm

    advance, z = expm(loop.A * step), loop.B[:, 0].copy()
    response = []
    for _ in range(count):
        response.append(before @ z)
        z = advance @ z
    w = np.concatenate([[0.0], np.cumsum(np.sign(response[::-1]) * step)])
    times = tuple(float(t) for t in np.arange(count + 1) * step)
    load = svsa.SeriesLoad(time_s=times, torque_nm=tuple((float(one), 0.0, 0.0) for one in w))
    run = svsa.simulate(c, position=svsa.ConstantPosition(), loads=[load], duration_s=count * step)
    assert abs(run.position_error_rad[-1]) == pytest.approx(gain.l1, rel=0.02)


def test_law_with_error_under_constant_torque_has_no_l1_gain():
    c = build("fl")
    assert compute_formula(c, 15.0) is None
    assert math.isinf(compute_rate_gain(linearize_loop(c, 15.0)).ramp)
    integral = compute_rate_gain(linearize_loop(build("fl_integral"), 15.0))
    ramp = simulate_ramp(build("fl_integral"), 15.0, 1.0)
    assert ramp.lag is None
    assert ramp.gain == pytest.approx(integral.ramp, rel=0.01)


@pytest.mark.parametrize("sigma", exhaust(FASTEST_ON_RIG, [15.0]))
def test_sampling_bounds_the_observer_gain_on_the_rig(sigma):
    fastest = FASTEST_ON_RIG[sigma]
    found = find_fastest_observer(build(effects=svsa.RIG), sigma)
    assert found == pytest.approx(fastest, rel=0.012)
    late = find_fastest_observer(build(effects=svsa.RIG.changed(delay_samples=2)), sigma)
    assert late is not None
    assert 219.0 < late < 233.0


def test_fastest_observer_is_at_the_stability_boundary():
    fastest = find_fastest_observer(build(effects=svsa.RIG), 15.0)
    assert fastest is not None
    for share, is_stable in ((0.99, True), (1.01, False)):
        loop = linearize_tick(build(beta=share * fastest, effects=svsa.RIG), 15.0)
        assert (loop.radius < 1.0) == is_stable


def test_observer_gain_is_unbounded_without_delay_and_estimator():
    assert find_fastest_observer(build(), 15.0) is None
    assert linearize_tick(build(beta=1000.0), 15.0).radius < 1.0
    assert find_fastest_observer(build("fl", effects=svsa.RIG), 15.0) is None


def test_unstable_nominal_loop_has_no_ranges():
    """The derivatives of a control law with inverted torque."""
    c = build()
    law = linearize_law(c, 15.0)
    turned = law._replace(torque=-law.torque)
    assert not connect(c, 15.0, turned, c.nominal).is_hurwitz
    assert find_stable_ranges(c, 15.0, turned) == []
