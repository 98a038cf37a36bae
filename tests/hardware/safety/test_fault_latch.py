"""The fault latch of loop and server: the first fault counts, except after a lost loop."""

import pytest

from svsa.errors import Fault
from svsa.hardware.safety.faults import FaultLatch


def build_fault(code: str, message: str = "") -> Fault:
    return Fault(code, 0, 100, 0.1, message or code)


OVERLOAD, SILENT = build_fault("overload"), build_fault("drive_silent")
LOST = build_fault("loop_lost", "The drives are not stopped yet.")
STOPPED = build_fault("loop_lost", "The supervisor has.")


@pytest.fixture
def latch() -> FaultLatch:
    return FaultLatch()


def test_first_fault_of_the_loop_counts_until_the_loop_clears_it(latch: FaultLatch) -> None:
    assert latch.take(OVERLOAD)
    assert not latch.take(SILENT)
    assert latch.fault is OVERLOAD
    latch.clear_reported()
    assert latch.fault is None


def test_lost_loop_is_reported_once_and_its_stop_later(
    latch: FaultLatch,
) -> None:
    assert latch.take(LOST)
    assert not latch.take(build_fault("loop_lost", LOST.message))
    assert latch.fault is LOST, "nothing is new"
    assert not latch.take(STOPPED)
    assert latch.fault is STOPPED
    latch.clear_reported()
    assert latch.fault is STOPPED, "a loop that knows of no fault was lost all the same"


def test_fault_of_the_loop_replaces_a_lost_loop(latch: FaultLatch) -> None:
    latch.take(LOST)
    assert latch.take(OVERLOAD)
    assert latch.fault is OVERLOAD
    assert not latch.take(LOST)
    assert latch.fault is OVERLOAD


@pytest.mark.parametrize("fault", [OVERLOAD, LOST])
def test_cleared_latch_takes_the_next_fault(latch: FaultLatch, fault: Fault) -> None:
    latch.take(fault)
    latch.clear()
    assert latch.fault is None
    assert latch.take(SILENT)
    assert latch.fault is SILENT
