"""A law is tested before its submission, in isolation, and its result is reported."""

import pytest

from svsa.teaching.grading import law_runs
from svsa.teaching.grading.law_runs import LawRun
from svsa.teaching.grading.law_trial import judge_trial, try_law
from svsa.teaching.isolation import confinement
from svsa.teaching.isolation.probe import check_isolation
from tests.teaching.course.runs import find_exercise
from tests.teaching.course.student import find_law
from tests.teaching.grading.submissions import LAZY
from tests.teaching.isolation.test_attacks import isolation  # noqa: F401

WHOLE = LawRun("trial_0", True, 0.2, cost_us=24.0)


def test_initial_law_of_the_exercise_succeeds():
    found = try_law(find_law(find_exercise("own-law")))
    assert found.verdict == "held"
    assert "The run held" in found.feedback


@pytest.mark.parametrize(
    ("text", "verdict", "reported"),
    [
        ("def law(:", "failed", "SyntaxError"),
        ("def law(*given): return 1 / 0", "failed", "ZeroDivisionError"),
        ("import socket; socket.socket()", "failed", "PermissionError"),
    ],
)
def test_failed_law_gets_its_output(text, verdict, reported):
    found = try_law(text)
    assert found.verdict == verdict
    assert found.text == text
    assert reported in found.output


def test_run_that_ends_in_a_fault_keeps_the_output_of_its_law():
    found = try_law("def law(*given):\n    print('far')\n    return 9.0, 9.0\n")
    assert found.verdict == "ended"
    assert found.output.endswith("far\n")


def test_run_is_assessed_by_its_duration():
    assert try_law(LAZY.decode()).verdict in ("ran", "ended")
    assert judge_trial("", WHOLE).verdict == "held"
    assert judge_trial("", WHOLE._replace(held=False)).verdict == "ran"
    ended = judge_trial("", WHOLE._replace(rms_deg=None, held=False, problem="Too far."))
    assert ended.verdict == "ended"
    assert "Too far." in ended.feedback


def test_law_without_isolation_is_stored_untested(monkeypatch):
    def fail(*given, **named):
        raise AssertionError("it ran")

    check_isolation.cache_clear()
    with monkeypatch.context() as patched:
        patched.setattr(confinement.shutil, "which", lambda name: None)
        patched.setattr(law_runs, "LawProcess", fail)
        found = try_law(LAZY.decode())
    check_isolation.cache_clear()
    assert found.verdict == "untried"
    assert "cannot be isolated" in found.feedback
