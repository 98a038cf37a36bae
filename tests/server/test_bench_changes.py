"""Two clients change parts of one thing at a bench, whose loop takes a while to answer."""

import asyncio
from collections.abc import Iterator
from types import SimpleNamespace

import pytest

from svsa.bench.realtime.loss import Loss
from svsa.bench.safety.machine import BenchStatus
from svsa.control.gains import Gains
from svsa.errors import Fault, StateError
from svsa.loop.lane import AT_REST
from svsa.run.command import SetLane, SetLaw, SetRivals
from svsa.run.configuration import Lane
from svsa.run.run import Start
from svsa.session.bench import BenchSession
from svsa.session.bench_run import BenchRun
from svsa_server.gain_schemas import GainsRequest
from svsa_server.hosted import HostedSession
from svsa_server.routes import settings
from svsa_server.turn import take_turn
from tests.server.scripted_bench import Processes, build_bench_session
from tests.session.test_bench_run import write


@pytest.fixture
def session(monkeypatch: pytest.MonkeyPatch) -> Iterator[BenchSession]:
    monkeypatch.setattr(settings, "build_state", lambda _: None)
    made = build_bench_session(monkeypatch)
    made.open()
    yield made
    made.close()


def test_two_parts_of_the_gains_at_once_are_both_kept(session: BenchSession) -> None:
    before, hosted = session.run.configuration.gains, HostedSession(session)
    requests = (
        GainsRequest(stiffness_coefficients=(900.0, 60.0)),
        GainsRequest(position_poles_rad_per_s=(-30.0, -30.0, -30.0, -30.0)),
        GainsRequest(stiffness_coefficients=(1600.0, 80.0)),
    )

    async def ask() -> None:
        await asyncio.gather(
            *(take_turn(settings.set_gains, hosted=hosted, request=each) for each in requests)
        )

    asyncio.run(ask())
    gains = session.run.configuration.gains
    assert gains == requests[2].apply_to(requests[1].apply_to(before))
    assert isinstance(session.loop.processes, Processes)
    assert Gains(**session.loop.processes.told[-1]["argument"]) == gains, "the loop has the same"


def test_the_twin_has_the_law_that_is_on_its_way(session: BenchSession) -> None:
    async def ask() -> None:
        await asyncio.gather(
            take_turn(session.change, SetLaw(argument="fl")),
            take_turn(session.change, SetRivals(argument=(Lane(law="ndobc"),))),
        )

    asyncio.run(ask())
    configuration = session.run.configuration
    assert [lane.law for lane in configuration.lanes] == ["fl", "fl", "ndobc"]


def test_the_twin_is_not_set_by_itself(session: BenchSession) -> None:
    """Refused before the loop hears of it: it would control its own twin otherwise."""
    told = len(session.loop.processes.told)  # pyright: ignore[reportAttributeAccessIssue]
    setting = {"lane": 2, "setting": {"law": "ndobc", "observer": None}}
    with pytest.raises(StateError, match="Lane 2 is the bench's simulated twin"):
        session.change(SetLane(argument=setting))
    assert len(session.loop.processes.told) == told  # pyright: ignore[reportAttributeAccessIssue]


def test_what_comes_to_be_known_of_a_lost_loop_reaches_the_record(
    session: BenchSession, monkeypatch: pytest.MonkeyPatch
) -> None:
    """That nobody has stopped the drives yet is not the last word on it."""
    written: list[Fault] = []
    recorder = SimpleNamespace(write_fault=written.append, fault=None)
    words = ["Nobody has stopped the drives yet.", "The supervisor has.", "The supervisor has."]
    losses = [Loss("loop_lost", message, None, None) for message in words]
    monkeypatch.setattr(session.loop, "find_settled_loss", lambda: losses.pop(0))
    monkeypatch.setattr(session, "_told_status", BenchStatus.RUN)
    monkeypatch.setattr(session.journal, "recorder", recorder)
    session.wake(0.0)
    recorder.fault = written[-1]
    session.wake(0.0)
    session.wake(0.0)
    assert [fault.message for fault in written] == words[:2]
    monkeypatch.undo()


def test_what_a_stop_does_on_its_ramp_is_not_in_the_numbers_of_the_run(
    session: BenchSession,
) -> None:
    """The twin goes on without a ramp: in one window they would not be of the same."""
    memory, start = session.loop.memory, Start(session.bench.home.lever_ratio, AT_REST)
    memory.begin_run(1)
    session._begin(BenchRun(session.run.configuration, start, memory))
    tell(session, BenchStatus.RUN)
    write(memory, 0, 100)
    session.wake(0.0)
    write(memory, 100, 50)
    tell(session, BenchStatus.RAMP)
    session.wake(0.0)
    journal = session.journal
    assert (journal.timeline.window.kind, journal.timeline.window.first_tick) == ("stop", 100)
    (before,) = journal.metrics.ended
    assert [one and one.duration_s for one in before.lanes] == pytest.approx([0.1, 0.1])
    since = [one and one.summarize() for one in journal.metrics.in_window]
    assert [one and one.duration_s for one in since] == pytest.approx([0.05, 0.05])
    assert [event.label for event in journal.events] == ["Stop"]


def tell(session: BenchSession, status: BenchStatus) -> None:
    """What the loop says of itself with the next wake."""
    event = {"event": "state", "status": status, "problems": [], "homing_step": None, "fault": None}
    told = [event]
    session.loop.processes.take_events = lambda: [told.pop()] if told else []  # pyright: ignore
    if status is BenchStatus.RUN:
        session.wake(0.0)
