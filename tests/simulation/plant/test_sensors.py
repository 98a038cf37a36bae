"""Sensors: integer counts, and noise that depends on seed, tick and channel alone."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba import njit

import svsa
from svsa.actuators.signals import State
from svsa.simulation.plant.effects import build_effect_constants
from svsa.simulation.plant.effects.encoders import Encoders, quantize
from svsa.simulation.plant.effects.noise import SensorNoise, add_noise, draw_normal, draw_uniform
from svsa.simulation.plant.sensors import read_sensors
from tests.actuators.prototype import DESIGN, IDEAL_BENCH, drawn

COUNT = 100_000
SEEDS = (0, 1, 7, 2**63 - 1)


@njit
def draw_many(seed, first, count, channels):
    """Return (count, channels) normal numbers of the ticks from `first` on."""
    drawn_numbers = np.empty((count, channels))
    for k in range(count):
        for channel in range(channels):
            drawn_numbers[k, channel] = draw_normal(seed, first + k, channel)
    return drawn_numbers


@pytest.fixture(scope="module", params=SEEDS)
def numbers(request):
    return draw_many(request.param, 0, COUNT, 3)


def build_noisy_bench(effects, seed=0):
    return build_effect_constants(effects, seed, DESIGN.actuator, 0.001)


def test_angle_is_rounded_to_the_nearest_count():
    """Half a count rounds up; negative counts are as wide as positive ones."""
    step = 0.25
    counts = {0.1: 0, 0.124: 0, 0.125: 1, 0.2: 1, -0.1: 0, -0.125: 0, -0.126: -1, 7.6: 30}
    for angle, count in counts.items():
        assert quantize(angle, step) == count * step, angle


def test_zero_step_leaves_the_angle_unchanged():
    for angle in (0.0, 1.0 / 3.0, -1e-17, 1e9):
        assert quantize(angle, 0.0) == angle


@drawn
@given(st.floats(-1e3, 1e3), st.floats(1e-6, 1.0))
def test_quantized_angle_is_an_integer_count_within_half_a_count(angle, step):
    found = quantize(angle, step)
    assert abs(found - angle) <= 0.5 * step * (1.0 + 1e-9) + 1e-12
    assert found / step == pytest.approx(round(found / step), abs=1e-6)
    assert quantize(found, step) == pytest.approx(found, abs=1e-6 * step)


def test_each_angle_is_quantized_by_its_own_encoder():
    """Both motors before their gearbox, the deflection by its own encoder; velocities are
    unchanged.
    """
    encoders = Encoders(motor_counts_per_rev=100, gear_ratio=10.0, deflection_counts_per_rev=360)
    bench = build_noisy_bench(svsa.Effects(encoders=encoders))
    x = State(q=0.5, dq=0.1, theta1=0.3, dtheta1=0.2, theta2=-0.7, dtheta2=0.3)
    y = read_sensors(bench, x, 5)
    motor, deflection = 2.0 * math.pi / 1000.0, 2.0 * math.pi / 360.0
    assert y.theta1 == round(0.3 / motor) * motor
    assert y.theta2 == round(-0.7 / motor) * motor
    assert y.phi == round(0.2 / deflection) * deflection
    assert (y.dq, y.dtheta1, y.dtheta2) == (0.1, 0.2, 0.3)


def test_measurement_without_effects_is_exact():
    x = State(0.5, 0.1, 0.3, 0.2, -0.7, 0.3)
    assert read_sensors(IDEAL_BENCH, x, 9) == (0.3, -0.7, 0.5 - 0.3, 0.1, 0.2, 0.3)


def test_noise_is_added_before_quantization():
    """A small noise appears as single counts; without the encoder it is unchanged."""
    noise = SensorNoise(motor_std_rad=1e-3, deflection_std_rad=0.0)
    x = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    counted = build_noisy_bench(svsa.Effects(noise=noise, encoders=Encoders()))
    plain = build_noisy_bench(svsa.Effects(noise=noise))
    for tick in range(1, 50):
        y, counts = read_sensors(plain, x, tick), read_sensors(counted, x, tick)
        assert y.theta1 == 1e-3 * draw_normal(0, tick, 0) != 0.0
        assert y.theta2 == 1e-3 * draw_normal(0, tick, 1) != 0.0
        assert y.phi == 0.0
        assert counts.theta1 == quantize(y.theta1, counted.encoders.motor_step)


def test_same_seed_tick_and_channel_give_the_same_number_in_any_order():
    """No state is kept between two samples, and batched calls agree with single ones."""
    where = [(tick, channel) for tick in (0, 1, 5, 70_000, 10**9) for channel in (0, 1, 2)]
    forward = {at: draw_normal(3, *at) for at in where}
    backward = {at: draw_normal(3, *at) for at in reversed(where)}
    assert forward == backward
    assert len(set(forward.values())) == len(where)
    assert draw_many(3, 5, 1, 3)[0].tolist() == [forward[5, channel] for channel in range(3)]


def test_other_seed_gives_other_numbers():
    """Neighbouring seeds as well: no number of one occurs in the other."""
    one, two = draw_many(1, 0, 2000, 3), draw_many(2, 0, 2000, 3)
    assert not np.intersect1d(one, two).size
    assert abs(np.corrcoef(one[:, 0], two[:, 0])[0, 1]) < 4.0 / math.sqrt(2000)


def test_numbers_are_standard_normal(numbers):
    """Mean, spread, skewness and kurtosis within four standard errors, and no outlier.

    With 3e5 normal numbers, one seed of 1700 has a number beyond 6.
    """
    for values in numbers.T:
        assert abs(values.mean()) < 4.0 / math.sqrt(COUNT)
        assert abs(values.std() - 1.0) < 4.0 / math.sqrt(2.0 * COUNT)
        assert abs(np.mean(values**3)) < 4.0 * math.sqrt(15.0 / COUNT)
        assert abs(np.mean(values**4) - 3.0) < 4.0 * math.sqrt(96.0 / COUNT)
    assert np.abs(numbers).max() < 6.0


def test_numbers_are_white_and_channels_independent(numbers):
    """Correlations between ticks up to 64 apart and between channels, within 4.5/√n."""
    bound = 4.5 / math.sqrt(COUNT)
    for values in numbers.T:
        for lag in (1, 2, 3, 4, 8, 16, 32, 64):
            assert abs(np.mean(values[lag:] * values[:-lag])) < bound, lag
    for one, two in ((0, 1), (0, 2), (1, 2)):
        for shift in (0, 1, 2):
            products = numbers[shift:, one] * numbers[: COUNT - shift, two]
            assert abs(products.mean()) < bound, (one, two, shift)


@drawn
@given(st.integers(0, 2**63 - 1), st.integers(0, 10**12), st.integers(0, 63))
def test_uniform_number_is_strictly_between_zero_and_one(seed, tick, channel):
    """Its logarithm is taken: zero would be an infinite radius."""
    assert 0.0 < draw_uniform(seed, tick, channel) < 1.0


def test_zero_noise_is_zero_and_other_noise_scales_with_its_deviation():
    assert add_noise(0.3, 0.0, 0, 1, 0) == 0.3
    single = add_noise(0.0, 1.0, 4, 8, 2)
    assert add_noise(0.0, 0.5, 4, 8, 2) == 0.5 * single == 0.5 * draw_normal(4, 8, 2)
