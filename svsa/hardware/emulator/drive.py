"""One emulated RMDS-102, as the maker's CAN manual (2018-07) describes it.

Nothing here is kinder than the manual: a mode is taken once, 500 ms after a reset, and data
500 ms after that; a command at another moment is an error and does nothing; the last
current is held for ever.
"""

import math

from svsa.hardware.drives.robomodule import (
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
from svsa.hardware.emulator.frame import Frame
from svsa.hardware.emulator.parameters import EmulatedMotor

SETTLE_US = 500_000
ERROR_PERIOD_US = 100_000
VELOCITY_STEP_RPM = 30
STALL_PROTECTION = 1


class EmulatedDrive:
    """A drive, its motor's counter, and the commanded current.

    mode: None until one was taken. current_ma: commanded, the same since `since_us`. errors:
    commands at the wrong moment. stalled, powered, plugged, frozen: see
    `svsa.hardware.emulator.faults`.
    """

    def __init__(self, motor: EmulatedMotor) -> None:
        self.motor = motor
        self.address = Address(motor.group, motor.number)
        self._ids = {
            command: build_id(self.address, command)
            for command in (Command.FEEDBACK, Command.INPUTS, Command.ERROR, Command.ONLINE)
        }
        self.encoder_sign, self.motor_sign = motor.sign, 1
        self.offset_ma = 0.0
        self.powered, self.plugged, self.stalled = True, True, False
        self.frozen = False
        self.errors = 0
        self.current_ma = self.since_us = 0
        self._raw = 0
        self.reset(-SETTLE_US)
        self._started = False

    def reset(self, time_us: int) -> None:
        """Leave the mode, zero the position, forget every period."""
        self.mode: Mode | None = None
        self._hold(0, time_us)
        self.feedback_ms = self.inputs_ms = 0
        self.stalled = False
        self.zero_counter()
        self._started = True
        self._ready_us = time_us + SETTLE_US

    def zero_counter(self) -> None:
        """Take the position as it is for zero."""
        self._zero = self._raw

    @property
    def heard(self) -> bool:
        """Whether what it says reaches the bus."""
        return self.powered and self.plugged

    @property
    def feeding(self) -> bool:
        """Whether B and C may flow."""
        return self.heard and self.mode is not None

    @property
    def target_nm(self) -> float:
        """The torque at the gearbox output that the current loop aims at."""
        if not self.powered or self.stalled or self.mode is not Mode.CURRENT:
            return 0.0
        most = 1000.0 * self.motor.peak_current_a
        current = min(max(self.current_ma + self.offset_ma, -most), most)
        return self.motor_sign * current * self.motor.torque_nm_per_a / 1000.0

    def look(self, angle: float) -> None:
        """Count the motor's encoder at this angle of the output, rad."""
        if not self.frozen:
            turns = angle * self.motor.gear_ratio / (2.0 * math.pi)
            self._raw = self.encoder_sign * math.floor(turns * self.motor.counts_per_rev + 0.5)

    def receive(self, frame: Frame, time_us: int) -> list[Frame]:
        """Take a frame of the bus; the frames with which the drive answers."""
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
        elif self.mode is None and time_us < self._ready_us:
            self.errors += 1
        elif command is Command.ONLINE:
            return [Frame(self._ids[Command.ONLINE], encode(Online()))]
        elif command is Command.MODE:
            if self.mode is None and self._started:
                self.mode, self._ready_us = message.mode, time_us + SETTLE_US
            else:
                self.errors += 1
        elif command is Command.CONFIG:
            self.feedback_ms = message.feedback_period_ms
            self.inputs_ms = message.inputs_period_ms
        elif command.mode is not None:
            self._take_data(command, message, time_us)
        return []

    def _take_data(self, command: Command, message: object, time_us: int) -> None:
        if self.mode is None or command.mode is not self.mode or time_us < self._ready_us:
            self.errors += 1
        elif isinstance(message, Current):
            self._hold(message.current_ma if message.pwm_limit else 0, time_us)

    def _hold(self, current_ma: int, time_us: int) -> None:
        """Hold this current from now on, for ever if nothing else is said."""
        if current_ma != self.current_ma:
            self.current_ma, self.since_us = current_ma, time_us

    def _is_mine(self, address: Address) -> bool:
        return address.group == self.address.group and address.number in (0, self.address.number)

    def compute_current_ma(self, torque: float) -> float:
        """The current behind a torque at the output, N·m."""
        return 1000.0 * self.motor_sign * torque / self.motor.torque_nm_per_a

    def build_feedback(self, velocity: float, torque: float) -> Frame:
        """Frame B. velocity: output, rad/s. torque: made at the output, N·m."""
        current = round(self.compute_current_ma(torque))
        rpm = self.encoder_sign * velocity * self.motor.gear_ratio * 30.0 / math.pi
        steps = VELOCITY_STEP_RPM * math.floor(rpm / VELOCITY_STEP_RPM + 0.5)
        counts = (self._raw - self._zero + 2**31) % 2**32 - 2**31
        if self.frozen:
            steps = 0
        message = Feedback(_clip16(current), _clip16(steps), counts)
        return Frame(self._ids[Command.FEEDBACK], encode(message))

    def build_inputs(self) -> Frame:
        """Frame C: nothing is connected."""
        return Frame(self._ids[Command.INPUTS], encode(Inputs(0, 0, 0, 0, 0, 0)))

    def build_error(self) -> Frame:
        """Frame D: stall protection."""
        return Frame(self._ids[Command.ERROR], encode(DriveError(STALL_PROTECTION)))


def _clip16(value: int) -> int:
    return min(max(int(value), -(2**15)), 2**15 - 1)
