"""What a bench's session holds as its fault: the loop's own, or that the loop is lost."""

import pytest

from svsa.errors import Fault
from svsa.hardware.session.report import FaultLatch


def build_fault(code: str, message: str = "") -> Fault:
    return Fault(code, 0, 100, 0.1, message or code)


OVERLOAD, SILENT = build_fault("overload"), build_fault("drive_silent")
LOST = build_fault("loop_lost", "Nobody has stopped the drives yet.")
STOPPED = build_fault("loop_lost", "The supervisor has.")


@pytest.fixture
def latch() -> FaultLatch:
    return FaultLatch()


def test_the_first_fault_of_the_loop_counts_until_the_loop_clears_it(latch: FaultLatch) -> None:
    assert latch.take_own(OVERLOAD)
    assert not latch.take_own(SILENT)
    assert latch.fault is OVERLOAD
    assert not latch.take_own(None)
    assert latch.fault is None


def test_a_lost_loop_is_told_once_and_what_was_done_comes_to_be_known(latch: FaultLatch) -> None:
    assert latch.take_loss(LOST)
    assert not latch.take_loss(build_fault("loop_lost", LOST.message))
    assert latch.fault is LOST, "nothing is new"
    assert not latch.take_loss(STOPPED)
    assert latch.fault is STOPPED
    assert not latch.take_own(None)
    assert latch.fault is STOPPED, "a loop that knows of no fault was lost all the same"


def test_the_loop_s_own_fault_is_the_better_reason(latch: FaultLatch) -> None:
    latch.take_loss(LOST)
    assert latch.take_own(OVERLOAD)
    assert latch.fault is OVERLOAD
    assert not latch.take_loss(LOST)
    assert latch.fault is OVERLOAD
