"""A RoboModule drive: its start-up to current mode, its commands and its last feedback.

OFF → RESET (500 ms) → CONFIG → MODE (500 ms) → READY, by time; READY requires the echo of the
online check and periodic feedback. Commands to a drive are 1 ms apart.
"""

import struct

import can

from svsa.hardware.drives.conversion import Unwrapped
from svsa.hardware.drives.drive import Drive, StopFrames
from svsa.hardware.drives.phase import Phase
from svsa.hardware.drives.robomodule import (
    BROADCAST,
    LENGTH,
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
from svsa.hardware.drives.robomodule.settings import RoboModuleSettings

SETTLE_S = 0.5
MARGIN_S = 0.02
GAP_S = 0.001
FIRST_ANSWER_S = 0.5
JUMP_FACTOR = 1.5
MIN_JUMP_COUNTS = 50.0
_CURRENT = struct.Struct(">hh4s")
_FEEDBACK = struct.Struct(">hhi")
_FILL = b"\x55" * 4


class RoboModuleDrive(Drive):
    """The frames to and from one drive.

    `speed_max` is a speed that its motor never reaches, counts/s. `errors` counts D frames since
    the reset, `answers` echoes of the online check; `zeroed` is set if the position jumped to zero
    without a reset.
    """

    gap_s = GAP_S

    def __init__(self, settings: RoboModuleSettings, period_s: float, speed_max: float) -> None:
        address = self._address = settings.address
        self._pwm = settings.pwm_limit
        self._period_s, self._speed_max = period_s, speed_max
        self._period_ms = max(1, round(1000.0 * period_s))
        self._feedback_id = build_id(address, Command.FEEDBACK)
        self._error_id = build_id(address, Command.ERROR)
        self._online_id = build_id(address, Command.ONLINE)
        self.heard_ids = frozenset((self._feedback_id, self._error_id, self._online_id))
        # All commands that it accepts: from reset to configuration, alone or with its group.
        self.obeyed_ids = frozenset(
            build_id(Address(address.group, number), Command(command))
            for number in (BROADCAST, address.number)
            for command in range(Command.RESET, Command.CONFIG + 1)
        )
        self._current = build_message(address, Current(self._pwm, 0))
        self._unwrapped = Unwrapped(32)
        self._until: float | None = 0.0
        self._check_s = 0.0
        super().__init__(settings)

    def _forget(self) -> None:
        super()._forget()
        self._unwrapped.reset()

    def begin(self) -> None:
        """Reset the drive at the next `advance`, then continue the start-up."""
        self._forget()
        self.phase, self._until = Phase.RESET, None

    def advance(self, bus: can.BusABC, now: float) -> None:
        """Send the commands of the sequence that are due."""
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
        """Wait for echo and feedback of a drive in its mode; query again if they are missing."""
        if self.answers and self.heard_s is not None:
            self.phase = Phase.READY
        elif waited >= FIRST_ANSWER_S:
            self.phase = Phase.SILENT
        elif now >= self._check_s:
            self._send(bus, now, Config(self._period_ms, 0) if self.answers else Online())
            self._check_s = now + MARGIN_S

    def take(self, message: can.Message, time_s: float) -> None:
        """Read feedback, an error or the echo of the online check."""
        identifier = message.arbitration_id
        if identifier != self._feedback_id:
            if identifier == self._online_id:
                self.answers += 1
            else:
                self.errors += 1
            return
        if len(message.data) != LENGTH:
            return
        current, _, raw = _FEEDBACK.unpack(message.data)
        before, heard = self.counts, self.heard_s
        self.counts, self.current_ma = self._unwrapped.update(raw), current
        # Drives send feedback only while a mode is active.
        self.heard_s, self.engaged = time_s, True
        # A reset sets the counter to zero: a jump towards zero counts as a reset only if it is
        # larger than the motor can turn in that time.
        if heard is not None and abs(raw) < abs(before):
            farthest = self._speed_max * (abs(time_s - heard) + self._period_s)
            if abs(self.counts - before) > JUMP_FACTOR * farthest + MIN_JUMP_COUNTS:
                self.zeroed = True

    def send_current(self, bus: can.BusABC, current_ma: int, now: float) -> bool:
        """Command a current; Return False if the last command was sent too recently."""
        if not self.is_open(now):
            return False
        self.sent_s = now
        # Every tick sends the same message object, packed by `struct` in about 0.1 µs.
        self._current.data[:] = _CURRENT.pack(self._pwm, current_ma, _FILL)
        bus.send(self._current)
        return True

    def send_zero(self, bus: can.BusABC, now: float) -> bool:
        """Command zero current; Return False if the last command was sent too recently."""
        return self.send_current(bus, 0, now)

    def ask(self, bus: can.BusABC, now: float) -> None:
        """Send the online check, which the drive echoes."""
        self._send(bus, now, Online())

    def describe_error(self) -> str:
        """The only error in the manual."""
        return "sent an error frame: stall protection is on"

    def _send(self, bus: can.BusABC, now: float, message: Message) -> None:
        self.sent_s = now
        bus.send(build_message(self._address, message))


def build_message(address: Address, message: Message) -> can.Message:
    """The frame of a message to or from a drive."""
    return can.Message(
        arbitration_id=build_id(address, message.command),
        is_extended_id=False,
        data=encode(message),
    )


def build_stop(settings: RoboModuleSettings) -> StopFrames:
    """Current 0 to the drive, and `000# 55 × 8` to its group: all its drives leave their mode."""
    zero = build_message(settings.address, Current(settings.pwm_limit, 0))
    reset = build_message(Address(settings.drive_group, BROADCAST), Reset())
    return StopFrames((zero,), (reset,))
