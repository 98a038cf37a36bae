"""A law in a separate process computes the same as in this one, and its faults have names."""

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

import svsa
from svsa.actuators.dynamics import build_actuator
from svsa.runs.execution.blocks import compute_start_ratio
from svsa.teaching.isolation import confinement, system_calls
from svsa.teaching.isolation.confinement import Bounds, confine, leave_open
from svsa.teaching.isolation.probe import check_isolation
from svsa.teaching.isolation.process import LawProcess
from svsa.teaching.isolation.refusal import LawFaultError, NotIsolatedError, describe_output
from tests.teaching.isolation.attackers import MODEL, REPORTED
from tests.teaching.isolation.test_attacks import isolation  # noqa: F401

ROOT = Path(__file__).parents[3]
FIGURE = svsa.paper.get_figure("4a").build_configuration()
FEEDBACK_LINEARIZATION = b"""
from svsa.actuators.linearization import compute_linearization, solve_decoupling

def build(model):
    def law(time_s, reference, x, w):
        now = compute_linearization(model, x)
        error = (reference.q - now.q, reference.dq - now.dq, reference.ddq - now.ddq,
                 reference.dddq - now.dddq)
        gains = (60.0**4, 4 * 60.0**3, 6 * 60.0**2, 4 * 60.0)
        y1 = reference.ddddq - now.ddddq + sum(g * e for g, e in zip(gains, error))
        y2 = (reference.ddsigma - now.ddsigma + 40.0**2 * (reference.sigma - now.sigma)
              + 2 * 40.0 * (reference.dsigma - now.dsigma))
        return tuple(solve_decoupling(now, y1, y2))
    return law
"""


def run(source, duration_s=0.5, place=confine, **changes):
    model = build_actuator(FIGURE.nominal, compute_start_ratio(FIGURE))
    with LawProcess(source, model, place=place) as law:
        result = svsa.simulate(FIGURE, law, duration_s=duration_s, **changes)
    return result, law.cost_s


@pytest.mark.parametrize("place", [confine, leave_open])
def test_law_file_of_the_paper_equals_the_law_of_the_lab(place):
    """With the equations as plain Python, which differ in the last digits."""
    result, cost_s = run(FEEDBACK_LINEARIZATION, place=place)
    fl = svsa.simulate(FIGURE, "fl", duration_s=0.5)
    assert result.fault is None
    assert len(cost_s) == len(result.samples) == 500
    assert min(cost_s) > 0.0
    np.testing.assert_allclose(result.position_rad, fl.position_rad, atol=1e-9)
    np.testing.assert_allclose(result.torque1_nm, fl.torque1_nm, atol=1e-6)


def test_law_may_use_numpy_keep_state_and_write_into_its_folder():
    source = b"""
import numpy as np
seen = []
def law(time_s, reference, x, w):
    seen.append(time_s)
    with open("notes", "w") as file:
        file.write(str(len(seen)))
    return np.array([len(seen), float(open("notes").read())])
"""
    with LawProcess(source, MODEL) as law:
        assert [law(0.0, *REPORTED) for _ in range(3)] == [(1, 1), (2, 2), (3, 3)]


def test_law_without_numpy_starts_without_it():
    """numpy took most of the start, and a law is started for each of its trials."""
    source = b"import sys\ndef law(*given): return float('numpy' in sys.modules), 1.0"
    with LawProcess(source, MODEL) as law:
        assert law(0.0, *REPORTED) == (0.0, 1.0)


def test_every_run_starts_in_an_empty_folder():
    source = b"import os\nopen('left', 'w').close()\ndef law(*given): return len(os.listdir()), 0"
    for _ in range(2):
        with LawProcess(source, MODEL) as law:
            assert law(0.0, *REPORTED) == (1, 0)


@pytest.mark.parametrize(
    ("source", "reported"),
    [
        (b"def law(:", "SyntaxError"),
        (b"x = 1", "law.py must define law"),
        (b"law = 3", "law.py must define law"),
        (b"\xff\xfe", "UnicodeDecodeError"),
        (b"def law(*given): return None", "two torques (u1, u2) in N·m, not None"),
        (b"def law(*given): return 1.0", "two torques (u1, u2) in N·m, not 1.0"),
        (b"def law(*given): return 1, 2, 3", "two torques (u1, u2) in N·m, not (1, 2, 3)"),
        (b"def law(*given): return 'a', 'b'", "two torques (u1, u2) in N·m, not ('a', 'b')"),
        (b"def law(*given):\n    return 1 / 0", 'File "law.py", line 2'),
        (b"import json\njson.loads('x')", "/json/__init__.py"),
    ],
)
def test_invalid_law_is_reported_with_the_error_of_python(source, reported):
    with pytest.raises(LawFaultError) as raised:
        run(source)
    assert raised.value.code == "error"
    assert reported in raised.value.output
    assert sys.base_prefix not in raised.value.output


def test_large_torques_are_limited_and_nan_ends_the_run():
    result, _ = run(b"def law(*given): return 1e308, -1e308", 0.003, effects=svsa.RIG)
    assert 0.0 < abs(result.torque1_nm).max() < 1e3
    assert np.isfinite(result.samples).all()
    result, _ = run(b"def law(*given): return float('nan'), 0.0")
    assert result.fault is not None
    assert result.fault.code == "not_finite"


@pytest.mark.parametrize(
    ("bounds", "reported"),
    [
        (Bounds(answer_s=0.2), "did not answer within 0.2 s"),
        (Bounds(answer_s=9.0, whole_s=0.5), "took more than 0.5 s"),
    ],
)
def test_law_that_hangs_reaches_its_time_limit(bounds, reported):
    with (
        pytest.raises(LawFaultError, match=reported),
        LawProcess(b"def law(*given):\n    while True: pass\n", MODEL, bounds, leave_open) as law,
    ):
        svsa.simulate(FIGURE, law, duration_s=0.5)


def test_machine_without_the_tools_reports_missing_isolation(monkeypatch):
    """And the law does not run at all."""
    check_isolation.cache_clear()
    with monkeypatch.context() as patched:
        patched.setattr(shutil, "which", lambda name: None)
        with pytest.raises(NotIsolatedError, match="bwrap is not installed"):
            check_isolation()
    with monkeypatch.context() as patched:
        patched.setattr(confinement.sys, "platform", "darwin")
        with pytest.raises(NotIsolatedError, match="it runs darwin"):
            check_isolation()
    check_isolation()


def test_sandbox_with_a_gap_is_rejected(monkeypatch):
    """The probe tests the restrictions: here the filter permits sockets."""
    check_isolation.cache_clear()
    system_calls.compile_filter.cache_clear()
    with monkeypatch.context() as patched:
        patched.setattr(system_calls, "ALLOWED", (*system_calls.ALLOWED, "socket"))
        with pytest.raises(NotIsolatedError, match="1 of 6 attempts to escape succeeded"):
            check_isolation()
    system_calls.compile_filter.cache_clear()
    check_isolation.cache_clear()
    check_isolation()


def test_sandbox_that_does_not_start_is_rejected(monkeypatch, tmp_path):
    """As bwrap ends in a container that forbids namespaces."""
    fake = tmp_path / "bwrap"
    fake.write_text("#!/bin/sh\necho 'bwrap: No permissions to create new namespace' >&2\nexit 1\n")
    fake.chmod(0o755)
    check_isolation.cache_clear()
    with monkeypatch.context() as patched:
        patched.setattr(confinement.shutil, "which", lambda name: str(fake))
        with pytest.raises(NotIsolatedError, match="No permissions to create new namespace"):
            check_isolation()
    check_isolation.cache_clear()


def test_output_of_a_failed_law_is_described():
    with pytest.raises(LawFaultError) as raised:
        run(b"def inner(): return spring\n\ndef law(*given):\n    print('x')\n    return inner()")
    assert "child.py" not in raised.value.output
    described = describe_output(raised.value.output)
    assert described.startswith("\nThe law printed:\nx\nTraceback")
    assert 'File "law.py", line 1, in inner' in described
    assert described.endswith("NameError: name 'spring' is not defined")
    assert describe_output("only this\n") == "\nThe law printed:\nonly this"
    assert describe_output(" \n") == ""


def test_output_of_a_killed_law_is_kept():
    endless = b"def law(*given):\n    print('here')\n    while True: pass\n"
    with (
        LawProcess(endless, MODEL) as law,
        pytest.raises(LawFaultError, match="did not answer") as raised,
    ):
        law(0.0, *REPORTED)
    assert raised.value.output == "here\n"


def test_law_process_counts_its_answers():
    with LawProcess(b"def law(time_s, *others): return time_s, 2.0", MODEL) as law:
        given = [law(number, *REPORTED) for number in (1.0, 3.0)]
        assert law.torques == given == [(1.0, 2.0), (3.0, 2.0)]


def test_example_of_the_leaderboard_follows_the_reference():
    source = (ROOT / "frontend/web/src/teaching/leaderboard/example.py").read_bytes()
    result, _ = run(source)
    assert result.fault is None
    assert np.degrees(abs(result.position_error_rad[-1])) < 0.05, "poles at -45 rad/s for 0.5 s"
    assert np.abs(result.stiffness_error_nm_per_rad).max() < 0.05
