"""One emulated RMDS-102, as the manufacturer's CAN manual (2018-07) describes it.

It is as strict as the manual: a mode is accepted once, 500 ms after a reset, and data 500 ms after
that; a command at another time is an error without effect; the last current is held indefinitely.
"""

import math
from collections.abc import Callable

from svsa.hardware.bench.emulation import Frame
from svsa.hardware.drives.emulated import EmulatedDrive, Motion
from svsa.hardware.drives.robomodule import (
    STALL_PROTECTION,
    Address,
    Command,
    Current,
    DriveError,
    Feedback,
    FrameError,
    Inputs,
    Mode,
    Online,
    build_id,
    decode,
    encode,
    split_id,
)
from svsa.hardware.drives.robomodule.settings import EmulatedRoboModuleMotor

SETTLE_US = 500_000
VELOCITY_STEP_RPM = 30


class EmulatedRoboModuleDrive(EmulatedDrive):
    """A drive with its mode, which is None until one was taken, and its periods."""

    def __init__(self, motor: EmulatedRoboModuleMotor) -> None:
        super().__init__(motor)
        self.address = motor.address
        self._ids = {
            command: build_id(self.address, command)
            for command in (Command.FEEDBACK, Command.INPUTS, Command.ERROR, Command.ONLINE)
        }
        self.reset(-SETTLE_US)
        self._started = False

    def reset(self, time_us: int) -> None:
        """Leave the mode, zero the position, forget every period."""
        self._mode: Mode | None = None
        self._hold(0, time_us)
        self._feedback_ms = self._inputs_ms = 0
        self.stalled = False
        self.zero_counter()
        self._started = True
        self._ready_us = time_us + SETTLE_US

    @property
    def mode(self) -> Mode | None:
        """The mode; None until one was taken."""
        return self._mode

    @property
    def engaged(self) -> bool:
        """Whether it is in current mode."""
        return self._mode is Mode.CURRENT

    def receive(self, frame: Frame, time_us: int, observe: Callable[[], Motion]) -> list[Frame]:
        """Receive a frame of the bus; return the frames with which the drive answers."""
        if frame.extended:
            return []
        try:
            address, command = split_id(frame.can_id)
            if not self._is_mine(address):
                return []
            message = decode(command, frame.data)
        except FrameError:
            return []
        if not self.heard:
            return []
        if command is Command.RESET:
            self.reset(time_us)
        elif self._mode is None and time_us < self._ready_us:
            self.errors += 1
        elif command is Command.ONLINE:
            return [Frame(self._ids[Command.ONLINE], encode(Online()))]
        elif command is Command.MODE:
            if self._mode is None and self._started:
                self._mode, self._ready_us = message.mode, time_us + SETTLE_US
            else:
                self.errors += 1
        elif command is Command.CONFIG:
            self._feedback_ms = message.feedback_period_ms
            self._inputs_ms = message.inputs_period_ms
        elif command.mode is not None:
            self._take_data(command, message, time_us)
        return []

    def _take_data(self, command: Command, message: object, time_us: int) -> None:
        if self._mode is None or command.mode is not self._mode or time_us < self._ready_us:
            self.errors += 1
        elif isinstance(message, Current):
            self._hold(message.current_ma if message.pwm_limit else 0, time_us)

    def _is_mine(self, address: Address) -> bool:
        return address.group == self.address.group and address.number in (0, self.address.number)

    def list_pushed(self, beat: int, motion: Motion) -> list[Frame]:
        """Frames B and C, where they are due at this ms; they flow only in a mode."""
        if self._mode is None or not self.heard:
            return []
        frames = []
        if self._feedback_ms and beat % self._feedback_ms == 0:
            frames.append(self.build_feedback(motion))
        if self._inputs_ms and beat % self._inputs_ms == 0:
            frames.append(Frame(self._ids[Command.INPUTS], encode(Inputs(0, 0, 0, 0, 0, 0))))
        return frames

    def build_feedback(self, motion: Motion) -> Frame:
        """Build the feedback message, frame B of the manual."""
        current = round(self.compute_current_ma(motion.torque))
        rpm = self.encoder_sign * motion.velocity * self.motor.gear_ratio * 30.0 / math.pi
        steps = VELOCITY_STEP_RPM * math.floor(rpm / VELOCITY_STEP_RPM + 0.5)
        counts = (self.counts + 2**31) % 2**32 - 2**31
        if self.frozen:
            steps = 0
        message = Feedback(_clip16(current), _clip16(steps), counts)
        return Frame(self._ids[Command.FEEDBACK], encode(message))

    def build_error(self) -> Frame:
        """Build the error message of the stall protection, frame D of the manual."""
        return Frame(self._ids[Command.ERROR], encode(DriveError(STALL_PROTECTION)))


def _clip16(value: int) -> int:
    return min(max(int(value), -(2**15)), 2**15 - 1)
