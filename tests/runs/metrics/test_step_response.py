"""Step responses with known rise time, overshoot and settling time."""

import math

import numpy as np
import pytest

from svsa.runs.metrics.step_response import StepResponse

T = 0.001


def respond(reference, output, pieces=1, is_start=False, smallest=0.1):
    """Return the response to a reference (ticks,)."""
    response = StepResponse(T, smallest)
    parts = (np.array_split(signal, pieces) for signal in (reference, reference - output))
    for number, (references, errors) in enumerate(zip(*parts, strict=True)):
        response.update(references, errors, is_start and number == 0)
    return response


def read(response):
    return response.rise_time_s, response.overshoot_share, response.settling_time_s


def build_step(output, before=100, level=2.0, start=1.0):
    """`before` ticks at the start, then the step and an output of this share of it."""
    reference = np.concatenate([np.full(before, start), np.full(len(output), level)])
    follows = start + (level - start) * output
    return reference, np.concatenate([np.full(before, start), follows])


@pytest.mark.parametrize("pieces", [1, 7, 1600])
@pytest.mark.parametrize(("start", "level"), [(1.0, 2.0), (0.3, -0.5)])
def test_first_order_response_matches_its_formulas(start, level, pieces):
    """1 − e^(−t/τ): rise time τ ln 9 = 2.197 τ, settling time τ ln 50 = 3.912 τ, no overshoot."""
    tau, t = 0.1, np.arange(1500) * T
    response = respond(*build_step(1.0 - np.exp(-t / tau), level=level, start=start), pieces)
    assert response.rise_time_s == pytest.approx(tau * math.log(9.0), abs=T)
    assert response.settling_time_s == pytest.approx(0.392)
    assert response.overshoot_share == 0.0


def test_second_order_response_matches_its_formulas():
    """Overshoot exp(−π ζ/√(1 − ζ²)) = 16.3 % at ζ = 0.5; rise time 1.639/ω (Ogata, 10-90 %)."""
    zeta, omega, t = 0.5, 20.0, np.arange(2000) * T
    damped = omega * math.sqrt(1.0 - zeta**2)
    wave = np.cos(damped * t) + zeta * omega / damped * np.sin(damped * t)
    response = respond(*build_step(1.0 - np.exp(-zeta * omega * t) * wave))
    expected = math.exp(-math.pi * zeta / math.sqrt(1.0 - zeta**2))
    assert response.overshoot_share == pytest.approx(expected, abs=1e-4)
    assert response.rise_time_s == pytest.approx(1.639 / omega, abs=T)


def test_reference_that_fades_is_a_step_including_its_fade():
    """An output that follows a smooth rise of 1 s exactly: the times are those of the rise."""
    s = np.clip((np.arange(3000) * T - 0.5) / 1.0, 0.0, 1.0)
    rise = s**5 * (126.0 + s * (-420.0 + s * (540.0 + s * (-315.0 + s * 70.0))))
    response = respond(rise, rise)
    expected = np.searchsorted(rise, 0.9) - np.searchsorted(rise, 0.1)
    assert response.rise_time_s == pytest.approx(expected * T)
    settled = (np.searchsorted(rise, 0.98) - np.searchsorted(rise, 0.0, side="right")) * T
    assert response.settling_time_s == pytest.approx(settled)
    assert response.overshoot_share == pytest.approx(0.0, abs=1e-9)


def test_initial_error_at_the_start_of_a_run_is_a_step():
    tau, t = 0.1, np.arange(1500) * T
    output, reference = 1.0 - np.exp(-t / tau), np.ones(1500)
    assert read(respond(reference, output)) == (None, None, None), "an error is not a step"
    begun = respond(reference, output, is_start=True)
    assert begun.settling_time_s == pytest.approx(0.392)
    held = respond(reference, reference - 0.05, is_start=True)
    assert read(held) == (None, None, None), "less than the smallest step"


@pytest.mark.parametrize(
    "reference",
    [
        np.full(4000, 1.0),
        np.sin(np.arange(4000) * T * 3.0),
        np.clip(np.arange(4000) * T, 1.0, 2.0),
        np.clip(np.arange(5000) * T / 3.0, 0.0, 1.0),
        np.where(np.arange(4000) < 1000, 1.0, 1.05),
        np.concatenate([np.zeros(1000), np.sin(np.arange(236) * 0.01), np.full(2000, 0.7)]),
    ],
    ids=["constant", "sine", "ramp", "slow ramp", "small", "beyond its new level"],
)
def test_other_references_have_no_step_response(reference):
    assert read(respond(reference, reference)) == (None, None, None)


def test_sine_that_fades_into_a_constant_is_no_step():
    t = np.arange(5000) * T
    weight = np.clip(t - 1.0, 0.0, 1.0)
    reference = (1.0 - weight) * np.sin(6.0 * t) + 2.0 * weight
    assert read(respond(reference, reference)) == (None, None, None)


def test_later_changes_do_not_affect_a_settled_response_and_earlier_ones_end_it():
    tau, t = 0.1, np.arange(1500) * T
    reference, output = build_step(1.0 - np.exp(-t / tau))
    settled = read(respond(reference, output))
    later = np.concatenate([reference, np.full(1000, 5.0)])
    assert read(respond(later, np.concatenate([output, np.full(1000, 9.0)]))) == settled
    cut = np.concatenate([reference[:800], np.full(1000, 5.0)])
    found = respond(cut, np.concatenate([output[:800], np.full(1000, 9.0)]))
    assert read(found) == (settled[0], 0.0, None)


def test_response_with_a_lasting_error_has_no_settling_time():
    """80 % of the step are reached: less than 90 %, so there is no rise time either."""
    tau, t = 0.1, np.arange(3000) * T
    response = respond(*build_step(0.8 * (1.0 - np.exp(-t / tau))))
    assert read(response) == (None, None, None)


def test_missed_samples_do_not_hide_a_step():
    tau, t = 0.1, np.arange(1500) * T
    reference, output = build_step(1.0 - np.exp(-t / tau))
    whole = read(respond(reference, output))
    for gap in (slice(40, 60), slice(1200, 1300)):
        missed = reference.copy()
        missed[gap] = np.nan
        assert read(respond(missed, output, pieces=9)) == whole
