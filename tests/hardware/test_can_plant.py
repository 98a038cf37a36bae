"""A bench on its bus: from OFF to RUN, what is sent, and every fault to zero current in time.

Zero current is looked for where a sniffer would: in the commands on the wire.
"""

import itertools
import math
from collections.abc import Callable

import can
import pytest

from svsa.errors import StateError
from svsa.hardware.bench import read_bench
from svsa.hardware.encoders.can_node import CanNode
from svsa.hardware.encoders.source import EncoderError
from svsa.hardware.faults import FAULTS
from svsa.hardware.machine import BenchStatus
from svsa.hardware.robomodule import Current, Feedback, encode
from svsa.rig.faults import (
    BrownOut,
    BusErrors,
    CurrentOffset,
    DropFrames,
    RigFault,
    Silence,
    Stall,
)
from svsa.rig.frame import Frame
from svsa.signals import Disturbance, Torque
from tests.hardware.wired_bench import AT_REST, RIG_BENCH, FakeBeats, WiredBench

PUSH = Torque(0.5, 0.2)
FAST = AT_REST._replace(dtheta1=50.0)
Cause = Callable[[WiredBench], None]


def test_arms_step_by_step_and_starts_at_zero() -> None:
    with WiredBench() as b:
        seen = [b.plant.status]
        b.plant.arm(b.now)
        while seen[-1] is not BenchStatus.READY:
            b.tick()
            if b.plant.status is not seen[-1]:
                seen.append(b.plant.status)
        assert seen == ["off", "reset", "config", "mode", "ready"]
        assert b.now > 1.0, "500 ms after the reset and again after the mode"
        b.tick(3)
        assert {current for _, _, current in b.read_currents()} == {0}
        assert [d.mode for d in b.rig.drives.values()] == [2, 2]
        assert [d.errors for d in b.rig.drives.values()] == [0, 0], "the drives took every command"


def test_opening_resets_the_drives_which_may_hold_a_current() -> None:
    with WiredBench() as b:
        b.tick()
        assert b.find_resets() == [0.0]
        assert b.plant.emulated is False
        b.tick(200)
        assert b.plant.emulated is True


def test_start_needs_ready_and_every_mark() -> None:
    with WiredBench() as b:
        with pytest.raises(StateError, match="READY"):
            b.plant.start(b.now)
        with pytest.raises(StateError, match="READY"):
            b.plant.confirm_home("link", "a test")
        b.plant.arm(b.now)
        b.tick_until(BenchStatus.READY)
        b.plant.confirm_home("link", "a test")
        with pytest.raises(StateError, match="motor1"):
            b.plant.start(b.now)


def test_an_axis_that_moved_since_its_reset_is_not_at_its_mark() -> None:
    with WiredBench() as b:
        b.plant.arm(b.now)
        b.tick_until(BenchStatus.READY)
        b.clock.say(Frame(0x700, (500).to_bytes(4, "big", signed=True) + b"\x55" * 4), b.now)
        b.plant.read(b.now, AT_REST)
        with pytest.raises(StateError, match=r"link is 0\.393 rad from zero"):
            b.plant.confirm_home("link", "a test")
        b.plant.arm(b.now)
        assert b.plant.status is BenchStatus.RESET


def test_an_uncalibrated_bench_does_not_arm_and_says_why() -> None:
    bench = read_bench(RIG_BENCH)
    bench = bench.changed(motor2=bench.motor2.changed(sign=None))
    with WiredBench(bench) as b, pytest.raises(StateError, match=r"\[motor2\] sign is not given"):
        b.plant.arm(b.now)


def test_returns_the_torque_of_whole_milliamperes() -> None:
    with WiredBench() as b:
        b.make_run()
        sent = b.tick(2, PUSH)
        one, two = (current for _, _, current in b.read_currents()[-2:])
        assert sent == pytest.approx((one * 50 * 0.9 * 0.0396e-3, two * 50 * 0.9 * 0.0234e-3))
        assert sent.u1 == pytest.approx(0.5, abs=0.9e-3), "within half a mA of what was asked"
        b.tick(10, PUSH)
        target = b.rig.drives["motor1"].target_nm
        assert target == pytest.approx(sent.u1, rel=1e-9), "and that is what the drive holds"


def test_outside_run_nothing_but_zero_is_sent() -> None:
    with WiredBench() as b:
        b.tick(5, PUSH)
        assert b.read_currents() == []
        b.make_ready()
        assert b.tick(20, PUSH) == (0.0, 0.0)
        assert {current for _, _, current in b.read_currents()} == {0}


def test_measures_angles_moved_on_to_now_by_their_age() -> None:
    with WiredBench() as b:
        b.make_ready()
        b.clock.say(Frame(0x01B, encode(Feedback(0, 0, 1000))), b.now)
        known = AT_REST._replace(dq=3.0, dtheta1=2.0, dtheta2=-1.0)
        reading = b.plant.read(b.now + 0.003, known)
        assert reading.measurement is not None
        assert reading.ages_s[0] == pytest.approx(0.003 + b.bench.timing.feedback_age_s)
        theta1 = 1000 * 2.0 * math.pi / 2000 / 50
        assert reading.measurement.theta1 == pytest.approx(theta1 + 2.0 * reading.ages_s[0])
        assert reading.measurement.theta2 == pytest.approx(-reading.ages_s[1])
        assert reading.measurement.phi == pytest.approx(reading.ages_s[2])
        assert reading.measurement[3:] == (3.0, 2.0, -1.0)


def test_stop_ramps_to_zero_and_ends_ready() -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        b.plant.stop(b.now, "a test")
        begin, sent = b.now, []
        while b.plant.status is not BenchStatus.READY:
            sent.append(b.tick(1, PUSH).u1)
            assert b.plant.status in (BenchStatus.RAMP, BenchStatus.READY)
        assert b.now - begin == pytest.approx(0.3, abs=0.002)
        steps = [before - after for before, after in itertools.pairwise(sent)]
        assert all(0.0 <= step < 0.006 for step in steps), "even steps down"
        assert sent[0] > 0.49
        assert sent[-1] == 0.0
        b.plant.start(b.now)
        assert b.plant.status is BenchStatus.RUN, "and may go on without being armed again"


def test_without_the_operators_switch_it_neither_starts_nor_goes_on() -> None:
    beats = FakeBeats()
    with WiredBench(beats=beats, dead_man=True) as b:
        b.make_ready()
        beats.ages["operator"] = 0.2
        with pytest.raises(StateError, match="dead-man"):
            b.plant.start(b.now)
        beats.ages["operator"] = 0.05
        b.plant.start(b.now)
        b.tick(5, PUSH)
        beats.ages["operator"] = 0.11
        b.tick(1, PUSH)
        assert b.plant.status is BenchStatus.RAMP
        b.tick_until(BenchStatus.READY, 0.4, torque=PUSH)


def test_a_dead_mans_switch_that_nobody_can_hold_keeps_it_still() -> None:
    with WiredBench(dead_man=True) as b:
        b.make_ready()
        with pytest.raises(StateError, match="dead-man"):
            b.plant.start(b.now)


def test_without_a_supervisor_only_an_emulated_rig_gets_ready() -> None:
    with WiredBench() as b:
        b.rig._beat = lambda: None  # a bus that does not say EMULATED
        b.rig._events = [event for event in b.rig._events if event[0] != 100_000]
        b.plant.arm(b.now)
        b.tick_until(BenchStatus.FAULT)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "supervisor_lost"


def test_old_feedback_takes_the_torque_away_and_fresh_gives_it_back() -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        b.clock.mute = True
        b.tick(3, PUSH)
        assert b.tick(1, PUSH).u1 > 0.0, "younger than 5 ms"
        assert b.tick(2, PUSH) == (0.0, 0.0)
        assert b.plant.status is BenchStatus.RUN
        b.clock.mute = False
        b.tick(2, PUSH)
        assert b.tick(1, PUSH).u1 > 0.0


def test_a_tick_too_early_leaves_the_last_current() -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        count = len(b.read_currents())
        sent = b.plant.write(b.now + 0.0005, Torque(0.1, 0.1), AT_REST, b.undisturbed, 0)
        b.clock.collect()
        assert len(b.read_currents()) == count
        assert sent.u1 == pytest.approx(0.5, abs=1e-3), "the torque that the drive still makes"
        assert b.plant.skipped_commands == 2


def test_close_leaves_zero_current_and_drives_without_mode() -> None:
    b = WiredBench()
    b.make_run(PUSH)
    begin = b.now
    b.plant.close()
    b.clock.wait_until(b.now + 0.01)
    assert b.read_currents(begin)[-2:] == [(b.find_zero_time(begin), n, 0) for n in (1, 2)]
    assert [d.mode for d in b.rig.drives.values()] == [None, None]
    b.plant.close()
    b.wire.shutdown()


def _ask(**asked: object) -> Cause:
    return lambda b: b.ask(**asked)


def _inject(fault: RigFault) -> Cause:
    return lambda b: b.rig.inject(fault)


def _say(frame: Frame) -> Cause:
    return lambda b: b.clock.say(frame, b.now)


def _stop_at_once(b: WiredBench) -> None:
    b.plant.emergency_stop(b.now, "a test")


def _miss_ticks(b: WiredBench) -> None:
    b.skip(0.020)
    b.ask(missed=20)


def _jump_to_zero(b: WiredBench) -> None:
    moved = 12_000
    b.clock.say(Frame(0x01B, encode(Feedback(0, 0, moved))), b.now)
    b.clock.say(Frame(0x01B, encode(Feedback(0, 0, 0))), b.now)


def _lose_supervisor(b: WiredBench) -> None:
    b.beats.ages["supervisor"] = 0.101


def _shake(b: WiredBench) -> None:
    for turn in range(11):
        b.ask(known=AT_REST._replace(dtheta2=3.0 * (-1) ** turn))


def _overheat(b: WiredBench) -> None:
    b.guard.motor2.heat = 1.06


def _lose_encoder(b: WiredBench) -> None:
    def fail(*_: object) -> None:
        raise EncoderError("the card is gone")

    b.monkeypatch.setattr(CanNode, "read", fail)


def _break_bus(b: WiredBench) -> None:
    """Receiving fails; sending goes on, or nothing could be said of the wire."""

    def fail(*_: object) -> None:
        raise can.CanOperationError("the adapter is gone")

    b.monkeypatch.setattr(b.plant_bus, "recv", fail)


ALWAYS = {
    "emergency_stop": [_stop_at_once],
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
    "vibration": [_shake],
    "implausible": [_ask(estimate=Disturbance(0.0, -12.5, 0.0))],
    "deflection_limit": [_ask(known=AT_REST._replace(q=0.74))],
    "lever_end": [_ask(known=AT_REST._replace(theta2=2.9))],
}
LISTED = [
    pytest.param(status, code, cause, id=f"{code}-{number}-in-{status}")
    for statuses, causes in (
        ((BenchStatus.READY, BenchStatus.RUN, BenchStatus.RAMP), ALWAYS),
        ((BenchStatus.RUN, BenchStatus.RAMP), MOVING),
    )
    for status in statuses
    for code, ways in causes.items()
    for number, cause in enumerate(ways)
]
ELSEWHERE = {"drive_silent", "encoder_frozen", "singular_decoupling"}


def test_every_fault_is_tested() -> None:
    assert ALWAYS.keys() | MOVING.keys() | ELSEWHERE == FAULTS.keys()


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
        assert b.find_zero_time(begin) - begin <= FAULTS[code].within_s + 1e-9
        assert len(b.find_resets(begin)) == 1
        assert [drive.target_nm for drive in b.rig.drives.values()] == [0.0, 0.0]
        after = [current for time_s, _, current in b.read_currents(at) if time_s > at]
        assert len(after) >= 2 * 98, "zero again in every tick"
        assert set(after) == {0}


def test_a_drive_that_makes_current_of_its_own_is_an_overload() -> None:
    with WiredBench() as b:
        b.make_ready()
        b.rig.inject(CurrentOffset(node="motor2", offset_a=15.0))
        b.tick_until(BenchStatus.FAULT, 0.2)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "overload"


def test_a_drive_that_says_nothing_is_named_while_arming() -> None:
    with WiredBench() as b:
        b.rig.inject(Silence(node="motor2"))
        b.plant.arm(b.now)
        begin = b.now
        b.tick_until(BenchStatus.FAULT)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "drive_silent"
        assert b.now - begin <= FAULTS["drive_silent"].within_s


@pytest.mark.parametrize("status", ["off", "reset", "config", "mode", "ready", "run", "ramp"])
def test_an_emergency_stop_latches_in_every_state(status: str) -> None:
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
        b.plant.emergency_stop(b.now, "a test")
        assert b.plant.status is BenchStatus.FAULT
        b.tick(3, PUSH)
        assert {current for time_s, _, current in b.read_currents(begin)} == {0}
        assert len(b.find_resets(begin)) == 1


def test_the_first_fault_stays_until_it_is_cleared_and_then_all_begins_again() -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        b.plant.emergency_stop(b.now, "a test")
        b.plant.fail("bus_error", "a later one", {})
        b.tick(5)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "emergency_stop"
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


def test_faults_of_before_do_not_count_after_arming() -> None:
    with WiredBench() as b:
        b.rig.inject(BusErrors(count=3))
        b.clock.say(Frame(0x01D, b"\x01" + b"\x55" * 7), b.now)
        b.tick(5)
        assert b.plant.status is BenchStatus.OFF
        b.make_run(PUSH)
        assert b.plant.status is BenchStatus.RUN


def test_one_drive_that_cannot_be_told_zero_does_not_keep_the_other(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        send = b.plant_bus.send

        def send_but_not_to_motor1(message: can.Message) -> None:
            if message.arbitration_id == 0x013:
                raise can.CanOperationError("buffer full")
            send(message)

        monkeypatch.setattr(b.plant_bus, "send", send_but_not_to_motor1)
        begin = b.now
        b.tick(5, PUSH)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "bus_error"
        assert [n for _, n, current in b.read_currents(begin) if current == 0 and n == 2]
        monkeypatch.undo()
        b.tick(3, PUSH)
        assert b.find_zero_time(begin) <= b.now


def test_a_lost_bus_is_opened_again_when_it_is_armed(monkeypatch: pytest.MonkeyPatch) -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        b.plant_bus.shutdown()
        b.tick(2, PUSH)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "bus_error"
        b.plant.clear(b.now)
        b.make_run(PUSH)
        assert b.plant.status is BenchStatus.RUN


@pytest.mark.parametrize(
    "message",
    [
        can.Message(arbitration_id=0x01B, is_extended_id=False, data=b"\x00\x01"),
        can.Message(arbitration_id=0x01B, is_extended_id=False, is_remote_frame=True, dlc=8),
        can.Message(arbitration_id=0x01D, is_extended_id=True, data=b"\x01" * 8),
        can.Message(arbitration_id=0x700, is_extended_id=False, data=b"\x01"),
        can.Message(arbitration_id=0x456, is_extended_id=False, data=b""),
    ],
    ids=["short", "remote", "extended", "short node", "a stranger"],
)
def test_frames_that_are_not_for_us_change_nothing(message: can.Message) -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        before = b.plant.read(b.now, AT_REST).counts
        b.wire.send(message)
        assert b.plant.read(b.now, AT_REST).counts == before
        b.tick(5, PUSH)
        assert b.plant.fault is None


def test_a_babbling_bus_does_not_hold_the_tick_up() -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        junk = can.Message(arbitration_id=0x456, is_extended_id=False, data=b"")
        for _ in range(10_000):
            b.wire.send(junk)
        b.tick(1, PUSH)
        assert b.plant_bus.recv(0) is not None, "the rest waits for later ticks"
