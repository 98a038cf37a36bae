"""References of the tip: the arm follows them, their derivatives are continuous, their reach."""

import math

import numpy as np
import pytest

import svsa
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.execution.arm_run import ArmRun
from svsa.simulation.arm.loop import plan

ELLIPSE = svsa.TipEllipse(center_m=(0.1, -0.4), radii_m=(0.12, -0.06), frequency_hz=0.5)
MOVE = svsa.TipMove(start_m=(-0.2, -0.45), end_m=(0.3, -0.2), duration_s=1.5, elbow="negative")


def follow(tip, duration_s=4.0):
    return svsa.simulate_arm(law="ndobc", tip=tip, feedforward=True, duration_s=duration_s)


def test_tip_follows_an_ellipse():
    """Within 0.05 mm of it after the start."""
    result = follow(ELLIPSE)
    angle = 2.0 * math.pi * 0.5 * result.time_s
    wanted = np.stack([0.1 + 0.12 * np.cos(angle), -0.4 - 0.06 * np.sin(angle)], 1)
    assert np.abs(result.tip_position_m - wanted)[2000:].max() < 5e-5
    assert result.samples[1, :, 1].min() > 0.5, "q2 stays positive"


def test_tip_moves_on_a_straight_line_from_rest_to_rest():
    result = follow(MOVE)
    first, last = result.tip_position_m[0], result.tip_position_m[-1]
    assert first == pytest.approx(MOVE.start_m, abs=1e-9)
    assert last == pytest.approx(MOVE.end_m, abs=5e-5)
    way = np.subtract(MOVE.end_m, MOVE.start_m)
    aside = (result.tip_position_m - MOVE.start_m) @ np.array([-way[1], way[0]])
    assert np.abs(aside / np.hypot(*way))[500:].max() < 1e-3
    assert result.samples[1, :, 1].max() < -0.3, "q2 stays negative"


@pytest.mark.parametrize("tip", [ELLIPSE, MOVE])
def test_each_derivative_of_the_joint_references_is_that_of_the_one_before(tip):
    """Central differences over the whole path, its ends included: no jump up to the fourth."""
    period = 0.001
    run = ArmRun(build_arm_experiment("rods", {"tip": tip}, {}))
    known = [plan(run.arms[0], run.arm_inputs, tick) for tick in range(2000)]
    for joint in (0, 1):
        motion = np.array([one[joint].reference[:5] for one in known])
        for order in range(4):
            slopes = (motion[2:, order] - motion[:-2, order]) / (2 * period)
            scale = np.abs(motion[:, order + 1]).max()
            assert slopes == pytest.approx(motion[1:-1, order + 1], abs=5e-3 * scale)


@pytest.mark.parametrize(
    ("tip", "message"),
    [
        (ELLIPSE.changed(radii_m=(0.12, 0.3)), "tip is 'x from"),
        (ELLIPSE.changed(center_m=(0.0, -0.05)), "away from joint 1"),
        (ELLIPSE.changed(center_m=(0.0, 0.4)), "not around its top"),
    ],
)
def test_path_outside_the_reach_of_the_arm_is_rejected(tip, message):
    with pytest.raises(svsa.ParameterError, match=message):
        follow(tip)


def test_movement_needs_two_different_points():
    with pytest.raises(svsa.ParameterError, match="another point"):
        svsa.TipMove(start_m=(0.1, -0.3), end_m=(0.1, -0.3), duration_s=1.0)
