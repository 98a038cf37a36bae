"""Every injectable fault of the emulator has its effect, and can be removed."""

import itertools

import pytest
from pydantic import TypeAdapter, ValidationError

from svsa.errors import ParameterError
from svsa.hardware.drives.robomodule import Command, Current, Mode, decode
from svsa.hardware.emulator.faults import (
    BrownOut,
    BusErrors,
    CurrentOffset,
    DropFrames,
    EmulatorFault,
    FrozenEncoder,
    LateFrames,
    ReversedEncoder,
    ReversedMotor,
    Silence,
    Stall,
)

from .test_emulator import LOOP, READY_US, bring_up, build, list_times, run

MOTORS = (("motor1", 0x01B, 1), ("motor2", 0x02B, 2))
NODES = (*((name, can_id) for name, can_id, _ in MOTORS), ("deflection", 0x700))


def read_counts(said, can_id):
    frames = [frame for _, frame, _ in said if frame.can_id == can_id]
    if can_id == 0x700:
        return [int.from_bytes(frame.data[:4], "big", signed=True) for frame in frames]
    return [decode(Command.FEEDBACK, frame.data).position_counts for frame in frames]


def drive_out(tick):
    return 600, 120


@pytest.mark.parametrize("node, can_id", NODES)
def test_frames_are_dropped_by_probability_and_seed(node, can_id):
    found = []
    for _ in range(2):
        emulator = bring_up()
        emulator.inject(DropFrames(node=node, probability=0.5))
        found.append(list_times(run(emulator, 200), can_id))
    assert 60 < len(found[0]) < 140
    assert found[0] == found[1]


@pytest.mark.parametrize("node, can_id", NODES)
def test_frames_of_one_node_are_lost_while_others_arrive(node, can_id):
    emulator = bring_up()
    emulator.inject(DropFrames(node=node))
    said = run(emulator, 20)
    for _, other in NODES:
        assert len(list_times(said, other)) == (0 if other == can_id else 20)
    emulator.clear_faults()
    assert emulator.advance_to(READY_US + 25_000)
    assert emulator.now_us == READY_US + 25_000


@pytest.mark.parametrize("node, can_id", NODES)
def test_late_frames_contain_counts_as_old_as_their_delay(node, can_id):
    """The bus stamps them on arrival: their age is visible in the motion, not in the stamp."""
    said = {}
    for late in (False, True):
        emulator = bring_up()
        if late:
            emulator.inject(LateFrames(node=node, delay_s=0.004))
        said[late] = run(emulator, 60, drive_out)
    assert list_times(said[True], can_id)[0] - list_times(said[False], can_id)[0] == 4000
    late, prompt = (read_counts(said[key], can_id) for key in (True, False))
    assert late == prompt[: len(late)]


@pytest.mark.parametrize("node, can_id", NODES)
def test_frozen_encoder_is_constant_while_frames_arrive(node, can_id):
    emulator = bring_up()
    before = read_counts(run(emulator, 10, drive_out), can_id)[-1]
    emulator.inject(FrozenEncoder(node=node))
    said = emulator.advance_to(READY_US + 60_000)
    assert set(read_counts(said, can_id)) == {before}
    assert len(list_times(said, can_id)) == 50


@pytest.mark.parametrize("node, can_id", NODES)
def test_reversed_encoder_counts_in_reverse(node, can_id):
    counts = []
    for turned in (False, True):
        emulator = bring_up()
        if turned:
            emulator.inject(ReversedEncoder(node=node))
        counts.append(read_counts(run(emulator, 30, drive_out), can_id)[-1])
    assert counts[0] != 0
    assert abs(counts[0] + counts[1]) <= 1


@pytest.mark.parametrize("node, can_id, number", MOTORS)
def test_reversed_motor_turns_in_reverse_and_reports_the_commanded_current(node, can_id, number):
    emulator = bring_up()
    emulator.inject(ReversedMotor(node=node))
    said = run(emulator, 30, drive_out)
    assert read_counts(said, can_id)[-1] < 0
    last = [frame for _, frame, _ in said if frame.can_id == can_id][-1]
    assert decode(Command.FEEDBACK, last.data).current_ma == drive_out(0)[number - 1]


@pytest.mark.parametrize("node, can_id, number", MOTORS)
def test_brown_out_ends_mode_current_and_feedback(node, can_id, number):
    emulator = bring_up()
    run(emulator, 20, drive_out)
    emulator.inject(BrownOut(node=node))
    drive = emulator.drives[node]
    assert (drive.mode, drive.current_ma, drive.target_nm) == (None, 0, 0.0)
    assert len(list_times(emulator.advance_to(READY_US + 50_000), can_id)) == 0
    assert drive.errors == 0
    emulator.receive(build(Current(5000, 100), number), LOOP)
    emulator.advance_to(READY_US + 60_000)
    assert (drive.errors, drive.target_nm) == (1, 0.0)


@pytest.mark.parametrize("node, can_id, number", MOTORS)
def test_stall_protection_stops_the_motor_and_is_reported_every_100_ms(node, can_id, number):
    emulator = bring_up()
    run(emulator, 20, drive_out)
    emulator.inject(Stall(node=node))
    assert emulator.drives[node].target_nm == 0.0
    times = list_times(emulator.advance_to(READY_US + 600_000), number << 4 | Command.ERROR)
    assert 5 <= len(times) <= 6
    assert {b - a for a, b in itertools.pairwise(times)} == {100_000}


@pytest.mark.parametrize("node, can_id, number", MOTORS)
def test_silent_drive_neither_sends_nor_receives(node, can_id, number):
    emulator = bring_up()
    run(emulator, 20, drive_out)
    emulator.inject(Silence(node=node))
    emulator.receive(build(Current(5000, 900), number), LOOP)
    said = emulator.advance_to(READY_US + 50_000)
    assert list_times(said, can_id) == []
    assert emulator.drives[node].target_nm == 0.0
    emulator.clear_faults()
    assert emulator.drives[node].mode is None


def test_bus_errors_are_sent_as_error_frames():
    emulator = bring_up()
    emulator.inject(BusErrors(count=7))
    errors = [frame for _, frame, _ in emulator.advance_to(READY_US + 20_000) if frame.error]
    assert len(errors) == 7


@pytest.mark.parametrize("node, can_id, number", MOTORS)
def test_current_offset_acts_without_a_command(node, can_id, number):
    emulator = bring_up()
    emulator.inject(CurrentOffset(node=node, offset_a=0.4))
    assert emulator.drives[node].target_nm > 0.0
    assert emulator.drives[node].current_ma == 0
    emulator.clear_faults()
    assert emulator.drives[node].target_nm == 0.0
    assert emulator.drives[node].mode is Mode.CURRENT


@pytest.mark.parametrize(
    "written",
    [
        {"kind": "freeze", "node": "motor3"},
        {"kind": "stall", "node": "deflection"},
        {"kind": "drop", "node": "motor1", "probability": 2},
        {"kind": "late", "node": "motor1"},
        {"kind": "fire"},
    ],
)
def test_invalid_fault_is_rejected(written):
    with pytest.raises((ValidationError, ParameterError)):
        TypeAdapter(EmulatorFault).validate_python(written)
