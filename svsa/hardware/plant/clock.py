"""The clock of a bench: wall time, or an emulator's time in lockstep."""

import ctypes
import math
import sys
import time
from typing import Protocol

import can

from svsa.errors import SvsaError
from svsa.hardware.bench.emulation import ADVANCE_ID, decode_time, encode_time
from svsa.hardware.description.file import BenchFile

_CLOCK_MONOTONIC = 1
_TIMER_ABSTIME = 1
_ECHO_S = 10.0
SAME_DAY_S = 5.0
RESTART_S = 0.1
DRIFT = 2e-4
SPIN_S = 0.00015
"""Shorter sleeps would end late, because waking up takes about 0.03 to 0.1 ms."""


class ClockError(SvsaError):
    """A clock that has stopped."""


class BenchClock(Protocol):
    """The clock of the loop. Times are s from an arbitrary origin."""

    def bind(self, bus: can.BusABC) -> None:
        """Use this bus: `convert` turns the times of its frames into those of this clock."""
        ...

    def now(self) -> float:
        """The time, s."""
        ...

    def wait_until(self, deadline: float) -> None:
        """Wait until this time; return at once if it is past."""
        ...

    def take_frames(self) -> list[can.Message]:
        """Frames of the bus that came while waiting."""
        ...

    def convert(self, timestamp: float, arrival: float) -> float:
        """Convert a frame's timestamp to this clock; `arrival` is the time of reading."""
        ...

    def find_lateness(self, deadline: float) -> float:
        """Return the lateness of a deadline in wall time, s."""
        ...


class _Timespec(ctypes.Structure):
    _fields_ = (("seconds", ctypes.c_long), ("nanoseconds", ctypes.c_long))


class WallClock:
    """CLOCK_MONOTONIC, with waits on absolute deadlines where the system has them."""

    def __init__(self) -> None:
        self._of_day: bool | None = None
        self._offset = self._arrival = 0.0
        self._sleep = None
        if sys.platform == "linux":
            # `time.sleep` is relative: a delay between computing the pause and starting it would
            # lengthen the tick.
            self._sleep = ctypes.CDLL(None, use_errno=True).clock_nanosleep

    def bind(self, bus: can.BusABC) -> None:
        """The first frame shows whether the bus uses the time of day or its own clock for
        timestamps.
        """
        self._of_day = None

    def now(self) -> float:
        """The time, s."""
        return time.monotonic()

    def wait_until(self, deadline: float) -> None:
        """Return at this time, or at once if it is past; without sleeping if it is near."""
        if deadline - time.monotonic() < SPIN_S:
            while time.monotonic() < deadline:
                pass
            return
        if self._sleep is None:
            time.sleep(max(0.0, deadline - time.monotonic()))
            return
        seconds = int(deadline)
        wake_time = _Timespec(seconds, int((deadline - seconds) * 1e9))
        # A non-zero result means interruption by a signal: sleep again.
        while self._sleep(_CLOCK_MONOTONIC, _TIMER_ABSTIME, ctypes.byref(wake_time), None):
            if time.monotonic() >= deadline:
                return

    def find_lateness(self, deadline: float) -> float:
        """Return the time since this deadline, s."""
        return time.monotonic() - deadline

    def take_frames(self) -> list[can.Message]:
        """None: they wait at the bus."""
        return []

    def convert(self, timestamp: float, arrival: float) -> float:
        """Convert the time of day, or the time of an adapter's clock of unknown origin.

        No frame arrives before it was sent: the smallest difference of arrival and timestamp is the
        offset between the two clocks, up to a drift of 2e-4. A difference 0.1 s greater means that
        the adapter's clock was restarted; the silence before it has already caused a fault.
        """
        if self._of_day is None:
            self._of_day = abs(time.time() - timestamp) < SAME_DAY_S
            self._offset, self._arrival = arrival - timestamp, arrival
        if self._of_day:
            return timestamp + (time.monotonic() - time.time())
        distance = arrival - timestamp
        self._offset += DRIFT * (arrival - self._arrival)
        self._arrival = arrival
        if distance < self._offset or distance > self._offset + RESTART_S:
            self._offset = distance
        return timestamp + self._offset


class LockstepClock:
    """An emulator's time, which advances only while the loop waits for it."""

    def __init__(self) -> None:
        self._bus: can.BusABC | None = None
        self._now_us = 0
        self._frames: list[can.Message] = []

    def bind(self, bus: can.BusABC) -> None:
        """Request the time of the emulator.

        Raises:
            ClockError: If it does not answer.
        """
        self._bus = bus
        self._now_us = self._advance(0)

    def now(self) -> float:
        """The emulator's time, s."""
        return self._now_us * 1e-6

    def wait_until(self, deadline: float) -> None:
        """Let the emulator advance to this time; its frames are stored for `take_frames`."""
        target_us = round(deadline * 1e6)
        if target_us > self._now_us:
            self._now_us = self._advance(target_us)

    def _advance(self, time_us: int) -> int:
        """Return the time of the emulator, µs, as its echo reports it."""
        if self._bus is None:
            raise ClockError("The clock of an emulator in lockstep has no bus.")
        ask = can.Message(arbitration_id=ADVANCE_ID, is_extended_id=True, data=encode_time(time_us))
        self._bus.send(ask)
        # The emulator sends the frames of the interval before the echo, so after the echo none is
        # missing.
        while (message := self._bus.recv(_ECHO_S)) is not None:
            if message.is_extended_id and message.arbitration_id == ADVANCE_ID:
                return self._check(decode_time(message.data), time_us)
            self._frames.append(message)
        raise ClockError(f"The emulator did not advance within {_ECHO_S:g} s: is it in lockstep?")

    @staticmethod
    def _check(reported_us: int, requested_us: int) -> int:
        """Raise `ClockError` for an emulator that is not in lockstep: its time is too early."""
        if reported_us < requested_us:
            raise ClockError(
                f"The emulator is at {reported_us * 1e-6:g} s and was requested to advance to"
                f" {requested_us * 1e-6:g} s: start it with --lockstep."
            )
        return reported_us

    def take_frames(self) -> list[can.Message]:
        """Frames of the bus that came while waiting."""
        frames, self._frames = self._frames, []
        return frames

    def convert(self, timestamp: float, arrival: float) -> float:
        """The emulator stamps its frames with its own time."""
        return timestamp

    def find_lateness(self, deadline: float) -> float:
        """Return 0: in lockstep nothing is late."""
        return 0.0


CATCH_UP_S = 0.05
"""Maximum lost time that is made up for by ticks without a pause, s."""


class PacedClock(LockstepClock):
    """`LockstepClock` limited to real time: at most `_ahead_s` ahead of the wall clock.

    On a busy machine, loop and emulator become slow together: feedback stays as recent as on a
    bench, and no tick is missed. Separate processes, such as heartbeats, still use the wall clock.
    """

    def __init__(self) -> None:
        super().__init__()
        self._wall = WallClock()
        self._ahead_s = -math.inf

    def wait_until(self, deadline: float) -> None:
        """Let the emulator advance to this time, once it is due in wall-clock time.

        An emulator that had no loop for a while has advanced on its own: that time is not waited
        for.
        """
        if math.isinf(self._ahead_s):
            self._ahead_s = self._wall.now() - self.now()
        self._wall.wait_until(deadline + self._ahead_s)
        late_s = self._wall.now() - max(deadline, self.now())
        self._ahead_s = max(self._ahead_s, late_s - CATCH_UP_S)
        super().wait_until(deadline)
        # If the emulator advanced without the loop, its time is ahead, and the plan follows it.
        self._ahead_s = min(self._ahead_s, self._wall.now() - self.now())

    def find_lateness(self, deadline: float) -> float:
        """Return the lateness of a deadline in wall time, s, as far as it was compensated."""
        return self._wall.now() - (deadline + self._ahead_s)


def choose_clock(bench: BenchFile) -> BenchClock:
    """Choose the clock of a bench: wall time, unless its emulator waits for the loop."""
    is_lockstep = bench.emulator is not None and bench.emulator.lockstep
    return PacedClock() if is_lockstep else WallClock()
