"""Points of a law: trials are added until the interval is narrow, each with its own law process."""

import numpy as np
import pytest

from svsa.evaluation.ranking.test_set import build_test_trial
from svsa.teaching.grading import law_points
from svsa.teaching.grading.law_points import Trials, judge_law, run_trials
from svsa.teaching.grading.law_runs import run_law
from svsa.teaching.isolation.confinement import leave_open
from tests.teaching.grading.submissions import GOOD

pytestmark = pytest.mark.long

SEED = 11

COUNTS = b"""
answers = 0
def law(time_s, *others):
    global answers
    answers += 1
    assert answers == round(1000 * time_s) + 1, "another run's"
    return 0.0, 0.0
"""


def test_interval_of_the_points_is_that_of_their_mean():
    """Three of four trials have all points, one none: s = 10 √(3/16 · 4/3) = 5."""
    trials = Trials(np.array([True, True, True, False]), np.array([0.0, 0.0, 0.0, np.nan]))
    assert trials.estimate_range() == pytest.approx(2 * 1.959964 * 5.0 / 2.0)
    points = [one.points for one in judge_law(trials)]
    assert points == pytest.approx([1.5, 3.75, 2.25])


@pytest.mark.exhaustive
def test_trials_of_a_group_equal_single_runs(monkeypatch):
    monkeypatch.setattr(law_points, "BLOCK", 8)
    monkeypatch.setattr(law_points, "MOST_TRIALS", 8)
    found = run_trials(GOOD, SEED, leave_open)
    for number in range(2):
        alone = run_law(GOOD, build_test_trial("A", SEED, number), place=leave_open)
        assert found.held[number] == alone.held
        assert found.rms_deg[number] == pytest.approx(alone.rms_deg, rel=1e-9)


@pytest.mark.parametrize(("width", "blocks"), [(0.2, 1), (0.14, 2), (0.0, 3)])
def test_blocks_are_added_until_the_interval_is_narrow(monkeypatch, width, blocks):
    """The width decreases with the trials: 0.16 after one block of these, 0.11 after two."""
    monkeypatch.setattr(law_points, "MOST_TRIALS", 3 * law_points.BLOCK)
    monkeypatch.setattr(law_points, "POINTS_RANGE", width)
    rms = np.full(law_points.BLOCK, 0.5)
    rms[::2] = 0.2
    block = Trials(np.ones(law_points.BLOCK, dtype=bool), rms)
    monkeypatch.setattr(law_points, "_run_block", lambda *given: (block, False))
    shares: list[float] = []
    found = run_trials(b"", SEED, leave_open, shares.append)
    assert len(found.held) == blocks * law_points.BLOCK
    assert len(shares) == (blocks if width == 0.0 else blocks - 1)


def test_each_run_has_its_own_law_process(monkeypatch):
    monkeypatch.setattr(law_points, "BLOCK", 8)
    monkeypatch.setattr(law_points, "MOST_TRIALS", 8)
    assert run_trials(COUNTS, SEED, leave_open).output == ""


def test_output_of_a_law_is_shown_if_a_run_ended_early(monkeypatch):
    """The largest torques end every run; a law that completes all runs shows no output."""
    monkeypatch.setattr(law_points, "BLOCK", 8)
    monkeypatch.setattr(law_points, "MOST_TRIALS", 8)
    wild = b"print('built')\ndef law(*given):\n    return 1e3, 1e3\n"
    found = run_trials(wild, SEED, leave_open)
    assert np.isnan(found.rms_deg).all()
    assert "built" in judge_law(found)[0].feedback
    assert "μ" in found.problem or "φ" in found.problem


def test_law_that_fails_in_one_run_has_no_points_for_the_block(monkeypatch):
    monkeypatch.setattr(law_points, "BLOCK", 8)
    late = (
        b"def law(time_s, reference, x, w):\n    return (0.0, 0.0) if abs(x.q) < 0.5 else spring\n"
    )
    found = run_trials(late, SEED, leave_open)
    assert not found.held.any()
    assert np.isnan(found.rms_deg).all()
    assert "NameError: name 'spring' is not defined" in judge_law(found)[0].feedback
