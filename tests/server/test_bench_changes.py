"""Two clients change parts of one thing at a bench, whose loop takes a while to answer."""

import asyncio
from collections.abc import Iterator
from types import SimpleNamespace

import pytest

from svsa.bench.realtime.loss import Loss
from svsa.bench.safety.machine import BenchStatus
from svsa.control.gains import Gains
from svsa.errors import Fault, StateError
from svsa.run.command import SetLane, SetLaw, SetRivals
from svsa.run.configuration import Lane
from svsa.session.bench import BenchSession
from svsa_server.gain_schemas import GainsRequest
from svsa_server.hosted import HostedSession
from svsa_server.routes import settings
from svsa_server.turn import take_turn
from tests.server.scripted_bench import Processes, build_bench_session


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
