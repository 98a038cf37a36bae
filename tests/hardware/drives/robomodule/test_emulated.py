"""One emulated drive compared with the manufacturer's manual."""

import math

import pytest

from svsa.hardware.bench.emulation import Frame
from svsa.hardware.drives.emulated import Motion
from svsa.hardware.drives.robomodule import (
    Command,
    Config,
    Current,
    CurrentVelocity,
    Feedback,
    Mode,
    Online,
    OpenLoop,
    Reset,
    SetMode,
    build_id,
    decode,
    encode,
)
from svsa.hardware.drives.robomodule.emulated import SETTLE_US, EmulatedRoboModuleDrive
from svsa.hardware.emulator.parameters import EmulatorParameters

START_US = 10_000_000


@pytest.fixture
def drive():
    return EmulatedRoboModuleDrive(EmulatorParameters().motor1)


def receive(drive, frame, time_us):
    return drive.receive(frame, time_us, lambda: Motion(0.0, 0.0))


def report(drive, message, time_us, number=1, group=0):
    address = drive.address._replace(group=group, number=number)
    return receive(drive, Frame(build_id(address, message.command), encode(message)), time_us)


def bring_up(drive, mode=Mode.CURRENT):
    report(drive, Reset(), START_US)
    report(drive, Config(1, 0), START_US + SETTLE_US)
    report(drive, SetMode(mode), START_US + SETTLE_US)
    return START_US + 2 * SETTLE_US


def read(drive, velocity=0.0, torque=0.0):
    return decode(Command.FEEDBACK, drive.build_feedback(Motion(velocity, torque)).data)


def test_sequence_leads_to_a_current(drive):
    ready = bring_up(drive)
    report(drive, Current(5000, 1000), ready)
    assert drive.current_ma == 1000
    assert drive.target_nm == pytest.approx(50 * 0.9 * 0.0396)
    assert drive.errors == 0


def test_mode_is_ignored_in_the_500_ms_after_a_reset(drive):
    report(drive, Reset(), START_US)
    report(drive, SetMode(Mode.CURRENT), START_US + SETTLE_US - 1)
    assert (drive.mode, drive.errors) == (None, 1)
    report(drive, SetMode(Mode.CURRENT), START_US + SETTLE_US)
    assert (drive.mode, drive.errors) == (Mode.CURRENT, 1)


def test_data_are_ignored_in_the_500_ms_after_a_mode(drive):
    ready = bring_up(drive)
    report(drive, Current(5000, 1000), ready - 1)
    assert (drive.current_ma, drive.target_nm, drive.errors) == (0, 0.0, 1)


def test_second_mode_and_data_of_another_mode_are_errors(drive):
    ready = bring_up(drive)
    report(drive, SetMode(Mode.VELOCITY), ready)
    report(drive, OpenLoop(500), ready)
    report(drive, CurrentVelocity(1000, 100), ready)
    assert (drive.mode, drive.errors, drive.target_nm) == (Mode.CURRENT, 3, 0.0)


@pytest.mark.parametrize("mode", [mode for mode in Mode if mode is not Mode.CURRENT])
def test_other_modes_are_accepted_but_move_nothing(drive, mode):
    ready = bring_up(drive, mode)
    report(drive, Current(5000, 1000), ready)
    assert (drive.mode, drive.target_nm) == (mode, 0.0)


def test_last_current_is_held_indefinitely(drive):
    """No command-loss watchdog is documented: the supervisor replaces it."""
    ready = bring_up(drive)
    report(drive, Current(5000, -700), ready)
    before = drive.target_nm
    report(drive, Online(), ready + 3_600_000_000)
    assert drive.target_nm == before != 0.0


def test_reset_ends_the_current_and_zeroes_the_position(drive):
    ready = bring_up(drive)
    report(drive, Current(5000, 1000), ready)
    drive.look(0.3)
    assert read(drive).position_counts != 0
    report(drive, Reset(), ready + 1000)
    assert (drive.mode, drive.current_ma, drive.target_nm) == (None, 0, 0.0)
    assert drive.list_pushed(0, Motion(0.0, 0.0)) == []
    assert read(drive).position_counts == 0
    drive.look(0.3 + 2.0 * math.pi / (50 * 2000))
    assert read(drive).position_counts == 1


def test_broadcast_reaches_its_group_only(drive):
    ready = bring_up(drive)
    for address in ({"number": 2}, {"number": 0, "group": 1}, {"number": 1, "group": 1}):
        report(drive, Reset(), ready, **address)
        assert drive.mode is Mode.CURRENT
    report(drive, Reset(), ready, number=0)
    assert drive.mode is None


def test_online_check_is_echoed_as_the_same_frame(drive):
    ready = bring_up(drive)
    frame = Frame(0x01F, encode(Online()))
    assert receive(drive, frame, ready) == [frame]


def test_positions_are_integer_counts_behind_the_gearbox(drive):
    step = 2.0 * math.pi / (50 * 2000)
    for angle, counts in ((0.49 * step, 0), (0.51 * step, 1), (-0.51 * step, -1), (1.0, 15915)):
        drive.look(angle)
        assert read(drive).position_counts == counts


def test_counts_wrap_at_32_bits(drive):
    drive.look((2**31 + 5) * 2.0 * math.pi / (50 * 2000))
    assert read(drive).position_counts == -(2**31) + 5


@pytest.mark.parametrize("rpm, reported", [(14, 0), (16, 30), (-14, 0), (-16, -30), (1234, 1230)])
def test_velocity_has_a_resolution_of_30_rpm(drive, rpm, reported):
    found = read(drive, velocity=rpm * math.pi / 30.0 / 50)
    assert found.velocity_rpm == reported


def test_reported_current_is_the_actual_current(drive):
    assert read(drive, torque=-50 * 0.9 * 0.0396 * 1.5) == Feedback(-1500, 0, 0)


def test_current_is_clipped_at_the_peak_of_the_drive(drive):
    report(drive, Current(5000, 30_000), bring_up(drive))
    assert drive.target_nm == pytest.approx(15 * 50 * 0.9 * 0.0396)


def test_zero_pwm_gives_no_current(drive):
    report(drive, Current(0, 1000), bring_up(drive))
    assert drive.target_nm == 0.0


@pytest.mark.parametrize("sign", [-1, 1])
def test_reversed_motor_turns_and_counts_in_reverse(sign):
    drive = EmulatedRoboModuleDrive(EmulatorParameters().motor2.changed(sign=sign))
    ready = START_US + 2 * SETTLE_US
    for message, time_us in (
        (Reset(), START_US),
        (SetMode(Mode.CURRENT), START_US + SETTLE_US),
        (Current(5000, 100), ready),
    ):
        report(drive, message, time_us, number=2)
    drive.look(0.1)
    assert math.copysign(1, drive.target_nm) == sign
    assert math.copysign(1, read(drive).position_counts) == sign
    assert read(drive, torque=drive.target_nm).current_ma == 100


@pytest.mark.parametrize(
    "frame",
    [
        Frame(0x013, b""),
        Frame(0x013, b"\x13\x88\x03"),
        Frame(0x013, b"\xff" * 8),
        Frame(0x011, b"\x09" + b"\x55" * 7),
        Frame(0x01E, b"\x55" * 8),
    ],
)
def test_malformed_frame_changes_nothing(drive, frame):
    ready = bring_up(drive)
    report(drive, Current(5000, 250), ready)
    assert receive(drive, frame, ready + 1000) == []
    assert (drive.mode, drive.current_ma) == (Mode.CURRENT, 250)
