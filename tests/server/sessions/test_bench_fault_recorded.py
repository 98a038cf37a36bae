"""A recording on a bench receives the fault that ended its run, and no other."""

from collections.abc import Iterator

import pytest

from svsa.errors import Fault
from svsa.hardware.safety.machine import BenchStatus
from svsa.hardware.session.session import BenchSession
from tests.server.sessions.scripted_bench import build_bench_session, receive, say


class Recording:
    """Stores the reported faults."""

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


def report(session: BenchSession, status: BenchStatus, code: str | None = None) -> None:
    fault = None if code is None else Fault(code, 0, 70, 0.07, "It stopped.")
    say(session, status, fault=fault)
    receive(session)


def test_fault_in_motion_is_the_end_of_the_recorded_run(session: BenchSession) -> None:
    session.journal.recorder = recording = Recording()  # pyright: ignore[reportAttributeAccessIssue]
    report(session, BenchStatus.RUN)
    report(session, BenchStatus.FAULT, "overspeed")
    report(session, BenchStatus.FAULT, "overspeed")
    assert [fault and fault.code for fault in recording.faults] == ["overspeed"]
    assert recording.faults[0] == session.fault


def test_fault_of_a_bench_at_rest_ended_no_run(session: BenchSession) -> None:
    session.journal.recorder = recording = Recording()  # pyright: ignore[reportAttributeAccessIssue]
    report(session, BenchStatus.READY)
    report(session, BenchStatus.FAULT, "drive_silent")
    assert session.fault is not None
    assert recording.faults == []
