"""An oscillating motor is distinguished from one with the fastest reference."""

import math

import pytest

from svsa.hardware.safety.guard import Vibration

PERIOD_S = 0.001


def swing(frequency_hz: float, speed: float, duration_s: float = 2.0) -> float | None:
    """Return the time at which a sine of this speed counts as oscillation, s; None if never."""
    vibration = Vibration(PERIOD_S)
    for tick in range(round(duration_s / PERIOD_S)):
        time_s = tick * PERIOD_S
        if vibration.update(speed * math.sin(2.0 * math.pi * frequency_hz * time_s)):
            return time_s
    return None


@pytest.mark.parametrize("frequency_hz", [15.0, 40.0, 100.0])
def test_oscillation_is_detected_after_ten_reversals(frequency_hz: float) -> None:
    found = swing(frequency_hz, 5.0)
    assert found is not None
    assert found == pytest.approx(10.0 / (2.0 * frequency_hz), abs=0.5 / frequency_hz)


def test_fastest_reference_is_no_oscillation() -> None:
    assert swing(5.0, 30.0) is None


def test_small_movements_are_no_oscillation_at_any_frequency() -> None:
    assert swing(100.0, 1.9) is None


def test_new_run_starts_without_reversals() -> None:
    vibration = Vibration(PERIOD_S)
    for turn in range(10):
        assert not vibration.update(3.0 * (-1) ** turn)
    vibration.reset()
    assert not vibration.update(-3.0)
    assert not vibration.update(3.0)
