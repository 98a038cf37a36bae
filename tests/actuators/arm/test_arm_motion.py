"""Inverse kinematics with four derivatives, and the torques along a motion with two."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from svsa.actuators.arm.dynamics import Link, build_arm
from svsa.actuators.arm.motion import Motion, compute_joint_motions, compute_sine_of
from svsa.actuators.arm.parameters import RODS
from svsa.control.arm_feedforward import compute_torques_along

ARM = RODS.change_link(1, length_m=0.32).change_link(2, length_m=0.25).build()
rates = st.floats(-3.0, 3.0)


def compute_tip(q1, q2):
    """Both coordinates with four derivatives, from the sines of q1 and p = q1 + q2."""
    p = Motion(*np.add(q1, q2))
    (s1, c1), (sp, cp) = compute_sine_of(q1), compute_sine_of(p)
    l1, l2 = ARM.lengths
    x = Motion(*(l1 * np.array(s1) + l2 * np.array(sp)))
    return x, Motion(*(-l1 * np.array(c1) - l2 * np.array(cp)))


@given(st.floats(-3.0, 3.0), st.floats(0.1, 3.0), st.booleans(), st.tuples(*[rates] * 8))
def test_inverse_kinematics_inverts_forward_kinematics(q1, bend, is_positive, given_rates):
    """Value and four derivatives, for both elbows, wherever the tip is not around the top."""
    elbow = 1.0 if is_positive else -1.0
    first, second = Motion(q1, *given_rates[:4]), Motion(elbow * bend, *given_rates[4:])
    x, y = compute_tip(first, second)
    assume(abs(math.atan2(x.d0, -y.d0)) < 3.1)
    found1, found2 = compute_joint_motions(ARM, elbow, x, y)
    # q1 may differ by a turn.
    turn = 2.0 * math.pi * round((found1.d0 - first.d0) / (2.0 * math.pi))
    assert np.subtract(found1, (turn, 0, 0, 0, 0)) == pytest.approx(
        np.array(first), rel=1e-5, abs=1e-6
    )
    assert np.array(found2) == pytest.approx(np.array(second), rel=1e-5, abs=1e-6)


def test_sine_and_cosine_match_their_numerical_derivatives():
    """An angle of degree 4 in time: differences of sin q over a step of 10 ms."""
    powers, h = (0.7, -1.1, 0.4, 0.3, -0.2), 0.01
    angle = Motion(*(c * math.factorial(k) for k, c in enumerate(powers)))
    times = h * np.arange(-4, 5)
    q = sum(c * times**k for k, c in enumerate(powers))
    for of_angle, values in zip(compute_sine_of(angle), (np.sin(q), np.cos(q)), strict=True):
        fitted = np.polynomial.polynomial.polyfit(times, values, 8)[:5]
        wanted = [c * math.factorial(k) for k, c in enumerate(fitted)]
        assert np.array(of_angle) == pytest.approx(np.array(wanted), rel=1e-6, abs=1e-6)


def test_feedforward_torques_match_their_numerical_derivatives():
    """Of three joints."""
    links = (Link(0.3, 0.4, 0.1, 0.003), Link(0.25, 0.3, 0.12, 0.002), Link(0.2, 0.2, 0.1, 0.001))
    arm, h = build_arm(links, 9.81), 1e-3

    def compute(t):
        waves = tuple(
            Motion(*(a * w**k * math.sin(w * t + f + k * math.pi / 2) for k in range(5)))
            for a, w, f in ((0.6, 2.0, 0.0), (0.8, 3.0, 0.7), (0.5, 4.0, 0.2))
        )
        return np.array(compute_torques_along(arm, waves))

    before, now, after = compute(0.4 - h), compute(0.4), compute(0.4 + h)
    assert now[:, 1] == pytest.approx((after - before)[:, 0] / (2 * h), rel=1e-4)
    assert now[:, 2] == pytest.approx((after - before)[:, 1] / (2 * h), rel=1e-4)
