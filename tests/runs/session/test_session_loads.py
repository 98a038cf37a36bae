"""Loads of a session: onset and end, their events, and metrics since then."""

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import CHANNEL_INDEX
from svsa.runs.definition.command import ApplyLoad, RemoveLoad, Set, read_command
from svsa.runs.execution.replay import replay
from svsa.runs.session.session import remove_loads

from .sessions import PULSE, build_session, list_events, read_samples


def test_loads_are_logged_when_they_act():
    """Onset and end at their ticks, each once, for any split of the ticks."""
    session = build_session(PULSE)
    session.step(100)
    assert list_events(session) == [(30, "load_on"), (50, "load_off")]
    single = build_session(PULSE)
    for _ in range(100):
        single.step(1)
    assert list_events(single) == list_events(session)


def test_metrics_since_the_load_start_at_its_onset():
    session = build_session(PULSE)
    session.step(30)
    assert session.journal.metrics.since_load is None
    session.step(40)
    (since,) = [metrics.summarize() for metrics in session.journal.metrics.since_load]
    (whole,) = [metrics.summarize() for metrics in session.journal.metrics.since_start]
    assert since.duration_s == pytest.approx(0.04)
    assert whole.duration_s == pytest.approx(0.07)
    error = read_samples(session)[30:, CHANNEL_INDEX["position_error_rad"]]
    assert since.peak_position_error_rad == np.abs(error).max()


def test_metrics_of_a_load_end_at_its_removal():
    """The error after load removal is not attributed to the load; the next load restarts them."""
    session = build_session()
    session.step(10)
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.step(30)
    (loaded,) = [metrics.summarize() for metrics in session.journal.metrics.since_load]
    session.change(RemoveLoad(argument=1))
    session.step(50)
    assert [metrics.summarize() for metrics in session.journal.metrics.since_load] == [loaded]
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.step(5)
    (again,) = [metrics.summarize() for metrics in session.journal.metrics.since_load]
    assert again.duration_s == pytest.approx(0.005)
    session.change(RemoveLoad(argument=2))
    session.change(Set("comparisons", (svsa.Lane(law="fl"),)))
    first, comparison = session.journal.metrics.since_load
    assert first.summarize() == again
    assert comparison is None, "the load was on before this lane began"


def test_load_removal_is_logged_and_ends_the_load():
    session = build_session()
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.step(10)
    session.change(RemoveLoad(argument=1))
    session.step(10)
    assert list_events(session) == [(0, "load_on"), (10, "load_off")]
    assert session.run.loads == ()
    session.change(ApplyLoad(argument=PULSE))
    assert session.run.loads[0].start_tick > session.run.tick
    remove_loads(session)
    assert session.run.loads == ()
    assert list_events(session)[2:] == [], "a load that was only planned has not acted"
    kinds = [(command.tick, command.kind) for command in session.journal.commands]
    assert kinds == [(0, "load"), (10, "unload"), (20, "load"), (20, "unload")]


def test_repeated_manual_load_is_one_mark():
    session = build_session()
    for torque in np.linspace(0.1, 1.5, 15):
        session.change(ApplyLoad(argument=svsa.PushLoad(torque_nm=(torque, 0.0, 0.0), hold_s=0.05)))
        session.step(20)
    number = session.run.loads[0].number
    session.change(RemoveLoad(argument=number))
    session.step(10)
    labels = [(event.tick, event.label) for event in session.journal.events]
    assert labels == [(0, "Push on"), (300, "Push off")]
    assert [command.kind for command in session.journal.commands].count("load") == 15
    (since,) = [metrics.summarize() for metrics in session.journal.metrics.since_load]
    assert since.duration_s == pytest.approx(0.3)


def test_manual_load_without_updates_ends_automatically():
    session = build_session()
    session.change(ApplyLoad(argument=svsa.PushLoad(torque_nm=(1.0, 0.0, 0.0), hold_s=0.05)))
    session.step(30)
    session.change(ApplyLoad(argument=svsa.PushLoad(torque_nm=(1.0, 0.0, 0.0), hold_s=0.05)))
    session.step(100)
    assert list_events(session) == [(0, "load_on"), (80, "load_off")]


def test_manual_load_is_replayed_bit_for_bit():
    session = build_session()
    for torque in (0.4, 0.9, -0.7):
        session.change(ApplyLoad(argument=svsa.PushLoad(torque_nm=(torque, 0.0, 0.0), hold_s=0.1)))
        session.step(60)
    session.change(RemoveLoad(argument=session.run.loads[0].number))
    session.step(100)
    written = [read_command(command.to_json()) for command in session.journal.commands]
    again = [samples for _, samples in replay(session.journal.initial, written, session.run.tick)]
    np.testing.assert_array_equal(np.concatenate(again, axis=1)[0], read_samples(session))


def test_end_of_a_load_is_logged_if_another_starts_at_its_tick():
    """The tick of the end is reached, then the next load is added, then time continues."""
    session = build_session(PULSE)
    session.step(50)
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.step(1)
    assert list_events(session) == [(30, "load_on"), (50, "load_off"), (50, "load_on")]


def test_load_removed_before_its_first_tick_is_not_logged_as_removed():
    """It never acted: the page would receive an end without a start."""
    session = build_session()
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.change(RemoveLoad(argument=1))
    session.step(1)
    assert list_events(session) == []
