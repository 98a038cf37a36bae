"""A bench session in this process, whose loop is a script: no process, no bus, no waiting."""

import types
from collections.abc import Callable, Iterable
from dataclasses import asdict
from typing import Any

import pytest

from svsa.errors import Fault
from svsa.hardware.realtime.launch import BenchError
from svsa.hardware.realtime.memory import LoopMemory
from svsa.hardware.safety.heartbeat import Heartbeats
from svsa.hardware.safety.machine import BenchStatus
from svsa.hardware.session import supervised_loop
from svsa.hardware.session.run import BenchRun
from svsa.hardware.session.session import BenchSession
from svsa.runs.definition.paper import get_figure
from svsa.runs.execution.run import Start
from svsa.simulation.loop.lane import AT_REST
from svsa_server.sessions.waiting import pause
from tests.hardware.wired_bench import EMULATOR_BENCH
from tests.runs.session.loop_ticks import write

ANSWER_S = 0.01
STEP = "compiling the loop, once: 3 functions, observe the last"


class Processes:
    """Loop and supervisor: `script` says how they start, and every command takes a while.

    script: `is_ready`, which `wait_until_ready` waits for; `refusal`, the reason if the bench
    cannot be opened.
    """

    script = types.SimpleNamespace(is_ready=lambda: True, refusal=None)

    def __init__(self, *_: Any) -> None:
        self.memory, self.beats = LoopMemory.create(), Heartbeats.create()
        self.step, self.age_s, self.failure = STEP, 12.3, None
        self.silence_s, self.notes, self.supervisor_alive = 0.0, [], True
        self.listens = self.alive = False
        self.reported: list[Any] = []
        self.states: list[dict[str, Any]] = []
        self.third_line = types.SimpleNamespace(intervention=None)

    def wait_until_ready(self, silence_s: float, notify: Any) -> None:
        notify(self.step, self.age_s)
        while not self.script.is_ready():
            pause(ANSWER_S)
        if self.script.refusal is not None:
            self.failure = f"The bench cannot be opened: {self.script.refusal}"
            raise BenchError(self.failure)
        self.listens = self.alive = True

    def request(self, wanted: str, argument: Any = None) -> dict[str, Any]:
        pause(ANSWER_S)
        self.reported.append(argument)
        return {"tick": 0}

    def take_events(self) -> list[dict[str, Any]]:
        states, self.states = self.states, []
        return states

    def end(self) -> None:
        self.listens = self.alive = self.supervisor_alive = False

    def free(self) -> None:
        self.memory.close()
        self.beats.close()


def build_bench_session(
    monkeypatch: pytest.MonkeyPatch,
    is_ready: Callable[[], bool] = lambda: True,
    refusal: str | None = None,
) -> BenchSession:
    """A session of the rig's bench file that is not open yet."""
    script = types.SimpleNamespace(is_ready=is_ready, refusal=refusal)
    monkeypatch.setattr(Processes, "script", script)
    monkeypatch.setattr(supervised_loop, "BenchProcesses", Processes)
    figure = get_figure("4a").build_configuration(load=False)
    return BenchSession("lab", EMULATOR_BENCH, figure, rest=pause)


def say(
    session: BenchSession,
    status: BenchStatus,
    limited_by_heat: Iterable[str] = (),
    fault: Fault | None = None,
) -> None:
    """Send a state of the loop: the session receives it at its next wake-up."""
    assert isinstance(session.loop.processes, Processes)
    event = {"event": "state", "status": status, "problems": [], "homing_step": None}
    reported = {"limited_by_heat": list(limited_by_heat), "fault": asdict(fault) if fault else None}
    session.loop.processes.states.append(event | reported)


def receive(session: BenchSession) -> None:
    """Receive the messages of the loop, and nothing else of a wake-up."""
    session.report.take(session.loop.take_states())


def begin_run(session: BenchSession, ticks: int) -> None:
    """Run this many ticks, which continue."""
    memory, start = session.loop.memory, Start(session.bench.home.lever_ratio, AT_REST)
    memory.begin_run(1)
    session._begin(BenchRun(session.run.configuration, start, memory))
    say(session, BenchStatus.RUN)
    session.wake(0.0)
    write(memory, 0, ticks)
    session.wake(0.0)
