"""The complete emulator: times of its frames, and equal frames for equal commands."""

import itertools

import pytest

from svsa.hardware.bench.emulation import EMULATED_ID, Frame
from svsa.hardware.drives.robomodule import (
    Address,
    Command,
    Config,
    Current,
    Mode,
    Reset,
    SetMode,
    build_id,
    decode,
    encode,
)
from svsa.hardware.emulator.emulator import FRAME_US, Emulator
from svsa.simulation.plant.loads.constant import ConstantLoad

LOOP = "the loop's connection"
READY_US = 1_200_000


def build(message, number):
    return Frame(build_id(Address(0, number), message.command), encode(message))


def bring_up(feedback_ms=1, inputs_ms=0):
    emulator = Emulator()
    emulator.receive(build(Reset(), 0), LOOP)
    emulator.advance_to(600_000)
    for message in (Config(feedback_ms, inputs_ms), SetMode(Mode.CURRENT)):
        for number in (1, 2):
            emulator.receive(build(message, number), LOOP)
    emulator.advance_to(READY_US)
    return emulator


def run(emulator, ticks, currents=lambda _: (300, -40)):
    said = []
    for tick in range(ticks):
        for number, current in zip((1, 2), currents(tick), strict=True):
            emulator.receive(build(Current(5000, current), number), LOOP)
        said += emulator.advance_to(READY_US + 1000 * (tick + 1))
    return said


def list_times(said, can_id):
    return [time_us for time_us, frame, _ in said if frame.can_id == can_id]


def test_nodes_send_at_their_own_times_in_each_ms():
    """No node is synchronous with another or with the loop, as on a bench."""
    said = run(bring_up(), 3)
    for can_id, phase in ((0x01B, 300), (0x02B, 500), (0x700, 800)):
        times = list_times(said, can_id)
        assert times == [READY_US + 1000 * k + phase + FRAME_US for k in range(3)]


@pytest.mark.parametrize("period", [2, 5])
def test_feedback_and_inputs_arrive_at_the_configured_period(period):
    said = run(bring_up(period, period), 20)
    for can_id in (0x01B, 0x01C, 0x02B, 0x02C):
        gaps = {b - a for a, b in itertools.pairwise(list_times(said, can_id))}
        assert gaps == {1000 * period}


def test_only_the_deflection_is_sent_before_a_mode():
    emulator = Emulator()
    emulator.receive(build(Config(1, 1), 1), LOOP)
    ids = {frame.can_id for _, frame, _ in emulator.advance_to(300_000)}
    assert ids == {build_id(Address(0, 1), Command.CONFIG), 0x700, EMULATED_ID}


def test_frames_are_spaced_by_the_length_of_a_frame():
    """Ten at once take 1.3 ms; the lowest identifier is sent first."""
    emulator = bring_up(0)
    emulator.advance_to(READY_US + 940)
    for number in range(15, 5, -1):
        emulator.receive(Frame(0x100 + number, b"\x55" * 8), LOOP)
    said = [
        (time_us, frame.can_id)
        for time_us, frame, sender in emulator.advance_to(READY_US + 5000)
        if sender is LOOP
    ]
    assert [can_id for _, can_id in said] == list(range(0x106, 0x110))
    assert all(b - a >= FRAME_US for (a, _), (b, _) in itertools.pairwise(said))


def test_emulation_marker_is_sent_every_100_ms():
    said = Emulator().advance_to(1_000_000)
    times = list_times(said, EMULATED_ID)
    assert times == [100_000 * k for k in range(1, 11)]


def test_current_turns_the_motor_and_is_reported_with_its_lag():
    """0.5 ms is the time constant; the first B is sent 0.1 ms after the first torque."""
    said = run(bring_up(), 40, lambda _: (1000, 0))
    currents = [
        decode(Command.FEEDBACK, f.data).current_ma for _, f, _ in said if f.can_id == 0x01B
    ]
    assert 0 < currents[0] < 300
    assert currents[-1] == 1000
    assert currents[:3] == sorted(currents[:3])
    counts = [
        decode(Command.FEEDBACK, f.data).position_counts for _, f, _ in said if f.can_id == 0x01B
    ]
    assert counts[-1] > 100


def test_two_runs_send_the_same_bytes():
    def script(tick):
        return 800 if tick // 40 % 2 else -800, 150 if tick // 25 % 2 else -150

    records = []
    for _ in range(2):
        emulator = bring_up()
        emulator.add_load(ConstantLoad(torque_nm=(2.0, 0.0, 0.0)))
        records.append(run(emulator, 300, script))
    assert records[0] == records[1]
    assert len({frame.data for _, frame, _ in records[0]}) > 300


def test_step_size_of_the_advance_changes_nothing():
    """One advance over 50 ms sends the frames of fifty advances over 1 ms, and of odd ones."""

    def collect(step):
        emulator = bring_up()
        emulator.receive(build(Current(5000, 500), 1), LOOP)
        said = []
        for time_us in [*range(READY_US, READY_US + 50_000, step), READY_US + 50_000]:
            said += emulator.advance_to(time_us)
        return said

    assert collect(1000) == collect(50_000) == collect(137)


def test_time_does_not_decrease():
    emulator = bring_up()
    assert emulator.advance_to(5) == []
    assert emulator.now_us == READY_US
