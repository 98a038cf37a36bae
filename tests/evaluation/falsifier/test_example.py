"""The scenario in the package was found by a search; a saved one of its name takes its place."""

import pytest

from svsa.evaluation.falsifier.falsification import falsify
from svsa.evaluation.falsifier.file import (
    EXAMPLES,
    forget_scenario,
    is_example,
    keep_scenario,
    list_scenarios,
    open_scenario,
    read_adversary,
)
from svsa.evaluation.falsifier.measure import run_scenario

pytestmark = pytest.mark.long

NAME = "impulse-ndobc"


@pytest.fixture(autouse=True)
def empty_data(monkeypatch, tmp_path):
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))


def test_example_scenario_ends_ndobc_in_the_stated_fault_and_fl_has_none():
    ((name, example),) = list_scenarios(EXAMPLES).items()
    assert (name, example) == (NAME, open_scenario(NAME))
    assert example.found is not None
    assert example.found.adversary == read_adversary("impulse").title
    ended, held = run_scenario(example, (example.found.law, "fl"))
    assert (ended.fault, held.fault) == ("deflection_limit", None)
    assert example.found.outcome == "Deflection too large"


@pytest.mark.exhaustive
def test_search_finds_the_fault_of_the_example():
    found = falsify(read_adversary("impulse"), runs=20_000, seed=0).scenario
    example = open_scenario(NAME)
    assert found.found is not None and example.found is not None
    assert found.found.outcome == example.found.outcome
    assert found.base == example.base


def test_saved_scenario_replaces_the_example_of_the_same_name_until_it_is_deleted():
    assert is_example(NAME)
    assert not forget_scenario(NAME)
    own = open_scenario(NAME).model_copy(update={"title": "Mine"})
    keep_scenario(NAME, own)
    assert (open_scenario(NAME).title, is_example(NAME)) == ("Mine", False)
    assert list(list_scenarios()) == [NAME]
    assert forget_scenario(NAME)
    assert is_example(NAME)
