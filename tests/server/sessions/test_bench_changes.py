"""Concurrent changes of a bench, whose loop takes time to answer."""

import asyncio
from collections.abc import Iterator
from types import SimpleNamespace

import numpy as np
import pytest

from svsa.actuators.signals import CHANNELS
from svsa.control.gains import Gains
from svsa.errors import Fault, StateError
from svsa.hardware.realtime.configuration import MAX_LOAD_POINTS
from svsa.hardware.realtime.loss import Loss
from svsa.hardware.safety.machine import BenchStatus
from svsa.hardware.session import commands
from svsa.hardware.session.session import BenchSession
from svsa.runs.definition.command import ApplyLoad, Set, Stop
from svsa.runs.definition.design import Lane
from svsa.simulation.plant.loads.series import SeriesLoad
from svsa_server.routes.lab import settings
from svsa_server.schemas.lab.gain import GainsRequest
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.state import build_progress
from svsa_server.sessions.waiting import run_waiting
from tests.runs.session.loop_ticks import write
from tests.server.sessions.scripted_bench import Processes, begin_run, build_bench_session, say


@pytest.fixture
def session(monkeypatch: pytest.MonkeyPatch) -> Iterator[BenchSession]:
    monkeypatch.setattr(settings, "build_state", lambda _: None)
    made = build_bench_session(monkeypatch)
    made.open()
    yield made
    made.close()


@pytest.mark.parametrize("points", [MAX_LOAD_POINTS, MAX_LOAD_POINTS + 1])
def test_series_load_that_delays_the_loop_too_long_is_rejected(
    session: BenchSession, points: int
) -> None:
    """Immediate and planned; the loop receives nothing of a rejected one."""
    times, torques = tuple(1e-3 * i for i in range(points)), ((0.1, 0.0, 0.0),) * points
    load = SeriesLoad(time_s=times, torque_nm=torques)
    planned = session.run.configuration.changed(loads=(load,))
    assert isinstance(session.loop.processes, Processes)
    reported = session.loop.processes.reported
    for give in (lambda: session.change(ApplyLoad(argument=load)), lambda: session.load(planned)):
        before = len(reported)
        if points <= MAX_LOAD_POINTS:
            give()
            assert len(reported) == before + 1
            continue
        with pytest.raises(StateError, match="has 1001 points, and a bench takes one of 1000"):
            give()
        assert len(reported) == before


def test_two_concurrent_changes_of_the_gains_are_both_kept(session: BenchSession) -> None:
    before, hosted = session.run.configuration.gains, HostedSession(session)
    requests = (
        GainsRequest(stiffness_coefficients=(900.0, 60.0)),
        GainsRequest(position_poles_rad_per_s=(-30.0, -30.0, -30.0, -30.0)),
        GainsRequest(stiffness_coefficients=(1600.0, 80.0)),
    )

    async def ask() -> None:
        await asyncio.gather(
            *(run_waiting(settings.set_gains, hosted=hosted, request=each) for each in requests)
        )

    asyncio.run(ask())
    gains = session.run.configuration.gains
    assert gains == requests[2].apply_to(requests[1].apply_to(before))
    assert isinstance(session.loop.processes, Processes)
    assert Gains(**session.loop.processes.reported[-1]["argument"]) == gains, (
        "the loop has the same"
    )


def test_twin_has_the_pending_law(session: BenchSession) -> None:
    async def ask() -> None:
        await asyncio.gather(
            run_waiting(session.change, Set("law", "fl")),
            run_waiting(session.change, Set("comparisons", (Lane(law="ndobc"),))),
        )

    asyncio.run(ask())
    configuration = session.run.configuration
    assert [lane.law for lane in configuration.lanes] == ["fl", "fl", "ndobc"]


def test_unchanged_value_is_not_sent_to_the_loop_again(session: BenchSession) -> None:
    settings = [
        Set("law", "fl"),
        Set("comparisons", (Lane(law="ndobc"),)),
        Set("position", session.run.configuration.position.changed(transition_s=0.5)),
    ]

    async def ask() -> None:
        await asyncio.gather(*(run_waiting(session.set, each) for each in settings * 2))

    asyncio.run(ask())
    processes, journal = session.loop.processes, session.journal
    assert isinstance(processes, Processes)
    reported = [
        one["kind"] for one in processes.reported if isinstance(one, dict) and "kind" in one
    ]
    assert sorted(reported) == ["comparisons", "law", "position"]
    assert sorted(command.kind for command in journal.commands) == sorted(reported)
    before = len(journal.events)
    session.change(settings[-1])
    assert len(journal.events) == before + 1, "begun again where that is asked for"


def test_twin_is_not_set_separately(session: BenchSession) -> None:
    """Rejected before the loop receives it: it would control its own twin otherwise."""
    reported = len(session.loop.processes.reported)  # pyright: ignore[reportAttributeAccessIssue]
    setting = {"lane": 2, "setting": {"law": "ndobc", "observer": None}}
    with pytest.raises(StateError, match="Lane 2 is the bench's simulated twin"):
        session.change(Set("lane", setting))
    assert len(session.loop.processes.reported) == reported  # pyright: ignore[reportAttributeAccessIssue]


def test_later_information_on_a_lost_loop_reaches_the_record(
    session: BenchSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first report, that no process has stopped the drives yet, is not final."""
    written: list[Fault] = []
    recorder = SimpleNamespace(write_fault=written.append, fault=None)
    words = ["The drives are not stopped yet.", "The supervisor has.", "The supervisor has."]
    losses = [Loss("loop_lost", message, None, None) for message in words]
    monkeypatch.setattr(session.loop, "find_lasting_loss", lambda: losses.pop(0))
    monkeypatch.setattr(session.report, "loop_status", BenchStatus.RUN)
    monkeypatch.setattr(session.journal, "recorder", recorder)
    session.wake(0.0)
    recorder.fault = written[-1]
    session.wake(0.0)
    session.wake(0.0)
    assert [fault.message for fault in written] == words[:2]
    monkeypatch.undo()


def test_ramp_of_a_stop_is_excluded_from_the_metrics_of_the_run(
    session: BenchSession,
) -> None:
    """The twin continues without a ramp: one window would compare different motions."""
    begin_run(session, 100)
    write(session.loop.memory, 100, 50)
    say(session, BenchStatus.RAMP)
    session.wake(0.0)
    journal = session.journal
    assert (journal.timeline.window.kind, journal.timeline.window.first_tick) == ("stop", 100)
    (before,) = journal.metrics.ended
    assert [one and one.duration_s for one in before.lanes] == pytest.approx([0.1, 0.1])
    since = [one and one.summarize() for one in journal.metrics.in_window]
    assert [one and one.duration_s for one in since] == pytest.approx([0.05, 0.05])
    assert [event.label for event in journal.events] == ["Stop"]
    assert journal.commands == [Stop(tick=100)], "a record has it, too"


def test_ended_twin_has_no_metrics(session: BenchSession) -> None:
    """Its earlier samples are incomplete; the bench continues."""
    begin_run(session, 100)
    hosted = HostedSession(session)
    assert all(lane.in_window is not None for lane in build_progress(hosted).lanes)
    (_, twin) = session.journal.metrics.in_window
    assert twin is not None
    twin.update(np.full((501, len(CHANNELS)), np.nan))
    bench, ended = build_progress(hosted).lanes
    assert bench.in_window is not None
    assert ended.in_window is None
    assert ended.model_dump(mode="json")["in_window"] is None


def run_and_stop(session: BenchSession) -> None:
    """Run 100 ticks, then stop the bench."""
    begin_run(session, 50)
    write(session.loop.memory, 50, 50)
    for status in (BenchStatus.RAMP, BenchStatus.READY):
        say(session, status)
        session.wake(0.0)
    assert session.run.tick == 100


def test_change_at_a_tick_without_a_sample_is_stored_at_the_last_one(
    session: BenchSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another run of the loop has started meanwhile, whose samples are not of this run."""
    begin_run(session, 50)
    monkeypatch.setattr(session.loop.processes, "request", lambda *_: {"tick": 60})
    session.change(Set("law", "fl"))
    assert [(command.kind, command.tick) for command in session.journal.commands] == [("law", 50)]
    assert session.run.configuration.law == "fl"


def test_change_waits_a_limited_time_for_earlier_ones(
    session: BenchSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(commands, "LONGEST_CHANGES_S", 0.1)
    monkeypatch.setattr(session._commands, "_pending", 1)
    for command in (Set("law", "fl"), Set("comparisons", (Lane(law="fl"),))):
        with pytest.raises(StateError, match=r"1 earlier changes.*Send it again"):
            session.set(command)
    assert session.journal.commands == []


def test_reset_run_is_not_read_again(session: BenchSession) -> None:
    run_and_stop(session)
    session.reset()
    session.wake(0.0)
    assert (session.run.tick, session.journal.history.end_tick) == (0, 0)


def test_recording_of_a_bench_at_rest_has_nothing_of_the_previous_run(
    session: BenchSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its stop and its loads would be commands of the new one, and the loop's ticks its own."""
    monkeypatch.setattr(type(session.loop), "emulated", True)
    run_and_stop(session)
    reported = session.loop.processes.reported = []
    session.prepare_recording()
    assert len(reported) == 1, (
        "the loop begins at tick 0, too: a change is waited for until its tick"
    )
    session.wake(0.0)
    assert (session.run.tick, session.journal.commands) == (0, [])
