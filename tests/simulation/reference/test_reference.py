"""References: exact derivatives, and changes without a jump in any derivative that laws use."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import svsa
from svsa.runs.definition.command import Set
from svsa.runs.execution.run import Run
from svsa.simulation.reference.kinds import compute_start_value, get_range
from svsa.simulation.reference.kinds.sine import compute_sine
from svsa.simulation.reference.polynomials import compute_fade
from svsa.simulation.reference.transition import (
    MAX_FADES,
    build_stack,
    compute_trajectory,
    push_trajectory,
)
from tests.actuators.prototype import differentiate, drawn

SINE = svsa.SinePosition(offset_rad=0.1, amplitude_rad=0.8, frequency_hz=0.7, phase_rad=0.4)
LEVEL = svsa.ConstantPosition(position_rad=-0.5, transition_s=0.8)
FAST = svsa.SinePosition(amplitude_rad=0.3, frequency_hz=2.0, transition_s=0.5)
SLOW = svsa.SinePosition(amplitude_rad=1.0, frequency_hz=0.1, phase_rad=1.0, transition_s=2.0)


def build_busy_stack():
    """Four references: FAST starts while LEVEL fades in, SLOW while FAST does."""
    stack = push_trajectory(build_stack(SINE), LEVEL, 1.0)
    stack = push_trajectory(stack, FAST, 1.3)
    return push_trajectory(stack, SLOW, 1.6)


def assert_chain(compute, times, step, tolerance):
    """Compare each derivative with the difference of the previous one, at each time."""
    scale = np.abs([compute(t) for t in times]).max(axis=0) + 1e-12
    for t in times:
        slopes = differentiate(lambda s: np.array(compute(s)), t, step)[:4]
        assert np.all(np.abs(slopes - np.array(compute(t))[1:]) <= tolerance * scale[1:]), t


@drawn
@given(st.floats(0.0, 5.0), st.floats(-3.0, 3.0), st.floats(0.0, 30.0))
def test_each_derivative_of_a_sine_is_the_derivative_of_the_previous_one(frequency, phase, time):
    omega = 2.0 * math.pi * frequency
    step = 1e-2 / (1.0 + omega)

    def compute(t):
        return np.array(compute_sine(0.3, 0.9, omega, phase, t))

    slopes = differentiate(compute, time, step)[:4]
    scale = np.array([omega**k for k in range(1, 5)]) + 1e-6
    assert np.all(np.abs(slopes - compute(time)[1:]) <= 1e-7 * scale)


def test_each_derivative_of_the_fade_is_the_derivative_of_the_previous_one():
    """The polynomial of degree 9 and its four derivatives."""
    assert_chain(lambda t: compute_fade(2.0, 0.5, t), np.linspace(2.03, 2.47, 23), 1e-4, 1e-7)


def test_fade_goes_from_zero_to_one_with_four_continuous_derivatives():
    """All derivatives tend to zero at both ends; between them the fade is increasing."""
    before, after = compute_fade(2.0, 0.5, 2.0 + 1e-9), compute_fade(2.0, 0.5, 2.5 - 1e-9)
    assert tuple(before)[:4] == pytest.approx((0.0,) * 4, abs=1e-3)
    assert tuple(after)[:4] == pytest.approx((1.0, 0.0, 0.0, 0.0), abs=1e-3)
    for fade in (before, after):
        assert abs(fade.d4) < 1e-6 * 15120 / 0.5**4
    weights = [compute_fade(2.0, 0.5, t).d0 for t in np.linspace(1.9, 2.6, 400)]
    assert np.all(np.diff(weights) >= 0.0)
    assert (weights[0], weights[-1]) == (0.0, 1.0)
    assert compute_fade(2.0, 0.5, 2.25).d0 == pytest.approx(0.5)


def test_each_derivative_of_a_blended_reference_is_the_derivative_of_the_previous_one():
    """Leibniz's rule over three overlapping fades, whose ends lie between the times."""
    stack = build_busy_stack()
    times = np.arange(0.905, 4.0, 0.0173)
    assert_chain(lambda t: compute_trajectory(stack, t), times, 1e-4, 2e-6)


@pytest.mark.parametrize("edge", [1.0, 1.3, 1.6, 1.8, 3.6])
def test_derivatives_are_continuous_at_both_ends_of_a_fade(edge):
    """q_d … q_d⁗ on both sides of an end differ by no more than their slope explains."""
    stack, gap = build_busy_stack(), 1e-7
    left = np.array(compute_trajectory(stack, edge - gap))
    right = np.array(compute_trajectory(stack, edge + gap))
    scale = np.abs([compute_trajectory(stack, t) for t in np.linspace(0.5, 4.5, 400)]).max(axis=0)
    assert np.all(np.abs(right - left) <= 1e-4 * scale)


def test_change_preserves_the_earlier_reference():
    """At the instant of the change and before, the reference is the old one bit for bit."""
    old = push_trajectory(build_stack(SINE), LEVEL, 1.0)
    new = push_trajectory(old, FAST, 1.3)
    for t in (0.2, 1.1, 1.2999, 1.3):
        assert compute_trajectory(new, t) == compute_trajectory(old, t)


def test_new_reference_runs_alone_after_the_fade():
    """Exactly; finished fades are removed from the stack without a change of value."""
    stack = build_busy_stack()
    omega = 2.0 * math.pi * SLOW.frequency_hz
    assert compute_trajectory(stack, 5.0) == compute_sine(0.0, 1.0, omega, 1.0, 5.0)
    pushed = push_trajectory(stack, LEVEL, 5.0)
    assert len(pushed.rows) == 2
    assert compute_trajectory(pushed, 5.0) == compute_trajectory(stack, 5.0)


@settings(max_examples=20)
@given(
    st.lists(
        st.tuples(st.floats(2.0, 150.0), st.floats(0.05, 3.0), st.floats(0.01, 1.0)),
        min_size=1,
        max_size=6,
    )
)
def test_blended_stiffness_stays_in_the_range_of_its_references(changes):
    """The reason for a fade instead of a polynomial through the derivatives: σ_d must not
    overshoot.
    """
    stack = build_stack(svsa.ConstantStiffness(stiffness_nm_per_rad=60.0))
    now, low, high = 0.0, 60.0, 60.0
    for level, fade, pause in changes:
        now += pause
        target = svsa.ConstantStiffness(stiffness_nm_per_rad=level, transition_s=fade)
        stack = push_trajectory(stack, target, now)
        low, high = min(low, level), max(high, level)
    values = [compute_trajectory(stack, t).d0 for t in np.linspace(0.0, now + 3.5, 200)]
    assert low - 1e-12 * low <= min(values)
    assert max(values) <= high + 1e-12 * high


def test_too_many_changes_at_once_are_rejected_and_change_nothing():
    """A stack that grows without bound would slow every tick."""
    run = Run(svsa.paper.get_figure("4a").build_configuration())
    slow = svsa.ConstantPosition(position_rad=0.1, transition_s=60.0)
    for _ in range(MAX_FADES - 1):
        run.change(Set("position", slow))
    before = run.configuration
    with pytest.raises(svsa.StateError, match=str(MAX_FADES)):
        run.change(Set("position", svsa.ConstantPosition(position_rad=0.2)))
    assert run.configuration == before


def test_trajectory_has_its_initial_value_and_range():
    """The first sets μ0; the check of the stiffness range uses the second."""
    sine = svsa.SineStiffness(
        offset_nm_per_rad=35.0, amplitude_nm_per_rad=1.0, frequency_hz=0.2, phase_rad=1.5 * math.pi
    )
    assert compute_start_value(sine) == pytest.approx(34.0, rel=1e-12)
    assert get_range(sine) == (34.0, 36.0)
    assert get_range(LEVEL) == (-0.5, -0.5)


def test_run_starts_at_the_reference_stiffness():
    """μ0 is set for each run, so that σ(0) = σ_d(0) at x = 0."""
    for key, sigma in (("4a", 15.0), ("4b", 60.0), ("5", 34.0)):
        result = svsa.simulate(key, duration_s=0.001)
        assert result.stiffness_nm_per_rad[0] == pytest.approx(sigma, rel=1e-12)


@pytest.mark.parametrize("level", [1.0, 151.0])
def test_stiffness_outside_the_range_is_rejected(level):
    """At the start and during a run; the error contains the range."""
    wrong = svsa.ConstantStiffness(stiffness_nm_per_rad=level)
    run = Run(svsa.paper.get_figure("4a").build_configuration())
    before = run.configuration
    for change in (
        lambda: run.change(Set("stiffness", wrong)),
        lambda: svsa.simulate("4a", stiffness=wrong),
    ):
        with pytest.raises(svsa.ParameterError, match=r"from 1\.7 to 150\.56 N·m/rad"):
            change()
    assert run.configuration == before
