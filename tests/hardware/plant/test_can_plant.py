"""The plant over CAN, state by state: frames sent, measurements and rejections."""

import itertools
import math

import can
import pytest

from svsa.actuators.signals import Torque
from svsa.errors import StateError
from svsa.hardware.bench.emulation import Frame
from svsa.hardware.description.file import read_bench
from svsa.hardware.drives.robomodule import Feedback, encode
from svsa.hardware.safety.machine import BenchStatus
from tests.hardware.wired_bench import AT_REST, EMULATOR_BENCH, FakeBeats, WiredBench

PUSH = Torque(0.5, 0.2)


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
        assert [d.mode for d in b.emulator.drives.values()] == [2, 2]
        assert [d.errors for d in b.emulator.drives.values()] == [0, 0], (
            "the drives took every command"
        )


def test_opening_resets_drives_which_may_hold_a_current() -> None:
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
        with pytest.raises(StateError, match="motor 1"):
            b.plant.start(b.now)


def test_axis_that_moved_since_its_reset_is_not_at_its_mark() -> None:
    with WiredBench() as b:
        b.plant.arm(b.now)
        b.tick_until(BenchStatus.READY)
        b.clock.say(Frame(0x700, (500).to_bytes(4, "big", signed=True) + b"\x55" * 4), b.now)
        b.plant.read(b.now, AT_REST)
        with pytest.raises(StateError, match=r"link is 0\.393 rad from zero"):
            b.plant.confirm_home("link", "a test")
        b.plant.arm(b.now)
        assert b.plant.status is BenchStatus.RESET


def test_uncalibrated_bench_does_not_arm_and_reports_why() -> None:
    bench = read_bench(EMULATOR_BENCH)
    bench = bench.changed(motor2=bench.motor2.changed(sign=None))
    with WiredBench(bench) as b, pytest.raises(StateError, match=r"motor2\.sign is not given"):
        b.plant.arm(b.now)


def test_returns_the_torque_of_whole_milliamperes() -> None:
    with WiredBench() as b:
        b.make_run()
        sent = b.tick(2, PUSH)
        one, two = (current for _, _, current in b.read_currents()[-2:])
        assert sent == pytest.approx((one * 50 * 0.9 * 0.0396e-3, two * 50 * 0.9 * 0.0234e-3))
        assert sent.u1 == pytest.approx(0.5, abs=0.9e-3), "within half a mA of what was asked"
        b.tick(10, PUSH)
        target = b.emulator.drives["motor1"].target_nm
        assert target == pytest.approx(sent.u1, rel=1e-9), "and that is what the drive holds"


def test_only_zero_is_sent_outside_run() -> None:
    with WiredBench() as b:
        b.tick(5, PUSH)
        assert b.read_currents() == []
        b.make_ready()
        assert b.tick(20, PUSH) == (0.0, 0.0)
        assert {current for _, _, current in b.read_currents()} == {0}


def test_measured_angles_are_extrapolated_by_their_age() -> None:
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


def test_missing_operator_switch_prevents_start_and_ends_the_run() -> None:
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


def test_unusable_dead_mans_switch_prevents_the_start() -> None:
    with WiredBench(dead_man=True) as b:
        b.make_ready()
        with pytest.raises(StateError, match="dead-man"):
            b.plant.start(b.now)


def test_only_an_emulated_rig_gets_ready_without_a_supervisor() -> None:
    with WiredBench() as b:
        b.emulator._beat = lambda: None  # a bus that does not send EMULATED
        b.emulator._events = [event for event in b.emulator._events if event[0] != 100_000]
        b.plant.arm(b.now)
        b.tick_until(BenchStatus.FAULT)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "supervisor_lost"


def test_old_feedback_removes_the_torque_and_fresh_feedback_restores_it() -> None:
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


def test_early_tick_keeps_the_last_current() -> None:
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
    assert [d.mode for d in b.emulator.drives.values()] == [None, None]
    b.plant.close()
    b.wire.shutdown()


def test_failed_zero_of_one_drive_does_not_prevent_that_of_the_other(
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


def test_lost_bus_is_opened_again_at_arming(monkeypatch: pytest.MonkeyPatch) -> None:
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
def test_other_frames_change_nothing(message: can.Message) -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        before = b.plant.read(b.now, AT_REST).counts
        b.wire.send(message)
        assert b.plant.read(b.now, AT_REST).counts == before
        b.tick(5, PUSH)
        assert b.plant.fault is None


def test_busy_bus_does_not_delay_the_tick() -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        junk = can.Message(arbitration_id=0x456, is_extended_id=False, data=b"")
        for _ in range(10_000):
            b.wire.send(junk)
        b.tick(1, PUSH)
        assert b.plant_bus.recv(0) is not None, "the rest waits for later ticks"


def test_frames_read_before_the_tick_give_the_same_result() -> None:
    readings = []
    for early in (False, True):
        with WiredBench() as b:
            b.make_run(PUSH)
            for _ in range(50):
                if early:
                    b.plant.listen()
                    assert b.plant_bus.recv(0) is None
                b.tick(1, PUSH)
                readings.append(b.reading)
    assert readings[:50] == readings[50:]
    assert len({reading.counts for reading in readings if reading}) > 10


def test_bus_failure_while_listening_is_a_fault_of_the_next_tick() -> None:
    with WiredBench() as b:
        b.make_run(PUSH)
        b.plant_bus.shutdown()
        b.plant.listen()
        assert b.plant.fault is None
        b.tick(2, PUSH)
        assert b.plant.fault is not None
        assert b.plant.fault.code == "bus_error"
