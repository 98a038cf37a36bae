"""Region of attraction, frequency response and load response of a design."""

import math

import numpy as np
import pytest

import svsa
from svsa.analysis.design.attraction import (
    build_map,
    compute_share,
    find_start_outcomes,
    order_cells,
)
from svsa.analysis.design.closed_loop import linearize_loop
from svsa.analysis.design.response import ONSET_S, simulate_load
from svsa.analysis.design.sampled_loop import compute_disturbance_response
from svsa.runs.definition.configuration import Configuration

COARSE = 11


def build(law: str = "ndobc", pole: float = 60.0, **changes: object) -> Configuration:
    figure = svsa.paper.get_figure("4a").build_configuration(law, load=False)
    gains = svsa.Gains.from_poles([-pole] * 4, [-40.0] * 2)
    return figure.changed(gains=gains, **({"effects": svsa.RIG} | changes))


@pytest.mark.parametrize(
    ("law", "pole", "sigma", "share"),
    [
        ("ndobc", 60.0, 15.0, 0.21),
        ("ndobc", 45.0, 15.0, 1.0),
        ("fl", 60.0, 15.0, 0.55),
        ("ndobc", 60.0, 60.0, 0.97),
        ("fl", 60.0, 60.0, 0.94),
    ],
)
def test_share_of_starts_that_reach_rest_is_as_documented(law, pole, sigma, share):
    starts = build_map(COARSE)
    found = find_start_outcomes(build(law, pole), sigma, starts, order_cells(COARSE))
    assert compute_share([outcome for _, outcome in found]) == pytest.approx(share, abs=0.04)


def test_slice_with_deflection_has_fewer_starts_that_reach_rest():
    """At 45/60 all starts with a rigid spring reach rest, and about 64 % of those with a
    deflection.
    """
    starts = build_map(21, "deflected")
    found = find_start_outcomes(build("ndobc", 45.0), 15.0, starts, order_cells(21))
    assert compute_share([outcome for _, outcome in found]) == pytest.approx(0.64, abs=0.05)
    assert np.max(np.abs(starts.deflections)) <= 0.3
    assert np.max(np.abs(starts.rates)) <= 5.0
    again = build_map(21, "deflected")
    np.testing.assert_array_equal(again.deflections, starts.deflections)


def test_map_is_refined_from_coarse_to_fine():
    cells = order_cells(COARSE)
    assert len(set(cells)) == len(cells) == COARSE**2
    first = cells[:9]
    assert {cell.row for cell in first} == {cell.column for cell in first} == {0, 4, 8}


def test_outcome_of_a_start_is_that_of_a_simulation():
    """At rest immediately in the centre; a fault at the edge of the map, where 60/60 fails."""
    starts = build_map(3)
    outcomes = dict(find_start_outcomes(build(), 15.0, starts, order_cells(3)))
    assert outcomes[1, 1] == ("rest", 0.0)
    edge = outcomes[0, 0]
    assert edge.outcome == "fault"
    assert 0.0 < edge.after_s < 1.0


def test_frequency_response_to_a_link_torque_is_as_predicted():
    """4 Hz, near the peak of the response: amplitude and phase of a simulation within 2 %."""
    c = build(effects=svsa.IDEAL)
    found = compute_disturbance_response(c, 15.0, 300)
    index = int(np.argmin(np.abs(found.frequency - 4.0)))
    f, amplitude = float(found.frequency[index]), 0.05
    load = svsa.SineLoad(torque_nm=(amplitude, 0.0, 0.0), frequency_hz=f)
    run = svsa.simulate(c, position=svsa.ConstantPosition(), loads=[load], duration_s=4.0)
    late = run.time_s > 2.0
    t, e = run.time_s[late], run.position_error_rad[late]
    parts = np.column_stack([np.sin(2 * np.pi * f * t), np.cos(2 * np.pi * f * t)])
    (a, b), *_ = np.linalg.lstsq(parts, e, rcond=None)
    assert math.hypot(a, b) / amplitude == pytest.approx(found.magnitude[index], rel=0.02)
    turned = math.atan2(b, a) - found.phase[index]
    assert math.remainder(turned, 2 * np.pi) == pytest.approx(0.0, abs=0.03)


def test_low_frequency_response_is_proportional_to_the_torque_rate():
    """|e/w| → 2πf · (e per ẇ), the gain for a ramp."""
    c = build(effects=svsa.IDEAL)
    found = compute_disturbance_response(c, 15.0)
    loop = linearize_loop(c, 15.0)
    ramp = abs((loop.C @ np.linalg.matrix_power(np.linalg.inv(loop.A), 2) @ loop.B)[0, 0])
    rate = 2.0 * math.pi * float(found.frequency[0])
    assert found.is_stable
    assert found.magnitude[0] == pytest.approx(rate * ramp, rel=0.01)


def test_predicted_load_response_from_rest_matches_a_simulation():
    response = simulate_load(build(effects=svsa.IDEAL), 15.0)
    assert response.fault == ""
    assert response.time[0] == pytest.approx(-ONSET_S)
    assert np.all(response.error[response.time < -1e-9] == 0.0)
    assert math.degrees(np.max(np.abs(response.error))) == pytest.approx(4.14, abs=0.05)
    unstable = build(effects=svsa.RIG, observer=svsa.ObserverBandwidth(
        bandwidth_rad_per_s=(400.0, 400.0, 400.0)
    ))  # fmt: skip
    assert simulate_load(unstable, 15.0).fault != ""
    assert not compute_disturbance_response(unstable, 15.0).is_stable
