"""The adaptive payload: what it estimates, and what laws do with it under 0.3 kg at the tip."""

import math

import numpy as np
import pytest

import svsa
from svsa.actuators.arm.parameters import build_rods

LOAD = svsa.TipMass(mass_kg=0.3, start_s=5.0)
HEAVY = {"observer": 40.0, "gains": svsa.Gains.from_poles([-40] * 4, [-40] * 2)}
"""Poles and observer that suit the heavier arm."""


def measure_deg(result, start_s=8.0, end_s=20.0):
    return [math.degrees(rms) for rms in result.measure(start_s, end_s)]


@pytest.mark.parametrize(
    ("pole", "sigma", "known"),
    [(40, 80.0, (0.022, 0.050)), (25, 40.0, (0.051, 0.119)), (40, 40.0, (0.023, 0.052))],
)
def test_fl_with_the_estimate_has_the_errors_of_the_prototype(pole, sigma, known):
    gains = svsa.Gains.from_poles([-pole] * 4, [-40] * 2)
    options = {"feedforward": True, "stiffness": sigma, "gains": gains, "observer": 40.0}
    result = svsa.simulate_arm(law="fl", adaptation=True, tip_loads=[LOAD], **options)
    assert measure_deg(result) == pytest.approx(known, abs=5.1e-4)
    plain = svsa.simulate_arm(law="fl", tip_loads=[LOAD], **options)
    assert min(measure_deg(plain)) > 20 * max(known), "the load must matter"


def test_shift_of_the_estimate_with_the_model_halves_the_error():
    """Only the replay of a record of an earlier version has no shift."""
    options = {"law": "ndobc", "feedforward": True, "tip_loads": [LOAD], **HEAVY}
    former = svsa.PayloadAdaptation(shifts_estimate=False)
    assert measure_deg(svsa.simulate_arm(adaptation=former, **options)) == pytest.approx(
        [0.027, 0.061], abs=5.1e-4
    )
    assert measure_deg(svsa.simulate_arm(adaptation=True, **options)) == pytest.approx(
        [0.010, 0.022], abs=5.1e-4
    )


def test_ndobc_carries_a_heavy_payload_only_with_the_payload_estimate():
    options = {"law": "ndobc", "feedforward": True, "tip_loads": [LOAD], **HEAVY}
    plain = svsa.simulate_arm(**options)
    assert plain.fault is not None or min(measure_deg(plain)) > 5.0
    assert max(measure_deg(svsa.simulate_arm(adaptation=True, **options))) < 0.1


def test_payload_estimate_converges_to_the_mass_within_its_rate_limit():
    options = {"law": "fl", "feedforward": True, "tip_loads": [LOAD], **HEAVY}
    payload = svsa.simulate_arm(adaptation=True, **options).payload_kg
    assert abs(payload[:5000]).max() < 1e-3
    assert payload[11000:] == pytest.approx(np.full(9000, 0.3), abs=1e-3)
    assert np.abs(np.diff(payload)).max() <= 2.0 * 0.001 * (1.0 + 1e-12)
    slow = svsa.PayloadAdaptation(rate_kg_per_s=0.05)
    slower = svsa.simulate_arm(adaptation=slow, duration_s=8.0, **options).payload_kg
    assert slower[-1] == pytest.approx(0.15, abs=0.01)


def test_links_that_are_thought_too_heavy_lower_the_estimate_and_not_the_accuracy():
    """Link masses 20 % too large in the model: the estimate makes up for it."""
    wrong = build_rods((0.36, 0.3), (0.36, 0.3))
    options = {"feedforward": True, "adaptation": True, "tip_loads": [LOAD], **HEAVY}
    result = svsa.simulate_arm(law="ndobc", model=wrong, **options)
    assert result.payload_kg[9000:] == pytest.approx(np.full(11000, 0.253), abs=0.01)
    assert max(measure_deg(result)) < 0.05


def test_links_that_are_thought_too_light_cost_accuracy():
    wrong = build_rods((0.24, 0.3), (0.24, 0.3))
    options = {"feedforward": True, "adaptation": True, "tip_loads": [LOAD], **HEAVY}
    result = svsa.simulate_arm(law="ndobc", model=wrong, **options)
    assert result.payload_kg[4000] == pytest.approx(0.046, abs=0.005)
    assert 0.1 < max(measure_deg(result)) < 0.5


def test_payload_estimate_is_zero_without_adaptation():
    assert np.all(svsa.simulate_arm(duration_s=0.1).payload_kg == 0.0)


def test_run_with_payload_estimate_is_resimulated_bit_for_bit():
    """The models of the laws follow from the estimate alone."""
    options = {"adaptation": True, "feedforward": True, "tip_loads": [LOAD.changed(start_s=0.2)]}
    result = svsa.simulate_arm(**options, duration_s=0.6)
    assert svsa.resimulate(result).identical
