"""All readers of a run compute the same configuration from its changes."""

import functools
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

import svsa
from svsa.runs.definition.command import Set, build_command, fold, is_held, read_command
from svsa.runs.execution.run import Run
from svsa.runs.records.acting import SETTINGS, read_acting
from svsa.runs.session.journal import Journal
from svsa.runs.timeline.timeline import read_timeline
from tests.runs.records.test_run_settings import build_header
from tests.runs.session.scripts import commands, scripted
from tests.runs.session.sessions import build_configuration

TWIN = svsa.Lane(law="ndobc")
MAX_GAP = 5
changes = st.lists(st.tuples(st.integers(0, MAX_GAP), commands), min_size=1, max_size=12)


class TwinnedRun(Run):
    """A run whose first comparison has the law of the first lane, as on a bench."""

    is_bench = True


def follow(script, is_bench):
    """Return the journal of a run with all commands of a script that it accepts."""
    run = (TwinnedRun if is_bench else Run)(build_configuration(comparisons=(TWIN,)))
    journal = Journal(run, is_bench)
    for gap, (kind, argument) in script:
        journal.advance(gap)
        if is_bench and kind == "comparisons":
            argument = (svsa.Lane(law=run.configuration.law), *argument[:2])
        try:
            journal.enter(build_command(run.tick, kind, argument))
        except svsa.SvsaError:
            continue
    return journal


@pytest.mark.parametrize("is_bench", [False, True], ids=["simulation", "bench"])
@scripted
@given(changes)
def test_session_timeline_and_record_have_one_configuration(is_bench, script):
    journal = follow(script, is_bench)
    run = journal.run
    written = json.loads(json.dumps([one.to_json() for one in journal.commands]))
    read = [read_command(one) for one in written]
    fold_next = functools.partial(fold, is_bench=is_bench)
    assert functools.reduce(fold_next, read, journal.initial) == run.configuration
    assert journal.timeline._configuration == run.configuration
    if run.fault is None:
        again = read_timeline(journal.initial, read, (-1, run.tick), is_bench)
        assert again._configuration == run.configuration
    header = build_header(journal.initial, plant="bench" if is_bench else "simulated")
    acting = read_acting(header, [(one["tick"], one) for one in written], 0, run.tick + 1)
    last = {name: acting.get_values(name)[-1] for name in SETTINGS}
    assert last == {name: getattr(run.configuration, name) for name in SETTINGS}


def test_twin_of_a_bench_has_its_law():
    before = build_configuration(comparisons=(TWIN, TWIN))
    for command in (Set("law", "fl"), Set("laws", ("fl", "ndobc"))):
        after = fold(before, command, is_bench=True)
        assert [lane.law for lane in after.lanes] == ["fl", "fl", "ndobc"]
    assert [lane.law for lane in fold(before, Set("law", "fl")).lanes] == ["fl", "ndobc", "ndobc"]


def test_unchanged_value_has_no_effect_and_a_load_always_has():
    configuration = build_configuration()
    assert is_held(configuration, Set("law", configuration.law))
    assert fold(configuration, Set("law", configuration.law)) is configuration
    assert not is_held(configuration, Set("law", "fl"))
    assert not is_held(configuration, build_command(0, "load", {"kind": "paper"}))
    assert not is_held(configuration, build_command(0, "stop", None))


def test_unreadable_law_is_unknown():
    configuration = build_configuration(comparisons=(TWIN,))
    wrong = (3, {"tick": 3, "kind": "laws", "argument": "no list"})
    acting = read_acting(build_header(configuration), [wrong], 0, 10)
    assert acting.settings["law"] == ((0, "ndobc"), (3, None))
    assert acting.settings["comparisons"] == ((0, (TWIN,)), (3, None))
