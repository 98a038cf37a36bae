"""Metrics of signals with known results."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.runs.metrics.metrics import RunningMetrics, compute_metrics
from svsa.simulation.loop.tally import STEADY_STATE_S

T = 0.001


def build_samples(ticks, **channels):
    """Build samples that are zero except in these channels."""
    samples = np.zeros((ticks, len(CHANNELS)))
    samples[:, CHANNEL_INDEX["time_s"]] = np.arange(ticks) * T
    samples[:, CHANNEL_INDEX["stiffness_reference_nm_per_rad"]] = 20.0
    for name, values in channels.items():
        samples[:, CHANNEL_INDEX[name]] = values
    return samples


def test_sine_has_its_known_rms_and_peak():
    """A sine of amplitude 3 over whole periods: rms 3/√2, peak 3."""
    t = np.arange(2000) * T
    wave = 3.0 * np.sin(2.0 * np.pi * 5.0 * t)
    metrics = compute_metrics(build_samples(2000, position_error_rad=wave), T)
    assert metrics.duration_s == pytest.approx(2.0)
    assert metrics.rms_position_error_rad == pytest.approx(3.0 / np.sqrt(2.0), rel=1e-12)
    assert metrics.peak_position_error_rad == pytest.approx(3.0, rel=1e-12)
    assert metrics.rms_stiffness_error_nm_per_rad == 0.0


def test_each_metric_reads_its_own_channel_and_ignores_the_sign():
    samples = build_samples(
        100,
        position_error_rad=-1.0,
        stiffness_error_nm_per_rad=-2.0,
        torque1_nm=-3.0,
        torque2_nm=-4.0,
    )
    metrics = compute_metrics(samples, T)
    assert metrics.rms_position_error_rad == metrics.peak_position_error_rad == 1.0
    assert metrics.rms_stiffness_error_nm_per_rad == 2.0
    assert metrics.peak_stiffness_error_nm_per_rad == 2.0
    assert (metrics.peak_torque1_nm, metrics.peak_torque2_nm) == (3.0, 4.0)
    assert metrics.peak_stiffness_error_share == 2.0 / 20.0
    assert metrics.integral_stiffness_error_nms_per_rad == pytest.approx(2.0 * 0.1)
    assert (metrics.rms_torque1_nm, metrics.rms_torque2_nm) == pytest.approx((3.0, 4.0))
    assert metrics.integral_position_error_rad_s == pytest.approx(1.0 * 0.1)
    assert metrics.effort_n2m2_s == pytest.approx((9.0 + 16.0) * 0.1)


def test_sines_have_their_known_integral_and_effort():
    """∫|3 sin| over whole periods is 6/π per second, ∫(2 sin)² + (2 cos)² is 4 per second."""
    angle = 2.0 * np.pi * 5.0 * np.arange(2000) * T
    samples = build_samples(
        2000,
        position_error_rad=3.0 * np.sin(angle),
        torque1_nm=2.0 * np.sin(angle),
        torque2_nm=2.0 * np.cos(angle),
    )
    metrics = compute_metrics(samples, T)
    assert metrics.integral_position_error_rad_s == pytest.approx(2.0 * 6.0 / np.pi, rel=1e-3)
    assert metrics.effort_n2m2_s == pytest.approx(2.0 * 4.0, rel=1e-12)


def test_decaying_error_has_its_known_recovery_time():
    """e^(−10 t) decreases to 2 % at ln(50)/10 = 0.3912 s: the first sample inside is at 0.392."""
    error = np.exp(-10.0 * np.arange(1000) * T)
    metrics = compute_metrics(build_samples(1000, position_error_rad=error), T)
    assert metrics.recovery_time_s == pytest.approx(0.392)


def test_recovery_time_is_from_the_start_to_the_last_time_outside():
    """A second excursion cancels the first recovery; 2 % is of the highest peak."""
    error = np.zeros(2000)
    error[100:200] = 1.0
    error[600:650] = -0.021
    error[700:710] = 0.019
    metrics = compute_metrics(build_samples(2000, position_error_rad=error), T)
    assert metrics.recovery_time_s == pytest.approx(0.65)


def test_lasting_error_has_no_recovery_time():
    """FL under a load: the error never recovers, and there is no number."""
    metrics = compute_metrics(build_samples(3000, position_error_rad=0.2), T)
    assert metrics.recovery_time_s is None


def test_recovery_needs_half_a_second_inside():
    """An error that has just entered the band may leave it again."""
    late = np.zeros(1000)
    inside = round(STEADY_STATE_S / T)
    late[: 1000 - inside + 1] = 1.0
    assert compute_metrics(build_samples(1000, position_error_rad=late), T).recovery_time_s is None
    late[1000 - inside] = 0.0
    found = compute_metrics(build_samples(1000, position_error_rad=late), T).recovery_time_s
    assert found == pytest.approx(0.5)


def test_zero_error_has_zero_recovery_time():
    assert compute_metrics(build_samples(1000), T).recovery_time_s == 0.0


def test_empty_samples_have_no_metrics():
    running = RunningMetrics(T)
    running.update(np.zeros((0, len(CHANNELS))))
    assert running.summarize() is None


def test_missed_ticks_are_in_no_sum_and_no_peak_but_count_as_time():
    t = np.arange(2000) * T
    wave = 3.0 * np.sin(2.0 * np.pi * 5.0 * t)
    samples = build_samples(2000, position_error_rad=wave, torque1_nm=2.0)
    samples[700:720] = np.nan
    whole, known = compute_metrics(samples, T), np.delete(samples, np.s_[700:720], axis=0)
    expected = vars(compute_metrics(known, T)) | {"duration_s": 2.0}
    assert vars(whole) == pytest.approx(expected)
    assert vars(whole)["steady_state_position_error_rad"] == pytest.approx(3.0 / np.sqrt(2.0))


@pytest.mark.parametrize(("missed", "recovered_s"), [((300, 320), 0.2), ((190, 220), 0.22)])
def test_missed_ticks_neither_end_nor_start_a_recovery(missed, recovered_s):
    """Inside before and after a gap: inside. Outside before it: outside until a sample is
    inside.
    """
    error = np.where(np.arange(1500) < 200, 1.0, 0.001)
    samples = build_samples(1500, position_error_rad=error)
    samples[slice(*missed)] = np.nan
    running = RunningMetrics(T)
    for rows in np.array_split(samples, [1, 195, 310, 600]):
        running.update(rows)
    found = running.summarize()
    assert found is not None
    assert found.recovery_time_s == pytest.approx(recovered_s)
    assert vars(found) == pytest.approx(vars(compute_metrics(samples, T)))


@pytest.mark.parametrize("known", [0, 1000])
def test_ended_lane_has_no_metrics(known):
    """A twin beyond its deflection limit has no metrics after it: the window is incomplete."""
    samples = build_samples(2000, position_error_rad=1.0)
    samples[known:] = np.nan
    metrics = compute_metrics(samples, T)
    assert np.isnan([metrics.rms_position_error_rad, metrics.peak_torque1_nm]).all()
    assert np.isnan([metrics.integral_position_error_rad_s, metrics.effort_n2m2_s]).all()


@settings(derandomize=True, max_examples=40, deadline=None)
@given(st.lists(st.integers(0, 400), max_size=12), st.floats(0.0, 30.0))
def test_metrics_of_segments_are_those_of_the_complete_signal(cuts, rate):
    """A session updates at every wake-up: their times must not change the metrics."""
    t = np.arange(1500) * T
    error = np.exp(-rate * t) * np.sin(40.0 * t)
    step = 20.0 + 5.0 * np.clip(t - 0.2, 0.0, 0.1)
    samples = build_samples(
        1500,
        position_error_rad=error,
        stiffness_error_nm_per_rad=5.0 * error,
        stiffness_reference_nm_per_rad=step,
        torque1_nm=t,
    )
    whole = compute_metrics(samples, T)
    running, edges = RunningMetrics(T), np.minimum(np.cumsum([0, *cuts]), 1500)
    for start, end in zip(edges, [*edges[1:], 1500], strict=True):
        running.update(samples[start:end])
    assert running.summarize() == whole


def test_steady_state_error_is_that_of_the_end_for_any_segments():
    """4 for 2 s, then 3 sin over whole periods for the last 0.5 s: 3/√2; none below 1 s."""
    t = np.arange(500) * T
    errors = np.concatenate([np.full(2000, 4.0), 3.0 * np.sin(2.0 * np.pi * 10.0 * t)])
    samples = build_samples(2500, position_error_rad=errors)
    running = RunningMetrics(T)
    for rows in np.array_split(samples, [1, 990, 2004, 2490]):
        running.update(rows)
    assert running.summarize() == compute_metrics(samples, T)
    settled = running.summarize().steady_state_position_error_rad
    assert settled == pytest.approx(3.0 / np.sqrt(2.0), rel=1e-12)
    assert compute_metrics(samples[:999], T).steady_state_position_error_rad is None
    assert compute_metrics(samples[:1000], T).steady_state_position_error_rad == pytest.approx(4.0)


def test_triangle_torques_have_their_known_variation_work_and_rms():
    """A triangle of 1 N·m with a period of 0.2 s varies by 10 N·m/s; its rms is 1/√3."""
    t = np.arange(2001) * T
    triangle = np.abs((t / 0.2 + 0.5) % 1.0 - 0.5) * 2.0
    samples = build_samples(
        2001,
        torque1_nm=triangle,
        torque2_nm=-2.0 * triangle,
        motor1_velocity_rad_per_s=-3.0,
        motor2_velocity_rad_per_s=1.0,
    )
    found = compute_metrics(samples, T)
    assert found.torque1_variation_nm_per_s == pytest.approx(10.0, rel=1e-3)
    assert found.torque2_variation_nm_per_s == pytest.approx(20.0, rel=1e-3)
    assert found.rms_torque1_nm == pytest.approx(1.0 / np.sqrt(3.0), rel=1e-3)
    assert found.work_j == pytest.approx((3.0 * 0.5 + 1.0 * 1.0) * 2.0, rel=1e-3)


def test_torque_noise_is_that_at_rest():
    """A sine of 0.3 N·m about a constant torque: 0.3/√2; none during motion."""
    t = np.arange(500) * T
    noise = {
        "torque1_nm": 2.0 + 0.3 * np.sin(2.0 * np.pi * 50.0 * t),
        "torque2_nm": 0.1 * np.sin(2.0 * np.pi * 50.0 * t),
    }
    found = compute_metrics(build_samples(500, **noise), T)
    assert found.torque1_noise_nm == pytest.approx(0.3 / np.sqrt(2.0))
    assert found.torque2_noise_nm == pytest.approx(0.1 / np.sqrt(2.0))
    for moving in (
        {"position_reference_rad": t},
        {"stiffness_reference_nm_per_rad": 20.0 + t},
        {"position_error_rad": np.linspace(0.0, np.radians(0.11), 500)},
    ):
        assert compute_metrics(build_samples(500, **noise, **moving), T).torque1_noise_nm is None
    short = compute_metrics(build_samples(500, **noise)[:499], T)
    assert short.torque1_noise_nm is None


def test_stiffness_has_the_metrics_of_the_position():
    """e^(−10 t) N·m/rad: within 2 % from 0.392 s on; below 0.01 N·m/rad there is no deviation."""
    error = np.exp(-10.0 * np.arange(1500) * T)
    found = compute_metrics(build_samples(1500, stiffness_error_nm_per_rad=error), T)
    assert found.stiffness_recovery_time_s == pytest.approx(0.392)
    assert found.integral_stiffness_error_nms_per_rad == pytest.approx(0.1, rel=0.01)
    small = compute_metrics(build_samples(1500, stiffness_error_nm_per_rad=0.009 * error), T)
    assert small.stiffness_recovery_time_s is None
    constant = compute_metrics(build_samples(1000, stiffness_error_nm_per_rad=-0.4), T)
    assert constant.steady_state_stiffness_error_nm_per_rad == pytest.approx(0.4)
    assert constant.stiffness_recovery_time_s is None


def test_step_of_either_reference_has_a_step_response():
    tau, t = 0.1, np.arange(1500) * T
    left = np.exp(-t / tau)
    samples = build_samples(
        1500,
        position_reference_rad=0.5,
        position_error_rad=0.5 * left,
        stiffness_error_nm_per_rad=10.0 * left,
    )
    found = compute_metrics(samples, T)
    rise = pytest.approx(tau * np.log(9.0), abs=T)
    assert (found.rise_time_s, found.stiffness_rise_time_s) == (rise, rise)
    assert (found.overshoot_share, found.stiffness_overshoot_share) == (0.0, 0.0)
    assert found.settling_time_s == found.stiffness_settling_time_s == pytest.approx(0.392)
    samples[:, CHANNEL_INDEX["time_s"]] += 3.0
    later = compute_metrics(samples, T)
    assert (later.rise_time_s, later.stiffness_settling_time_s) == (None, None), "no step of q_d"
