"""The bench as its check hears it: all that is said on the bus in a given time.

Every wait ends by the clock, and whatever was switched on is at zero current and reset when
the probe is closed.
"""

import contextlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

import can

from svsa.errors import SvsaError
from svsa.hardware.drives.bus import BusError, open_bus
from svsa.hardware.drives.conversion import Unwrapped
from svsa.hardware.drives.robomodule import (
    Address,
    Command,
    Current,
    Feedback,
    FrameError,
    Message,
    Reset,
    build_id,
    decode,
    encode,
    split_id,
)
from svsa.hardware.emulation import EMULATED_ID
from svsa.hardware.encoders import read_source
from svsa.hardware.encoders.source import EncoderError
from svsa.hardware.file import BenchFile, BusSettings


class Result(StrEnum):
    """How a step ended: right, usable with a remark, or not usable."""

    OK = "ok"
    WARN = "warn"
    FAIL = "fail"


class CheckStep(NamedTuple):
    """A step's name, its result, what was measured with its unit, and what to do about it."""

    name: str
    result: Result
    measured: str
    advice: str = ""


COMMAND_GATE_S = 0.001
_ENCODER_POLL_S = 0.001
_RELEASES = 5
_RELEASE_S = 0.02
_NOT_COMMANDS = (Command.FEEDBACK, Command.INPUTS, Command.ERROR, Command.ONLINE)

BusOpener = Callable[[BusSettings], can.BusABC]
Clock = Callable[[], float]


class HeardFeedback(NamedTuple):
    """A feedback frame: when it was read, the time it is stamped with, and what it said."""

    time_s: float
    stamp_s: float
    feedback: Feedback


class Counts(NamedTuple):
    """A reading of the deflection encoder, unwrapped, and its time."""

    counts: int
    time_s: float


@dataclass
class Traffic:
    """What was heard in some time.

    online: when each address echoed. drive_errors: D frames of each. commands: addresses
    that another program sends commands to. bus_errors: error frames of the adapter.
    """

    frames: int = 0
    bus_errors: int = 0
    feedback: dict[Address, list[HeardFeedback]] = field(default_factory=dict)
    online: dict[Address, list[float]] = field(default_factory=dict)
    drive_errors: dict[Address, int] = field(default_factory=dict)
    commands: set[Address] = field(default_factory=set)
    deflection: list[Counts] = field(default_factory=list)


class Probe:
    """A bench's bus and its deflection encoder.

    emulated: an emulator said so. encoder_failure: why the deflection encoder cannot be
    read, or None. Everything that talks or listens raises `BusError` where the bus is gone.
    """

    def __init__(
        self, bench: BenchFile, opener: BusOpener = open_bus, now: Clock = time.monotonic
    ) -> None:
        self.bench, self.now = bench, now
        self.motors = {
            name: Address(motor.drive_group, motor.drive_number)
            for name, motor in (("motor1", bench.motor1), ("motor2", bench.motor2))
        }
        self.emulated = False
        self.encoder_failure: str | None = None
        self._source = read_source(bench.deflection)
        self._unwrapped = Unwrapped(self._source.bits)
        self._encoder_time: float | None = None
        self._opener = opener
        self._bus: can.BusABC | None = None
        self._sent: dict[Address, float] = {}
        self._commanding = False

    def open(self) -> None:
        """Open the bus, and the encoder as far as it works; raises `BusError`."""
        self._bus = self._opener(self.bench.bus)
        try:
            self._source.open()
        except EncoderError as error:
            self.encoder_failure = str(error)

    def listen(self, duration_s: float) -> Traffic:
        """All that is said from now on, for this long."""
        traffic = Traffic()
        for _ in self.follow(duration_s, traffic):
            pass
        return traffic

    def follow(self, duration_s: float, traffic: Traffic) -> Iterator[None]:
        """The same, with a stop after each frame, to leave early."""
        end = self.now() + duration_s
        while (left := end - self.now()) > 0.0:
            message = self._receive(min(left, _ENCODER_POLL_S))
            if message is not None:
                self._take(message, traffic)
            self._read_encoder(traffic)
            yield

    def drain(self) -> None:
        """Forget what has come in so far."""
        end, discarded = self.now() + 0.5, Traffic()
        while self.now() < end and (message := self._receive(0.0)) is not None:
            self._take(message, discarded)

    def send(self, address: Address, message: Message) -> None:
        """A command to a drive, at least 1 ms after the one before."""
        ready_s = self._sent.get(address, self.now() - COMMAND_GATE_S) + COMMAND_GATE_S
        if (wait := ready_s - self.now()) > 0.0:
            self.listen(wait)
        if message.command not in _NOT_COMMANDS:
            self._commanding = True
        self._sent[address] = self.now()
        frame = can.Message(
            arbitration_id=build_id(address, message.command),
            is_extended_id=False,
            data=encode(message),
        )
        try:
            self._get_bus().send(frame, timeout=0.1)
        except (can.CanError, OSError) as error:
            raise BusError(f"The CAN bus takes no frames: {error}.") from None

    def send_current(self, name: str, current_ma: int) -> None:
        """Ask the drive of a motor for a current, mA, in the drive's own sense."""
        limit = (self.bench.motor1 if name == "motor1" else self.bench.motor2).pwm_limit
        self.send(self.motors[name], Current(limit, current_ma))

    def release(self) -> None:
        """Zero current and reset for the drives, if any was commanded, until they are silent.

        The last frames must also have left: an adapter behind a socket loses what is on its way
        when it is closed too soon.
        """
        if self._bus is None or not self._commanding:
            return
        for _ in range(_RELEASES):
            with contextlib.suppress(BusError):
                for name in self.motors:
                    self.send_current(name, 0)
                for group in {address.group for address in self.motors.values()}:
                    self.send(Address(group, 0), Reset())
                self.listen(_RELEASE_S)
                if not self.listen(_RELEASE_S).feedback:
                    break
        self._commanding = False

    def close(self) -> None:
        """Leave every drive without current, and let go of bus and encoder."""
        try:
            self.release()
        finally:
            bus, self._bus = self._bus, None
            if bus is not None:
                bus.shutdown()
                self._source.close()

    def _get_bus(self) -> can.BusABC:
        if self._bus is None:
            raise BusError("The CAN bus is not open.")
        return self._bus

    def _receive(self, timeout_s: float) -> can.Message | None:
        try:
            return self._get_bus().recv(timeout_s)
        except (can.CanError, OSError) as error:
            raise BusError(f"The CAN bus is gone: {error}.") from None

    def _take(self, message: can.Message, traffic: Traffic) -> None:
        now = self.now()
        traffic.frames += 1
        if message.is_error_frame:
            traffic.bus_errors += 1
        elif message.is_extended_id and message.arbitration_id == EMULATED_ID:
            self.emulated = True
        elif not (self._feed_encoder(message, now) or message.is_extended_id):
            with contextlib.suppress(FrameError):
                self._take_drive(message, now, traffic)

    def _take_drive(self, message: can.Message, now: float, traffic: Traffic) -> None:
        address, command = split_id(message.arbitration_id)
        content = decode(command, message.data)
        if command is Command.FEEDBACK:
            stamp = message.timestamp if self.bench.bus.timestamps == "bus" else now
            traffic.feedback.setdefault(address, []).append(HeardFeedback(now, stamp, content))
        elif command is Command.ONLINE:
            traffic.online.setdefault(address, []).append(now)
        elif command is Command.ERROR:
            traffic.drive_errors[address] = traffic.drive_errors.get(address, 0) + 1
        elif command is not Command.INPUTS:
            traffic.commands.add(address)

    def _feed_encoder(self, message: can.Message, now: float) -> bool:
        return self._source.feed(message, now)

    def _read_encoder(self, traffic: Traffic) -> None:
        """Note a reading that is newer than the last."""
        if self.encoder_failure is not None:
            return
        try:
            reading = self._source.read(self.now())
        except SvsaError as error:
            self.encoder_failure = str(error)
            return
        if reading is not None and reading[1] != self._encoder_time:
            counts, self._encoder_time = reading
            traffic.deflection.append(Counts(self._unwrapped.update(counts), self._encoder_time))
