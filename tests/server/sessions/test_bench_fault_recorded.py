"""A recording at a bench is told of the fault that ended its run, and of no other."""

from collections.abc import Iterator
from typing import Any

import pytest

from svsa.bench.safety.machine import BenchStatus
from svsa.errors import Fault
from svsa.session.bench import BenchSession
from tests.server.sessions.scripted_bench import build_bench_session


class Recording:
    """Keeps what it is told."""

    def __init__(self) -> None:
        self.faults: list[Fault | None] = []

    def write_fault(self, fault: Fault | None) -> None:
        self.faults.append(fault)

    def close(self, wait_s: float) -> None:
        pass


@pytest.fixture
def session(monkeypatch: pytest.MonkeyPatch) -> Iterator[BenchSession]:
    made = build_bench_session(monkeypatch)
    made.open()
    yield made
    made.close()


def tell(session: BenchSession, status: BenchStatus, code: str | None = None) -> None:
    """What the loop says of itself, as it comes with the next wake."""
    fault: dict[str, Any] | None = None
    if code is not None:
        fault = {"code": code, "lane": 0, "tick": 70, "time_s": 0.07, "message": "It stopped."}
    event = {"event": "state", "status": status, "problems": [], "homing_step": None}
    told = event | {"held_back": [], "fault": fault}
    session.loop.processes.take_events = lambda: [told]  # pyright: ignore
    session._take_states(session.loop.take_states())


def test_a_fault_in_motion_is_the_end_of_the_recorded_run(session: BenchSession) -> None:
    session.journal.recorder = recording = Recording()  # pyright: ignore[reportAttributeAccessIssue]
    tell(session, BenchStatus.RUN)
    tell(session, BenchStatus.FAULT, "overspeed")
    tell(session, BenchStatus.FAULT, "overspeed")
    assert [fault and fault.code for fault in recording.faults] == ["overspeed"]
    assert recording.faults[0] == session.fault


def test_a_fault_of_a_bench_at_rest_ended_no_run(session: BenchSession) -> None:
    session.journal.recorder = recording = Recording()  # pyright: ignore[reportAttributeAccessIssue]
    tell(session, BenchStatus.READY)
    tell(session, BenchStatus.FAULT, "drive_silent")
    assert session.fault is not None
    assert recording.faults == []
