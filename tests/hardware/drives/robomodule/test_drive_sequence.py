"""One drive: its start-up to READY, the gaps between its commands, its feedback."""

from itertools import pairwise
from pathlib import Path

import can
import pytest

from svsa.hardware.description.file import read_bench
from svsa.hardware.drives.drive import GATE_JITTER_S, merge_stops
from svsa.hardware.drives.installed import build_stop
from svsa.hardware.drives.phase import Phase
from svsa.hardware.drives.robomodule import (
    Command,
    Config,
    Current,
    Feedback,
    Mode,
    Online,
    Reset,
    SetMode,
    decode,
    encode,
    split_id,
)
from svsa.hardware.drives.robomodule.drive import (
    FIRST_ANSWER_S,
    GAP_S,
    MARGIN_S,
    SETTLE_S,
    RoboModuleDrive,
)

BENCH = read_bench(Path(__file__).parents[4] / "svsa" / "hardware" / "emulator" / "bench.toml")
COMMAND_GATE_S = GAP_S - GATE_JITTER_S
TICK_S = 0.001
SPEED_MAX = 300_000.0


class Listener:
    """A bus that stores the frames sent, with their times."""

    def __init__(self):
        self.now = 0.0
        self.sent = []

    def send(self, frame):
        _, command = split_id(frame.arbitration_id)
        self.sent.append((self.now, decode(command, frame.data)))

    def list_times(self, kind):
        return [time_s for time_s, message in self.sent if type(message) is kind]


class Driven:
    """A drive that receives ticks, with the responses of a real one unless it is dead."""

    def __init__(self, period_s=TICK_S, echoes=True, feeds=True, obeys_config=True):
        self.bus, self.drive = Listener(), RoboModuleDrive(BENCH.motor1, period_s, SPEED_MAX)
        self._echoes, self._feeds, self._obeys = echoes, feeds, obeys_config
        self._ticks = 0

    def say(self, counts, current_ma=0, at=None):
        data = encode(Feedback(current_ma, 0, counts))
        message = can.Message(0.0, 0x01B, False, data=data)
        self.drive.take(message, self.bus.now if at is None else at)

    def tick(self, seconds=TICK_S):
        for _ in range(round(seconds / TICK_S)):
            self._ticks += 1
            self.bus.now = self._ticks * TICK_S
            before = len(self.bus.sent)
            self.drive.advance(self.bus, self.bus.now)
            for _, message in self.bus.sent[before:]:
                if type(message) is Online:
                    self.drive.answers = int(self._echoes)
            modes, configs = self.bus.list_times(SetMode), self.bus.list_times(Config)
            heeded = self._obeys or (modes and configs[-1] > modes[-1])
            if modes and heeded and self._feeds:
                self.say(0)

    def bring_up(self):
        self.drive.begin()
        self.tick(2.0 * SETTLE_S + 5.0 * MARGIN_S)
        assert self.drive.phase is Phase.READY
        return self


def test_sequence_keeps_the_waiting_times_and_ends_ready():
    """Reset, 500 ms, configuration and mode, 500 ms, and no data before that."""
    driven = Driven().bring_up()
    (reset,), (mode,) = driven.bus.list_times(Reset), driven.bus.list_times(SetMode)
    config, echo = driven.bus.list_times(Config)[0], driven.bus.list_times(Online)[0]
    assert config - reset >= SETTLE_S
    assert mode - config >= COMMAND_GATE_S
    assert echo - mode >= SETTLE_S
    assert [message for _, message in driven.bus.sent if type(message) is SetMode] == [
        SetMode(Mode.CURRENT)
    ]
    assert not driven.bus.list_times(Current)


@pytest.mark.parametrize(("period_s", "wanted"), [(0.001, 1), (0.002, 2)])
def test_feedback_is_configured_once_per_period_of_the_loop(period_s, wanted):
    driven = Driven(period_s).bring_up()
    configs = [message for _, message in driven.bus.sent if type(message) is Config]
    assert configs == [Config(wanted, 0)]


def test_nothing_is_sent_before_the_start():
    driven = Driven()
    driven.tick(1.0)
    assert not driven.bus.sent
    assert driven.drive.phase is Phase.OFF


@pytest.mark.parametrize("missing", ["echoes", "feeds"])
def test_drive_without_echo_or_feedback_is_silent_and_not_ready(missing):
    """The request is repeated, and abandoned after half a second."""
    driven = Driven(**{missing: False})
    driven.drive.begin()
    driven.tick(2.0 * SETTLE_S + FIRST_ANSWER_S)
    assert driven.drive.phase is Phase.MODE
    driven.tick(5.0 * MARGIN_S)
    assert driven.drive.phase is Phase.SILENT
    asked = driven.bus.list_times(Online if missing == "echoes" else Config)
    assert len(asked) > 10


def test_drive_that_accepts_its_configuration_only_in_a_mode_is_configured_there():
    driven = Driven(obeys_config=False).bring_up()
    assert len(driven.bus.list_times(Config)) == 2


def test_two_commands_to_a_drive_keep_the_minimum_gap():
    """During the sequence, and with currents commanded at each tenth of a period."""
    driven = Driven().bring_up()
    drive, bus = driven.drive, driven.bus
    sent = 0
    for tenth in range(200):
        bus.now += TICK_S / 10.0
        sent += drive.send_current(bus, tenth, bus.now)
    assert sent == len(bus.list_times(Current)) >= 20
    times = [time_s for time_s, _ in bus.sent]
    gaps = [later - earlier for earlier, later in pairwise(times)]
    assert min(gaps) >= COMMAND_GATE_S - 1e-12


def test_slightly_late_tick_does_not_delay_the_next_command():
    driven = Driven().bring_up()
    start = driven.bus.now
    for number in range(1, 101):
        late = 0.00009 if number % 2 else 0.0
        assert driven.drive.send_current(driven.bus, 5, start + number * TICK_S + late)


def test_current_frame_matches_the_manual():
    """+1000 mA at a limit of 5000 to drive 1: 013# 13 88 03 E8 55 55 55 55."""
    frames = []
    bus = Listener()
    bus.send = frames.append
    RoboModuleDrive(BENCH.motor1, TICK_S, SPEED_MAX).send_current(bus, 1000, 1.0)
    (frame,) = frames
    assert (frame.arbitration_id, frame.is_extended_id) == (0x013, False)
    assert bytes(frame.data) == bytes.fromhex("138803E855555555")


def test_feedback_counts_continue_over_the_wrap_of_32_bits():
    driven = Driven().bring_up()
    position = 0
    for _ in range(9):
        position += 2**29
        raw = (position + 2**31) % 2**32 - 2**31
        driven.say(raw, current_ma=-7)
        assert driven.drive.counts == position
    assert driven.drive.current_ma == -7


def run_to(driven, counts):
    """Move at 90 % of the maximum velocity, with a frame each millisecond."""
    now, at = driven.bus.now, driven.drive.counts
    step = 0.9 * SPEED_MAX * TICK_S
    while abs(at - counts) > step:
        at += step if counts > at else -step
        now += TICK_S
        driven.say(round(at), at=now)
    driven.say(counts, at=now + TICK_S)
    driven.bus.now = now + TICK_S


def test_position_jump_to_zero_is_detected():
    """As after a brown-out: the drive has restarted and lost its position."""
    driven = Driven().bring_up()
    run_to(driven, 30_000)
    assert not driven.drive.zeroed
    driven.say(3, at=driven.bus.now + TICK_S)
    assert driven.drive.zeroed


def test_fast_return_to_zero_is_no_jump_even_with_lost_frames():
    driven = Driven().bring_up()
    run_to(driven, 30_000)
    run_to(driven, -30_000)
    assert not driven.drive.zeroed
    lost = 20
    driven.say(-30_000 + round(0.9 * SPEED_MAX * lost * TICK_S), at=driven.bus.now + lost * TICK_S)
    assert not driven.drive.zeroed


def test_new_reset_discards_earlier_feedback():
    driven = Driven().bring_up()
    run_to(driven, 30_000)
    driven.say(0, at=driven.bus.now + TICK_S)
    driven.drive.errors = 1
    driven.bring_up()
    drive = driven.drive
    assert (drive.counts, drive.errors, drive.zeroed) == (0, 0, False)


def test_stop_frame_reaches_both_drives_and_every_group():
    """Drives of other groups ignore the broadcast of group 0."""
    apart = BENCH.changed(motor2=BENCH.motor2.changed(drive_group=3))
    for bench, wanted in (
        (BENCH, [0x013, 0x023, 0x000]),
        (apart, [0x013, 0x323, 0x000, 0x300]),
    ):
        frames = merge_stops(build_stop(bench.motor1), build_stop(bench.motor2))
        assert [frame.arbitration_id for frame in frames] == wanted
        zeros, resets = frames[:2], frames[2:]
        assert {decode(Command.CURRENT, frame.data).current_ma for frame in zeros} == {0}
        assert {bytes(frame.data) for frame in resets} == {b"\x55" * 8}
