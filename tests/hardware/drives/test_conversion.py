"""Integers of the drives ↔ SI: numbers of the manufacturer by hand, and counters that wrap."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from svsa.hardware.bench.settings import DeflectionSettings, MotorSettings
from svsa.hardware.drives.conversion import (
    Unwrapped,
    build_deflection_scale,
    build_motor_scale,
    compute_current_ma,
)

MOTOR = MotorSettings(
    counts_per_rev=2000,
    gear_ratio=50.0,
    torque_constant_nm_per_a=0.0396,
    efficiency=0.9,
    sign=1,
    nominal_current_a=9.0,
    peak_current_a=12.0,
    thermal_time_s=30.0,
    speed_max_rad_per_s=20.0,
    position_min_rad=-2.5,
    position_max_rad=2.5,
)


def test_torque_is_converted_to_current() -> None:
    """I = 1000 τ / (N η K_t): 1.782 N·m at 50 : 1, 90 %, 39.6 mN·m/A is one ampere."""
    scale = build_motor_scale(MOTOR)
    assert compute_current_ma(1.782, scale) == 1000
    assert compute_current_ma(-1.782, scale) == -1000
    assert compute_current_ma(0.0, scale) == 0
    assert scale.torque_per_ma == pytest.approx(1.782e-3)


def test_count_is_a_share_of_a_motor_turn_behind_the_gearbox() -> None:
    assert build_motor_scale(MOTOR).angle_per_count * 2000 * 50 == pytest.approx(2.0 * math.pi)


def test_sign_inverts_torque_and_angle_together() -> None:
    plain, turned = build_motor_scale(MOTOR), build_motor_scale(MOTOR.changed(sign=-1))
    assert turned == (-plain.torque_per_ma, -plain.angle_per_count)
    assert compute_current_ma(1.782, turned) == -1000


@given(torque=st.floats(-15.0, 15.0))
def test_rounding_error_is_at_most_half_a_milliampere(torque: float) -> None:
    scale = build_motor_scale(MOTOR)
    sent = compute_current_ma(torque, scale) * scale.torque_per_ma
    assert abs(sent - torque) <= 0.5000001 * scale.torque_per_ma


def test_deflection_count_is_a_share_of_a_turn_with_its_sign() -> None:
    settings = DeflectionSettings(source="can", counts_per_rev=8000, sign=-1)
    assert build_deflection_scale(settings) * 8000 == pytest.approx(-2.0 * math.pi)


@given(
    bits=st.sampled_from([16, 24, 32]),
    start=st.integers(-(2**31), 2**31 - 1),
    steps=st.lists(st.integers(-(2**15) + 1, 2**15 - 1), max_size=50),
)
def test_wrapped_counter_continues(bits: int, start: int, steps: list[int]) -> None:
    """Steps of less than half the counter's range are never ambiguous, over any distance."""
    unwrapped, true = Unwrapped(bits, start), start
    for step in steps:
        true += step
        raw = (true + (1 << bits - 1)) % (1 << bits) - (1 << bits - 1)
        assert unwrapped.update(raw) == true


def test_first_reading_is_the_nearest_to_the_start() -> None:
    """A 16-bit encoder whose zero is next to its wrap: −32 760 is 8 counts after 32 768."""
    unwrapped = Unwrapped(16, 32_760)
    assert unwrapped.update(-32_760) == 32_776
    unwrapped.reset()
    assert unwrapped.update(32_750) == 32_750
