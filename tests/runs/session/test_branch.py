"""Branches: a run opened at any tick continues identically until it is changed."""

from dataclasses import asdict

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import svsa
from svsa.runs.definition.command import ApplyLoad
from svsa.runs.execution.replay import build_run_at
from svsa.runs.session.simulated import SimulatedSession

from .scripts import collect, play, play_busy_session, read, scripted, scripts, wake_sizes, write
from .sessions import PULSE, advance, build_configuration, build_session, list_lanes, read_samples


@scripted
@given(scripts, wake_sizes, st.floats(0.0, 1.0))
def test_run_opened_at_any_tick_continues_as_the_original(script, wakes, share):
    """The complete state, including queue and lag, which the samples do not show."""
    session = build_session(PULSE)
    play(session, script, wakes)
    configuration, commands = read(write(session))
    tick, end = int(share * session.run.tick), session.run.tick
    run = build_run_at(configuration, commands, tick)
    assert run.tick == tick
    for command in (c for c in commands if c.tick >= tick):
        advance(run, command.tick - run.tick)
        run.change(command)
    advance(run, end - run.tick)
    reached, again = session.run, run
    assert (again.tick, again.loads) == (reached.tick, reached.loads)
    assert list_lanes(again) == list_lanes(reached)
    assert again.configuration == reached.configuration
    if reached.fault is None:
        np.testing.assert_array_equal(advance(again, 20), advance(reached, 20))


def test_changed_branch_differs_only_after_its_tick():
    """Opened at tick 90, changed and continued: the past is that of the original."""
    session = play_busy_session()
    configuration, commands = read(write(session))
    kept = [command for command in commands if command.tick < 90]
    branch = [*kept, ApplyLoad(tick=90, argument=svsa.ConstantLoad(torque_nm=(0.2, 0.0, 0.0)))]
    found = collect(configuration, branch, 0, 110)[0]
    original = read_samples(session)
    np.testing.assert_array_equal(found[:90], original[:90])
    assert np.all(np.any(found[90:] != original[90:110], axis=1))


def test_run_cannot_be_opened_after_its_end():
    crash = build_configuration(svsa.ConstantLoad(torque_nm=(40.0, 0.0, 0.0), start_s=0.05))
    with pytest.raises(svsa.StateError, match="ended before tick 500, at tick"):
        build_run_at(crash, [], 500)
    assert 50 < collect(crash, [], 0, 500).shape[1] < 500


def list_state(session):
    return (
        session.journal.initial,
        session.journal.commands,
        session.run.tick,
        list_lanes(session.run),
    )


@pytest.mark.parametrize("tick", [0, 1, 47, 90, 140])
def test_session_continued_from_a_record_equals_the_recorded_session(tick):
    """Past, state and commands; then both get the same commands and ticks."""
    original = play_busy_session()
    end, samples = original.run.tick, read_samples(original)
    session = SimulatedSession.branch(
        "branch", original.journal.initial, original.journal.commands, tick
    )
    assert (session.run.tick, session.journal.history.end_tick) == (tick, tick)
    np.testing.assert_array_equal(read_samples(session), samples[:tick])
    for command in original.journal.commands:
        if command.tick >= tick:
            session.step(command.tick - session.run.tick)
            session.change(command)
    session.step(end - session.run.tick)
    assert list_state(session) == list_state(original)
    for lane in (0, 1):
        np.testing.assert_array_equal(read_samples(session, lane), read_samples(original, lane))


def test_branch_after_an_added_lane_starts_it_with_the_past_of_the_first():
    """As in the recorded session: neither zeros nor the previous past of the session."""
    original = play_busy_session()
    end = original.run.tick
    session = SimulatedSession.branch(
        "branch", original.journal.initial, original.journal.commands, end
    )
    for lane in (0, 1):
        np.testing.assert_array_equal(read_samples(session, lane), read_samples(original, lane))


@scripted
@given(scripts, wake_sizes)
def test_every_lane_of_a_branch_has_its_past(script, wakes):
    """Lanes are added, removed and moved in random scripts; up to the end, with or
    without a fault.
    """
    original = build_session(PULSE)
    play(original, script, wakes)
    end = original.run.tick
    session = SimulatedSession.branch("branch", *read(write(original)), end)
    np.testing.assert_array_equal(read_samples(session), read_samples(original))
    if original.status == "fault":
        session.step(1)
        assert session.run.fault == original.run.fault
        return
    assert list_state(session) == list_state(original)
    for lane in range(1, len(original.run.lanes)):
        np.testing.assert_array_equal(read_samples(session, lane), read_samples(original, lane))


def test_metrics_and_events_of_a_branch_are_those_of_the_recorded_session():
    original = play_busy_session()
    end = original.run.tick
    session = SimulatedSession.branch(
        "branch", original.journal.initial, original.journal.commands, end
    )
    all_of = (
        [*m.since_start[:1], *m.in_window]
        for m in (session.journal.metrics, original.journal.metrics)
    )
    for mine, theirs in zip(*all_of, strict=True):
        found, expected = asdict(mine.summarize()), asdict(theirs.summarize())
        unknown = {name for name, value in expected.items() if value is None}
        assert {name for name, value in found.items() if value is None} == unknown
        for name in expected.keys() - unknown:
            assert found[name] == pytest.approx(expected[name], rel=1e-12)
    assert list(session.journal.events) == list(original.journal.events)


def test_branch_after_the_end_of_a_run_is_rejected():
    crash = build_configuration(svsa.ConstantLoad(torque_nm=(40.0, 0.0, 0.0), start_s=0.05))
    with pytest.raises(svsa.StateError, match="ended at tick"):
        SimulatedSession.branch("branch", crash, [], 500)
