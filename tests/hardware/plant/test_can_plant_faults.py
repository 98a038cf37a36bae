"""Every fault of the plant over CAN: its reason, and zero current in time; latched until
cleared.
"""

import math
from collections.abc import Callable

import can
import pytest

from svsa.actuators.faults import BENCH_FAULTS
from svsa.actuators.signals import Disturbance, Torque
from svsa.errors import StateError
from svsa.hardware.bench.emulation import Frame
from svsa.hardware.drives.drive import merge_stops
from svsa.hardware.drives.installed import build_stop
from svsa.hardware.drives.robomodule import Current, Feedback, encode
from svsa.hardware.emulator.faults import (
    BrownOut,
    BusErrors,
    CurrentOffset,
    DropFrames,
    EmulatorFault,
    Silence,
    Stall,
)
from svsa.hardware.encoders.can_node import CanNode
from svsa.hardware.encoders.source import EncoderError
from svsa.hardware.safety.machine import BenchStatus
from tests.hardware.wired_bench import AT_REST, FakeBeats, WiredBench

PUSH = Torque(0.5, 0.2)
FAST = AT_REST._replace(dtheta1=50.0)
Cause = Callable[[WiredBench], None]


def _ask(**asked: object) -> Cause:
    return lambda b: b.ask(**asked)


def _inject(fault: EmulatorFault) -> Cause:
    return lambda b: b.emulator.inject(fault)


def _say(frame: Frame) -> Cause:
    return lambda b: b.clock.say(frame, b.now)


def _quick_stop(b: WiredBench) -> None:
    b.plant.quick_stop(b.now, "a test")


def _miss_ticks(b: WiredBench) -> None:
    b.skip(0.020)
    b.ask(missed=20)


def _jump_to_zero(b: WiredBench) -> None:
    moved = 12_000
    b.clock.say(Frame(0x01B, encode(Feedback(0, 0, moved))), b.now)
    b.clock.say(Frame(0x01B, encode(Feedback(0, 0, 0))), b.now)


def _lose_supervisor(b: WiredBench) -> None:
    b.beats.ages["supervisor"] = 0.101


def _torque_change(b: WiredBench) -> None:
    for turn in range(11):
        b.ask(known=AT_REST._replace(dtheta2=3.0 * (-1) ** turn))


def _overheat(b: WiredBench) -> None:
    b.guard.motor2.winding.heat = 1.06


def _lose_encoder(b: WiredBench) -> None:
    def fail(*_: object) -> None:
        raise EncoderError("the card is gone")

    b.monkeypatch.setattr(CanNode, "read", fail)


def _break_bus(b: WiredBench) -> None:
    """Receiving fails; sending continues, since otherwise the frames could not be checked."""

    def fail(*_: object) -> None:
        raise can.CanOperationError("the adapter is gone")

    b.monkeypatch.setattr(b.plant_bus, "recv", fail)


ALWAYS = {
    "quick_stop": [_quick_stop],
    "stale_feedback": [
        _inject(Silence(node="motor1")),
        _inject(BrownOut(node="motor2")),
        _inject(DropFrames(node="deflection")),
    ],
    "missed_ticks": [_miss_ticks],
    "drive_error": [_inject(Stall(node="motor2"))],
    "drive_zeroed": [_jump_to_zero],
    "bus_error": [_inject(BusErrors()), _break_bus],
    "foreign_command": [
        _say(Frame(0x000, b"\x55" * 8)),
        _say(Frame(0x023, encode(Current(5000, 100)))),
    ],
    "encoder_lost": [_lose_encoder],
    "overload": [_overheat],
    "supervisor_lost": [_lose_supervisor],
}
MOVING = {
    "not_finite": [
        _ask(torque=Torque(math.nan, 0.0)),
        _ask(torque=Torque(0.0, math.inf)),
        _ask(known=AT_REST._replace(q=math.nan)),
        _ask(estimate=Disturbance(math.nan, 0.0, 0.0)),
    ],
    "overspeed": [
        _ask(known=FAST),
        _ask(known=AT_REST._replace(dtheta2=-31.0)),
        _ask(known=AT_REST._replace(dq=26.0)),
    ],
    "position_limit": [
        _ask(known=AT_REST._replace(theta1=2.8, q=2.4)),
        _ask(known=AT_REST._replace(theta1=-2.4, q=-2.6)),
    ],
    "vibration": [_torque_change],
    "implausible": [_ask(estimate=Disturbance(0.0, -12.5, 0.0))],
    "deflection_limit": [_ask(known=AT_REST._replace(q=0.74))],
    "lever_end": [_ask(known=AT_REST._replace(theta2=2.9))],
}
LISTED = [
    pytest.param(
        status,
        code,
        cause,
        id=f"{code}-{number}-in-{status}",
        marks=() if status is BenchStatus.RUN or code == "bus_error" else pytest.mark.exhaustive,
    )
    for statuses, causes in (
        ((BenchStatus.READY, BenchStatus.RUN, BenchStatus.RAMP), ALWAYS),
        ((BenchStatus.RUN, BenchStatus.RAMP), MOVING),
    )
    for status in statuses
    for code, ways in causes.items()
    for number, cause in enumerate(ways)
]
"""`make test` runs each in run; `safety.test_machine` tests every state of the machine."""
ELSEWHERE = {"drive_silent", "encoder_frozen", "singular_decoupling", "loop_late"}
PROCESSES = {"loop_silent", "loop_lost", "loop_and_supervisor_lost"}
"""Detected by the server, with real processes: `test_survivors`."""


def test_every_fault_is_tested() -> None:
    assert ALWAYS.keys() | MOVING.keys() | ELSEWHERE | PROCESSES == BENCH_FAULTS.keys()


@pytest.mark.parametrize(("status", "code", "cause"), LISTED)
def test_every_fault_ends_in_zero_current_in_time(
    status: BenchStatus, code: str, cause: Cause, monkeypatch: pytest.MonkeyPatch
) -> None:
    with WiredBench(beats=FakeBeats()) as b:
        b.monkeypatch, b.push = monkeypatch, PUSH
        b.make_ready()
        if status is not BenchStatus.READY:
            b.plant.start(b.now)
            b.tick(20, PUSH)
        if status is BenchStatus.RAMP:
            b.plant.stop(b.now, "a test")
            b.tick(3, PUSH)
        assert b.plant.status is status
        begin = b.now
        cause(b)
        for _ in range(150):
            if b.plant.fault is None:
                b.tick(1, PUSH)
        assert b.plant.fault is not None
        assert (b.plant.status, b.plant.fault.code) == (BenchStatus.FAULT, code)
        assert b.plant.fault.message
        at = b.now
        b.tick(100, PUSH)
        assert b.find_zero_time(begin) - begin <= BENCH_FAULTS[code] + 1e-9
        assert len(b.find_resets(begin)) == 1
        assert [drive.target_nm for drive in b.emulator.drives.values()] == [0.0, 0.0]
        after = [current for time_s, _, current in b.read_currents(at) if time_s > at]
        assert len(after) >= 2 * 98, "zero again in every tick"
        assert set(after) == {0}


def test_drive_with_uncommanded_current_is_an_overload() -> None:
    with WiredBench() as b:
        b.make_ready()
        b.emulator.inject(CurrentOffset(node="motor2", offset_a=15.0))
        b.tick_until(BenchStatus.FAULT, 0.2)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "overload"


def test_silent_drive_is_named_during_arming() -> None:
    with WiredBench() as b:
        b.emulator.inject(Silence(node="motor2"))
        b.plant.arm(b.now)
        begin = b.now
        b.tick_until(BenchStatus.FAULT)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "drive_silent"
        assert b.now - begin <= BENCH_FAULTS["drive_silent"]


@pytest.mark.parametrize("status", ["off", "reset", "config", "mode", "ready", "run", "ramp"])
def test_quick_stop_latches_in_every_state(status: str) -> None:
    with WiredBench() as b:
        b.tick(5)
        if status in ("reset", "config", "mode"):
            b.plant.arm(b.now)
            b.tick_until(BenchStatus(status))
        elif status != "off":
            b.make_ready()
            if status != "ready":
                b.plant.start(b.now)
            if status == "ramp":
                b.plant.stop(b.now, "a test")
        assert b.plant.status == status
        begin = b.now
        b.plant.quick_stop(b.now, "a test")
        assert b.plant.status is BenchStatus.FAULT
        b.tick(3, PUSH)
        assert {current for time_s, _, current in b.read_currents(begin)} == {0}
        assert len(b.find_resets(begin)) == 1


def test_first_fault_is_latched_until_it_is_cleared() -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        b.plant.quick_stop(b.now, "a test")
        b.plant.fail("bus_error", "a later one", {})
        b.tick(5)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "quick_stop"
        assert b.plant.fault.time_s == pytest.approx(0.003), "in the run's own time"
        for refused in (b.plant.arm, b.plant.start):
            with pytest.raises(StateError, match="fault"):
                refused(b.now)
        b.plant.stop(b.now, "does nothing")
        b.plant.clear(b.now)
        assert b.plant.status is BenchStatus.OFF
        assert b.plant.fault is None
        with pytest.raises(StateError, match="no fault"):
            b.plant.clear(b.now)
        with pytest.raises(StateError, match="READY"):
            b.plant.start(b.now)
        b.make_run(PUSH)
        assert b.plant.status is BenchStatus.RUN


def test_earlier_faults_do_not_count_after_arming() -> None:
    with WiredBench() as b:
        b.emulator.inject(BusErrors(count=3))
        b.clock.say(Frame(0x01D, b"\x01" + b"\x55" * 7), b.now)
        b.tick(5)
        assert b.plant.status is BenchStatus.OFF
        b.make_run(PUSH)
        assert b.plant.status is BenchStatus.RUN


@pytest.mark.parametrize("heard", ["in the late tick", "in the one after it"])
def test_suspended_loop_names_itself_and_not_another_program(heard: str) -> None:
    """The supervisor's frames are on the bus; the reported reason is the delay of the loop."""
    with WiredBench(beats=FakeBeats(), missed_ticks=100) as b:
        b.make_run(PUSH)
        b.skip(0.05)
        b.beats.stops += 1
        stops = merge_stops(build_stop(b.bench.motor1), build_stop(b.bench.motor2))
        if heard == "in the one after it":
            b.tick(1, PUSH, missed=50)
            assert b.plant.fault is not None
        for frame in stops:
            b.clock.say(Frame(frame.arbitration_id, bytes(frame.data)), b.now)
        b.tick(1, PUSH, missed=50 if heard == "in the late tick" else 0)
        fault = b.plant.fault
        assert fault is not None
        assert (fault.code, fault.values["late_s"]) == ("loop_late", 0.05)
        assert "supervisor" in fault.message


def test_late_loop_before_arming_is_no_fault_of_the_next_run() -> None:
    with WiredBench(beats=FakeBeats()) as b:
        b.beats.stops += 1
        b.make_run(PUSH)
        b.tick(10, PUSH)
        assert b.plant.status is BenchStatus.RUN
