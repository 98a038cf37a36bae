"""Metrics of runs and the success criterion of a trial, compared with values computed by hand."""

import numpy as np
import pytest

import svsa
from svsa.evaluation.metrics import compute_metrics, find_held, summarize_result
from svsa.simulation.loop.tally import SUMMARY

BEGIN_S, END_S, T = 0.4, 1.6, 1e-3


def test_stiffness_effort_and_final_metrics_match_the_samples():
    load = svsa.ConstantLoad(torque_nm=(1.0, 0.5, 0.2), start_s=0.6)
    run = svsa.simulate("4a", "ndobc", duration_s=END_S, loads=(load,), effects=svsa.RIG)
    summary = summarize_result(run, BEGIN_S, END_S)
    found = {name: one[0] for name, one in compute_metrics(summary, np.array([T]), BEGIN_S).items()}
    rows = slice(round(BEGIN_S / T), None)
    e, s = run.position_error_rad[rows], np.abs(run.stiffness_error_nm_per_rad[rows])
    share = s / run.stiffness_reference_nm_per_rad[rows]
    u1, u2 = run.torque1_nm[rows], run.torque2_nm[rows]
    power = np.abs(u1 * run.motor1_velocity_rad_per_s[rows])
    power += np.abs(u2 * run.motor2_velocity_rad_per_s[rows])
    expected = {
        "peak_stiffness_error_share": share.max(),
        "steady_state_stiffness_error_nm_per_rad": np.sqrt(np.mean(s[-500:] ** 2)),
        "rms_torque1_nm": np.sqrt(np.mean(u1**2)),
        "work_j": power.sum() * T,
        "torque1_variation_nm_per_s": np.abs(np.diff(u1)).sum() / (END_S - BEGIN_S),
    }
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=1e-9), name
    assert summary["position_last_peak"] == pytest.approx(np.abs(e[-1000:]).max(), rel=1e-9)
    assert summary["share_last_peak"] == pytest.approx(share[-1000:].max(), rel=1e-9)


@pytest.mark.parametrize(
    ("name", "value", "holds"),
    [
        ("code", 0, True),
        ("code", 1, False),
        ("position_last_peak", np.radians(1.0), True),
        ("position_last_peak", np.radians(1.01), False),
        ("share_last_peak", 0.1, True),
        ("share_last_peak", 0.101, False),
        ("position_peak", np.radians(30.0), True),
        ("position_peak", np.radians(30.1), False),
    ],
)
def test_trial_succeeds_by_position_stiffness_and_peak(name, value, holds):
    summary = np.zeros(1, dtype=SUMMARY)
    summary[name] = value
    assert find_held(summary)[0] == holds
