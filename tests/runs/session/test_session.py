"""A session: start, pause, step, speed and reset, with a given wall clock."""

import numpy as np
import pytest

import svsa
from svsa.actuators.faults import label_fault
from svsa.runs.definition.command import ApplyLoad, Set
from svsa.runs.session.clock import LONGEST_BACKLOG_S
from svsa.runs.timeline import events

from .sessions import PULSE, build_session, list_events, read_samples

CRASH = svsa.ConstantLoad(torque_nm=(40.0, 0.0, 0.0), start_s=0.05)


def test_new_session_is_paused_and_wake_up_runs_no_tick():
    session = build_session()
    session.wake(10.0)
    session.wake(11.0)
    assert (session.status, session.run.tick) == ("paused", 0)


def test_running_session_follows_the_wall_clock():
    """The first wake-up sets the origin; then one tick per millisecond, none lost."""
    session = build_session()
    session.start()
    for k in range(31):
        session.wake(100.0 + k / 30.0)
    assert session.status == "running"
    assert abs(session.run.tick - 1000) <= 1
    assert session.clock.real_time_factor == pytest.approx(1.0)
    assert session.clock.accumulated_delay_s == 0.0


def test_pause_keeps_the_state_and_start_does_not_catch_up():
    session = build_session()
    session.start()
    session.wake(0.0)
    session.wake(0.1)
    session.pause()
    lanes, tick = list(session.run.lanes), session.run.tick
    session.wake(5.0)
    assert (session.run.lanes, session.run.tick) == (lanes, tick)
    session.start()
    session.wake(60.0)
    assert session.run.tick == tick
    session.wake(60.1)
    assert abs(session.run.tick - tick - 100) <= 1


def test_step_runs_this_many_ticks_and_only_while_paused():
    session = build_session()
    session.step(7)
    assert session.run.tick == session.journal.history.end_tick == 7
    session.start()
    with pytest.raises(svsa.StateError, match="running: pause it"):
        session.step(1)
    assert session.run.tick == 7


def test_speed_scales_the_session_and_not_the_physics():
    """At twice the speed twice the ticks, the same samples."""
    fast, single = build_session(), build_session()
    fast.set_speed(2.0)
    fast.start()
    fast.wake(0.0)
    fast.wake(0.1)
    assert abs(fast.run.tick - 200) <= 1
    single.step(fast.run.tick)
    assert fast.run.lanes == single.run.lanes


def test_late_session_stretches_time_and_skips_no_tick():
    """A wake-up 3 s late runs a quarter of a second and reports the rest as delay."""
    session = build_session()
    session.start()
    session.wake(0.0)
    session.wake(3.0)
    assert abs(session.run.tick - 1000 * LONGEST_BACKLOG_S) <= 1
    assert session.clock.accumulated_delay_s == pytest.approx(3.0 - LONGEST_BACKLOG_S)
    assert session.clock.real_time_factor < 1.0
    times = read_samples(session)[:, 0]
    np.testing.assert_allclose(np.diff(times), 0.001, atol=1e-12)


def test_split_into_wake_ups_changes_no_sample():
    """Wall time never enters the physics."""
    steady, uneven = build_session(PULSE), build_session(PULSE)
    steady.step(400)
    uneven.start()
    for now in np.cumsum([0.001 + 0.013 * (count % 5) for count in range(40)]):
        uneven.wake(now)
    found = read_samples(uneven)
    assert len(found) > 400
    np.testing.assert_array_equal(found[:400], read_samples(steady))


def test_fault_stops_the_session_until_reset():
    session = build_session(CRASH)
    session.start()
    session.wake(0.0)
    session.wake(0.2)
    assert session.status == "fault"
    assert session.run.tick == session.journal.history.end_tick == session.run.fault.tick
    assert list_events(session)[-1] == (session.run.tick, "fault")
    assert np.all(np.isfinite(read_samples(session)))
    session.wake(0.4)
    assert list_events(session)[-1] == (session.run.tick, "fault")
    assert [kind for _, kind in list_events(session)].count("fault") == 1
    assert (
        session.journal.events[-1].label
        == label_fault(session.run.fault.code)
        != session.run.fault.code
    )
    journal = session.journal
    recorded = events.list_events(journal.initial, journal.commands, session.run.fault)
    assert recorded == list(journal.events)
    for refused in (session.start, lambda: session.step(1)):
        with pytest.raises(svsa.StateError, match="fault"):
            refused()
    session.reset()
    assert (session.status, session.run.tick) == ("running", 0)
    session.wake(100.0)
    assert session.run.tick == 0, "the time in the fault is not owed"


def test_reset_restarts_with_the_present_settings_and_planned_loads():
    session = build_session(PULSE)
    session.change(Set("law", "fl"))
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.step(60)
    runs = session.journal.run_number
    session.reset()
    assert (session.run.tick, session.journal.history.end_tick) == (0, 0)
    assert session.journal.run_number == runs + 1
    assert session.run.configuration.law == "fl"
    assert [scheduled.load for scheduled in session.run.loads] == [PULSE]
    assert list_events(session) == []
    assert [metrics.summarize() for metrics in session.journal.metrics.since_start] == [None]
    assert session.journal.metrics.since_load is None


def test_running_session_has_no_due_ticks_after_a_reset():
    """The new run starts at the first wake-up after it, at any time."""
    session = build_session()
    session.start()
    session.wake(0.0)
    session.wake(0.1)
    session.reset()
    session.wake(3.0)
    assert (session.status, session.run.tick) == ("running", 0)
    assert session.clock.accumulated_delay_s == 0.0


def test_repeated_run_after_a_reset_gives_the_same_samples():
    session = build_session(PULSE)
    session.step(120)
    first = read_samples(session)
    session.reset()
    session.step(120)
    np.testing.assert_array_equal(read_samples(session), first)


def test_command_takes_effect_at_its_tick() -> None:
    session = build_session()
    session.step(7)
    session.change(Set("law", "fl", tick=3))
    assert [(one.tick, one.kind) for one in session.journal.commands] == [(7, "law")]
