"""Two clients change parts of one thing at a bench, whose loop takes a while to answer."""

import asyncio
import itertools
from collections.abc import Iterator
from typing import Any

import pytest

from svsa.control.gains import Gains
from svsa.experiment.paper import get_figure
from svsa.hardware.heartbeat import Heartbeats
from svsa.runtime.realtime import session as bench_session
from svsa.runtime.realtime.memory import LoopMemory
from svsa.runtime.realtime.session import BenchSession
from svsa_server.routes import settings
from svsa_server.schemas import GainsRequest
from svsa_server.turn import let_pass, take_turn
from tests.hardware.wired_bench import RIG_BENCH

ANSWER_S = 0.01


class Processes:
    """A bench's loop that answers to every command a while later."""

    def __init__(self, *_: Any) -> None:
        self.memory, self.beats = LoopMemory.create(), Heartbeats.create()
        self.told: list[dict[str, Any]] = []
        self._ticks = itertools.count(1)

    def request(self, wanted: str, argument: Any = None) -> dict[str, Any]:
        assert wanted in ("load", "change")
        let_pass(ANSWER_S)
        self.told.append(argument)
        return {"tick": 0}

    def take_events(self) -> list[dict[str, Any]]:
        return []

    def free(self) -> None:
        self.memory.close()
        self.beats.close()


@pytest.fixture
def session(monkeypatch: pytest.MonkeyPatch) -> Iterator[BenchSession]:
    monkeypatch.setattr(bench_session, "BenchProcesses", Processes)
    monkeypatch.setattr(settings, "build_state", lambda _: None)
    figure = get_figure("4a").build_configuration(load=False)
    made = BenchSession("lab", RIG_BENCH, figure, rest=let_pass)
    yield made
    made.processes.free()


def test_two_parts_of_the_gains_at_once_are_both_kept(session: BenchSession) -> None:
    before = session.run.configuration.gains
    requests = (
        GainsRequest(stiffness_coefficients=(900.0, 60.0)),
        GainsRequest(position_poles_rad_per_s=(-30.0, -30.0, -30.0, -30.0)),
        GainsRequest(stiffness_coefficients=(1600.0, 80.0)),
    )

    async def ask() -> None:
        await asyncio.gather(
            *(take_turn(settings.set_gains, session=session, request=each) for each in requests)
        )

    asyncio.run(ask())
    gains = session.run.configuration.gains
    assert gains == requests[2].apply_to(requests[1].apply_to(before))
    assert isinstance(session.processes, Processes)
    assert Gains(**session.processes.told[-1]["argument"]) == gains, "the loop has the same"


def test_the_twin_has_the_law_that_is_on_its_way(session: BenchSession) -> None:
    async def ask() -> None:
        await asyncio.gather(
            take_turn(session.change, "law", "fl"),
            take_turn(session.change, "rivals", ({"law": "ndobc"},)),
        )

    asyncio.run(ask())
    configuration = session.run.configuration
    assert [lane.law for lane in configuration.lanes] == ["fl", "fl", "ndobc"]
