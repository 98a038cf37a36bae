"""One drive: how it is brought to current mode, and what it last said.

OFF → RESET (500 ms) → CONFIG → MODE (500 ms) → READY, by time; READY needs the echo of the
online check and feedback that flows. Commands to a drive are 1 ms apart, less 0.1 ms by which
a tick may come late and the next one not.
"""

import math
import struct

import can

from svsa.hardware.drives.conversion import Unwrapped
from svsa.hardware.drives.phase import Phase
from svsa.hardware.drives.robomodule import (
    BROADCAST,
    Address,
    Command,
    Config,
    Current,
    Message,
    Mode,
    Online,
    Reset,
    SetMode,
    build_id,
    encode,
)
from svsa.hardware.file import BenchFile, MotorSettings

SETTLE_S = 0.5
MARGIN_S = 0.02
GATE_JITTER_S = 0.0001
COMMAND_GATE_S = 0.001 - GATE_JITTER_S
FIRST_ANSWER_S = 0.5
JUMP_FACTOR = 1.5
MIN_JUMP_COUNTS = 50.0
_CURRENT = struct.Struct(">hh4s")
_FEEDBACK = struct.Struct(">hhi")
_FILL = b"\x55" * 4


class Drive:
    """The frames to and from one drive. speed_max: counts/s that its motor never reaches.

    counts, current_ma: as it last said. heard_s: when, by the clock of the plant; None
    before. errors: D frames since the reset. zeroed: its position jumped to zero without a reset.
    """

    def __init__(self, settings: MotorSettings, period_s: float, speed_max: float) -> None:
        self._address = Address(settings.drive_group, settings.drive_number)
        self._pwm = settings.pwm_limit
        self._period_s, self._speed_max = period_s, speed_max
        self._period_ms = max(1, round(1000.0 * period_s))
        self.feedback_id = build_id(self._address, Command.FEEDBACK)
        self.error_id = build_id(self._address, Command.ERROR)
        self.online_id = build_id(self._address, Command.ONLINE)
        self._current = can.Message(
            arbitration_id=build_id(self._address, Command.CURRENT),
            is_extended_id=False,
            data=bytes(8),
        )
        self._unwrapped = Unwrapped(32)
        self.phase = Phase.OFF
        self.sent_s = -math.inf
        self._until: float | None = 0.0
        self._check_s = 0.0
        self._forget()

    def _forget(self) -> None:
        self.heard_s: float | None = None
        self.counts, self.current_ma, self.errors = 0, 0, 0
        self.online = self.zeroed = False
        self._unwrapped.reset()

    def begin(self) -> None:
        """Reset the drive at the next `advance`, and go on from there."""
        self._forget()
        self.phase, self._until = Phase.RESET, None

    def advance(self, bus: can.BusABC, now: float) -> None:
        """Send what is due of the sequence."""
        if not self.is_open(now):
            return
        if self._until is None:
            self._send(bus, now, Reset())
            self._until = now + SETTLE_S + MARGIN_S
        elif now < self._until:
            return
        elif self.phase is Phase.RESET:
            self._forget()
            self._send(bus, now, Config(self._period_ms, 0))
            self.phase, self._until = Phase.CONFIG, now + MARGIN_S
        elif self.phase is Phase.CONFIG:
            self._send(bus, now, SetMode(Mode.CURRENT))
            self.phase, self._until = Phase.MODE, now + SETTLE_S + MARGIN_S
            self._check_s = self._until
        elif self.phase is Phase.MODE:
            self._await_answer(bus, now, now - self._until)

    def _await_answer(self, bus: can.BusABC, now: float, waited: float) -> None:
        """In its mode, the drive must echo and its feedback flow; ask again where not."""
        if self.online and self.heard_s is not None:
            self.phase = Phase.READY
        elif waited >= FIRST_ANSWER_S:
            self.phase = Phase.SILENT
        elif now >= self._check_s:
            self._send(bus, now, Config(self._period_ms, 0) if self.online else Online())
            self._check_s = now + MARGIN_S

    def take(self, message: can.Message, time_s: float) -> None:
        """A frame of this drive's feedback, and when it was true."""
        current, _, raw = _FEEDBACK.unpack(message.data)
        before, heard = self.counts, self.heard_s
        self.counts, self.current_ma = self._unwrapped.update(raw), current
        self.heard_s = time_s
        # A reset sets the counter to zero: only a jump towards zero, farther than the motor can
        # turn in that time, is one.
        if heard is not None and abs(raw) < abs(before):
            farthest = self._speed_max * (abs(time_s - heard) + self._period_s)
            if abs(self.counts - before) > JUMP_FACTOR * farthest + MIN_JUMP_COUNTS:
                self.zeroed = True

    def is_open(self, now: float) -> bool:
        """Whether its last command was long enough ago for another."""
        return now - self.sent_s >= COMMAND_GATE_S

    def send_current(self, bus: can.BusABC, current_ma: int, now: float) -> bool:
        """Ask for a current; False where the last command was too short ago."""
        if not self.is_open(now):
            return False
        self.sent_s = now
        # The same message in every tick, packed by `struct` in about 0.1 µs.
        self._current.data[:] = _CURRENT.pack(self._pwm, current_ma, _FILL)
        bus.send(self._current)
        return True

    def _send(self, bus: can.BusABC, now: float, message: Message) -> None:
        self.sent_s = now
        identifier = build_id(self._address, message.command)
        bus.send(can.Message(arbitration_id=identifier, is_extended_id=False, data=encode(message)))


def list_command_ids(bench: BenchFile) -> frozenset[int]:
    """Identifiers of all that both drives would obey: from reset to configuration."""
    addresses = {
        Address(motor.drive_group, number)
        for motor in (bench.motor1, bench.motor2)
        for number in (BROADCAST, motor.drive_number)
    }
    obeyed = range(Command.RESET, Command.CONFIG + 1)
    return frozenset(build_id(address, Command(n)) for address in addresses for n in obeyed)


def build_broadcast_resets(bench: BenchFile) -> list[can.Message]:
    """`000# 55 × 8`, for each group: all its drives leave their mode and make no torque."""
    return [
        can.Message(
            arbitration_id=build_id(Address(group, BROADCAST), Command.RESET),
            is_extended_id=False,
            data=encode(Reset()),
        )
        for group in sorted({bench.motor1.drive_group, bench.motor2.drive_group})
    ]


def build_zero_currents(bench: BenchFile) -> list[can.Message]:
    """Current 0 to both drives."""
    return [
        can.Message(
            arbitration_id=build_id(
                Address(motor.drive_group, motor.drive_number), Command.CURRENT
            ),
            is_extended_id=False,
            data=encode(Current(motor.pwm_limit, 0)),
        )
        for motor in (bench.motor1, bench.motor2)
    ]
