"""The interface of an emulated drive that every family implements.

The base class models the motor and its encoder; a family adds its protocol, according to the
manufacturer's manual.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import ClassVar, NamedTuple

from svsa.hardware.bench.emulation import Frame
from svsa.hardware.bench.settings import DEFAULT_DRIVE, Sign
from svsa.inputs.checked import Checked, Number, Whole, quantity


class EmulatorClock(Checked):
    """The clock of a node: every whole ms, starting at `phase_s`."""

    phase_s: Number = quantity("s", "First message after the emulator's start", ge=0, le=0.001)
    drift: Number = quantity(
        "1", "Relative drift of its clock, positive if slow", ge=-0.01, le=0.01, default=0.0
    )


class EmulatedMotor(EmulatorClock):
    """A motor, its drive, gearbox and encoder. Torque and angle are at the gearbox output.

    The family of the drive adds its address.
    """

    address_field: ClassVar[str] = ""
    """The field that distinguishes two drives of the family on one bus."""

    drive: str = quantity("", "Family of the drive", default=DEFAULT_DRIVE)
    counts_per_rev: Whole = quantity(
        "1", "Counts per motor revolution", ge=4, le=10**7, default=2000
    )
    gear_ratio: Number = quantity("1", "Gear ratio N of N : 1", gt=0, le=10_000, default=50.0)
    torque_constant_nm_per_a: Number = quantity("N·m/A", "K_t of the winding", gt=0, le=10)
    efficiency: Number = quantity("1", "η of the gearbox", gt=0, le=1, default=0.9)
    sign: Sign = quantity(
        "", "1 if a positive current increases angle and counts, otherwise −1", default=1
    )
    peak_current_a: Number = quantity("A", "Maximum current of the drive", gt=0, le=32, default=15)

    @property
    def torque_nm_per_a(self) -> float:
        """N η K_t with its sign: torque at the gearbox output for a current."""
        return self.sign * self.gear_ratio * self.efficiency * self.torque_constant_nm_per_a

    @property
    def place(self) -> str:
        """The address of the drive, in words."""
        return ""


class Motion(NamedTuple):
    """Motion of a motor at the gearbox output: velocity, rad/s, and torque, N·m."""

    velocity: float
    torque: float


class EmulatedDrive(ABC):
    """A drive, its motor's counter, and the commanded current.

    Attributes:
        answers_with_feedback: Whether the faults of its feedback also affect its answers.
        current_ma: Commanded current, mA, constant since `since_us`.
        errors: Number of commands in a wrong state.
        stalled: See `svsa.hardware.emulator.faults`, also for powered, plugged, frozen and
            offset_ma.
    """

    answers_with_feedback = False

    def __init__(self, motor: EmulatedMotor) -> None:
        self.motor = motor
        self.encoder_sign, self.motor_sign = motor.sign, 1
        self.offset_ma = 0.0
        self.powered, self.plugged, self.stalled = True, True, False
        self.frozen = False
        self.errors = 0
        self.current_ma = self.since_us = 0
        self._raw = self._zero = 0

    @property
    @abstractmethod
    def mode(self) -> int | None:
        """The mode as the drive reports it; None where it has none."""

    @property
    @abstractmethod
    def engaged(self) -> bool:
        """Whether the drive is in the mode in which it makes the commanded current."""

    @abstractmethod
    def reset(self, time_us: int) -> None:
        """Begin as after power is switched on: no torque, and the position is zero."""

    @abstractmethod
    def receive(self, frame: Frame, time_us: int, observe: Callable[[], Motion]) -> list[Frame]:
        """Receive a frame of the bus.

        Args:
            frame: The frame.
            time_us: Time, µs.
            observe: Reads the encoder, and returns the motion.

        Returns:
            The frames with which the drive answers.
        """

    def list_pushed(self, beat: int, motion: Motion) -> list[Frame]:
        """List the frames that the drive pushes at this ms of its clock."""
        return []

    def build_error(self) -> Frame | None:
        """The frame that a stalled drive sends every 100 ms, if any."""
        return None

    def expire(self, time_us: int) -> bool:
        """Stop if commands are overdue; return whether the torque has changed."""
        return False

    def zero_counter(self) -> None:
        """Set the current position as zero."""
        self._zero = self._raw

    @property
    def counts(self) -> int:
        """The position, counts from its zero."""
        return self._raw - self._zero

    @property
    def heard(self) -> bool:
        """Whether its frames reach the bus."""
        return self.powered and self.plugged

    @property
    def target_nm(self) -> float:
        """The torque at the gearbox output that the current loop aims at."""
        if not self.powered or self.stalled or not self.engaged:
            return 0.0
        most = 1000.0 * self.motor.peak_current_a
        current = min(max(self.current_ma + self.offset_ma, -most), most)
        return self.motor_sign * current * self.motor.torque_nm_per_a / 1000.0

    def look(self, angle: float) -> None:
        """Update the motor's encoder at this output angle, rad."""
        if not self.frozen:
            turns = angle * self.motor.gear_ratio / (2.0 * math.pi)
            self._raw = self.encoder_sign * math.floor(turns * self.motor.counts_per_rev + 0.5)

    def compute_current_ma(self, torque: float) -> float:
        """The current behind a torque at the output, N·m."""
        return 1000.0 * self.motor_sign * torque / self.motor.torque_nm_per_a

    def _hold(self, current_ma: int, time_us: int) -> None:
        """Hold this current from now on."""
        if current_ma != self.current_ma:
            self.current_ma, self.since_us = current_ma, time_us
