"""After any end of a bench check the bench is in its initial state, at zero current."""

import contextlib

import can
import pytest

from svsa.hardware.bench.emulation import Frame
from svsa.hardware.commissioning import check_bench
from svsa.hardware.commissioning.step import Result
from svsa.hardware.drives.bus import BusError
from svsa.hardware.drives.robomodule import (
    Address,
    Command,
    Current,
    build_id,
    encode,
    split_id,
)
from tests.exhaustive import exhaust
from tests.hardware.commissioning.checked_bench import assert_left_alone, check


def test_bench_in_use_is_not_disturbed(path, bus):
    """Another program sends currents: the check only listens, and sends no reset."""
    frame = Frame(build_id(Address(0, 1), Command.CURRENT), encode(Current(5000, 0)))
    for time_us in range(0, 400_000, 1000):
        bus.emulator.schedule(time_us, lambda: bus.emulator.receive(frame, "the lab"))
    steps = check(path, bus)
    assert steps["bus"].result is Result.FAIL
    assert "another program" in steps["bus"].advice
    assert bus.sent == []


def test_interrupted_pulse_leaves_zero_current(path, bus):
    """Ctrl-C at the worst time: while a motor has current."""

    def interrupt(message):
        if split_id(message.arbitration_id)[1] is Command.CURRENT and any(message.data[2:4]):
            interrupt.count += 1
            if interrupt.count == 20:
                raise KeyboardInterrupt

    interrupt.count = 0
    bus.before_send = interrupt
    with (
        pytest.raises(KeyboardInterrupt),
        contextlib.closing(check_bench(path, True, None, bus.open, bus.now)) as steps,
    ):
        for _ in steps:
            pass
    assert interrupt.count == 20
    assert_left_alone(bus)


@pytest.mark.parametrize("count", exhaust(range(1, 14), [4, 9, 13]))
def test_check_that_stops_at_any_step_leaves_zero_current(path, bus, count):
    """The reader of the steps may stop after any of them."""
    with contextlib.closing(check_bench(path, True, None, bus.open, bus.now)) as steps:
        for _ in range(count):
            next(steps)
    assert_left_alone(bus)


def test_lost_bus_is_a_step(path, bus):
    def lose_bus(message):
        if bus.now() > 1.0:
            raise can.CanOperationError("the adapter was pulled out")

    bus.before_send = lose_bus
    steps = list(check_bench(path, True, None, bus.open, bus.now))
    assert steps[-2].name == "bus"
    assert "pulled out" in steps[-2].measured
    assert not bus.is_open


def test_lost_reset_is_repeated(path, bus):
    """The check waits until the drives are silent."""
    lost = []

    def lose(message):
        if message.arbitration_id == 0 and not lost:
            lost.append(message)
            raise can.CanOperationError("no buffer space")

    bus.before_send = lose
    check(path, bus)
    assert len(lost) == 1


def test_rig_in_lockstep_is_not_waited_for(path, bus):
    """Its time stops while the check listens: nothing is opened, and the report states why."""
    text = path.read_text(encoding="utf-8")
    emulator = "\n[emulator]\ncontrol_port = 9\nlockstep = true\n"
    path.write_text(text.partition("\n[emulator]")[0] + emulator, encoding="utf-8")
    opened = []
    steps = list(check_bench(path, opener=opened.append, now=bus.now))
    assert [step.name for step in steps] == ["file", "bus"]
    assert steps[1].result is Result.FAIL
    assert "lockstep" in steps[1].measured
    assert "lockstep = false" in steps[1].advice
    assert not opened


def test_bus_that_cannot_be_opened_is_reported_with_instructions(path, bus):
    def reject(settings):
        raise BusError("The CAN bus cannot be opened: no such device.")

    steps = list(check_bench(path, opener=reject, now=bus.now))
    assert [step.result for step in steps[:2]] == [Result.OK, Result.FAIL]
    assert "no such device" in steps[1].measured
    assert "socketcand server" in steps[1].advice
