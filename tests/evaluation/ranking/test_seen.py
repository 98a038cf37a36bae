"""A run of the ranking is shown whole: what is beside it never ends it early."""

import numpy as np
import pytest

from svsa.control.installed import get_title
from svsa.evaluation.ranking.measure import Entry, run_scenario
from svsa.evaluation.ranking.single_run import build_seen, find_scenario
from svsa.runs.result.simulate import simulate


@pytest.mark.parametrize(
    ("law", "scenario", "laws"),
    [
        ("fl", "rig_4a", ["fl", "ndobc"]),
        ("fl", "load_removal", ["fl"]),
        ("ndobc", "load_removal", ["ndobc", "fl"]),
    ],
)
def test_a_run_is_shown_to_its_own_end_with_its_own_samples(law, scenario, laws):
    found = find_scenario(scenario)
    shown, alone = build_seen(found, law)
    assert [lane.law for lane in shown.lanes] == laws
    result = simulate(shown, duration_s=found.duration_s)
    measured = run_scenario(found, Entry(law))
    np.testing.assert_array_equal(result.samples, measured.samples)
    assert bool(alone) == (len(laws) == 1)


def test_why_a_law_is_alone_is_told_with_the_others_end():
    found = find_scenario("load_removal")
    fault = run_scenario(found, Entry("ndobc")).fault
    assert fault is not None
    alone = build_seen(found, "fl").alone
    assert f"“{found.title}” nothing was put beside {get_title('fl')}:" in alone
    assert alone.endswith(f"NDOBC: {fault.message}")
