"""The interface of a drive that every family implements.

The plant, the supervisor, the third line, the bench check and the emulator use this interface and
do not depend on the frames of a family. A drive receives a current in mA and reports counts and a
current: torque, angle, sign and limits belong to the bench (`conversion`, `svsa.hardware.safety`).

    OFF → RESET → (CONFIG) → MODE → READY            SILENT: no answer in time
"""

import math
from abc import ABC, abstractmethod
from typing import NamedTuple

import can

from svsa.hardware.bench.settings import MotorSettings
from svsa.hardware.drives.phase import Phase

EXTENDED = 1 << 31
"""Marks the key of a 29-bit identifier, as SocketCAN's CAN_EFF_FLAG does."""
GATE_JITTER_S = 0.0001
"""Tolerance for a late tick followed by a punctual one, s."""


class StopFrames(NamedTuple):
    """Frames that remove the torque of a drive in any state.

    Attributes:
        zero: Zero current, sent first.
        reset: Leaves the mode, so that only a new start-up can produce torque; may reach several
            drives at once.
    """

    zero: tuple[can.Message, ...]
    reset: tuple[can.Message, ...]


def compute_key(message: can.Message) -> int:
    """The identifier of a frame, distinct for standard and extended ones."""
    return message.arbitration_id | (EXTENDED if message.is_extended_id else 0)


class Drive(ABC):
    """One drive: started up to READY, commanded each tick, and read.

    No method waits. Methods that send raise the exceptions of the bus.

    Attributes:
        gap_s: Minimum time between two commands, s.
        heard_ids: Keys (`compute_key`) of the frames that the drive sends.
        obeyed_ids: Keys of the frames that the drive obeys: if another program sends them, that is
            a fault.
        phase: Phase of the start-up.
        sent_s: Time of the last command, s.
        heard_s: Time of the last feedback, s; None before the first one after a reset.
        counts: Position of the motor, relative to its position at the reset.
        current_ma: Measured current, mA.
        engaged: Whether the last feedback was sent in the mode in which the drive produces torque.
        answers: Number of answers to `ask` since the reset.
        errors: Number of errors that the drive has reported since the reset.
        zeroed: Whether the drive has lost its position without a reset.
    """

    gap_s = 0.0
    heard_ids: frozenset[int]
    obeyed_ids: frozenset[int]

    def __init__(self, settings: MotorSettings) -> None:
        self.place = settings.place
        self.phase = Phase.OFF
        self.sent_s = -math.inf
        self._forget()

    def _forget(self) -> None:
        """Discard the drive's reports."""
        self.heard_s: float | None = None
        self.counts = self.current_ma = self.answers = self.errors = 0
        self.engaged = self.zeroed = False

    def is_open(self, now: float) -> bool:
        """Whether enough time has passed since the last command."""
        return now - self.sent_s >= self.gap_s - GATE_JITTER_S

    @abstractmethod
    def begin(self) -> None:
        """Reset the drive at the next `advance`, and start it up to READY."""

    @abstractmethod
    def advance(self, bus: can.BusABC, now: float) -> None:
        """Send the due frames of the start-up; called each tick until READY or SILENT."""

    @abstractmethod
    def send_current(self, bus: can.BusABC, current_ma: int, now: float) -> bool:
        """Command a current; a drive that does not push feedback is also queried.

        Args:
            bus: The bus.
            current_ma: Current, mA, in the drive's own direction.
            now: Time, s.

        Returns:
            False if the last command was too recent: then nothing was sent.
        """

    @abstractmethod
    def send_zero(self, bus: can.BusABC, now: float) -> bool:
        """Remove the torque; repeated in each tick of a fault, also after a reset.

        Returns:
            False if the last command was too recent: then nothing was sent.
        """

    @abstractmethod
    def take(self, message: can.Message, time_s: float) -> None:
        """Read a frame with one of `heard_ids`; its bytes may be arbitrary.

        Args:
            message: The frame.
            time_s: Time of its content, s.
        """

    @abstractmethod
    def ask(self, bus: can.BusABC, now: float) -> None:
        """Send a query that the drive answers in any state without producing torque."""

    def query(self, bus: can.BusABC, now: float) -> None:
        """Request feedback without changing the current; no effect if it is pushed."""
        return

    @abstractmethod
    def describe_error(self) -> str:
        """Describe the drive's error, to follow "the drive …"."""


def merge_stops(*stops: StopFrames) -> list[can.Message]:
    """Merge the stop frames of several drives: all zero currents, then each reset once."""
    frames: dict[tuple[int, bytes], can.Message] = {}
    for each in (*(stop.zero for stop in stops), *(stop.reset for stop in stops)):
        for frame in each:
            frames.setdefault((compute_key(frame), bytes(frame.data)), frame)
    return list(frames.values())
