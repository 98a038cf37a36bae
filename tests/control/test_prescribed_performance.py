"""Prescribed performance: the funnel decays, and contains the error within the torque limits."""

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import CHANNELS
from svsa.control.installed import get_law
from svsa.control.laws.prescribed_performance import EDGE, push_inside
from svsa.runs.execution.run import Run

NAME = "prescribed_performance"
FUNNELS = get_law(NAME).parameters()


def test_memory_is_the_remaining_share_of_the_initial_width():
    run = Run(svsa.paper.get_figure("4a").build_configuration(NAME, load=False))
    run.advance(np.empty((1, 500, len(CHANNELS))))
    (left,) = run.lanes[0].memory
    assert left == pytest.approx(np.exp(-FUNNELS.decay_per_s * 0.5))


@pytest.mark.parametrize("effects", [svsa.IDEAL, svsa.RIG], ids=["ideal", "rig"])
def test_error_stays_in_its_funnel_before_and_after_the_load(effects):
    run = svsa.simulate("4a", NAME, effects=effects, duration_s=8.0)
    assert run.fault is None
    final, ratio = FUNNELS.position_width_rad, FUNNELS.initial_ratio
    width = final * (1.0 + (ratio - 1.0) * np.exp(-FUNNELS.decay_per_s * run.time_s))
    assert width[0] == pytest.approx(ratio * final)
    assert np.all(np.abs(run.position_error_rad) < EDGE * width)


def test_action_grows_without_bound_towards_the_edge_and_is_limited_beyond_it():
    assert push_inside(1e-6, 0.2) == pytest.approx(1e-6, rel=1e-6)
    near, edge = push_inside(0.18, 0.2), push_inside(EDGE * 0.2, 0.2)
    assert 0.18 < near < edge == push_inside(0.5, 0.2)
    assert push_inside(-0.18, 0.2) == -near
