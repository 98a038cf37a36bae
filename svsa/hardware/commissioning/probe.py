"""The bus traffic of a bench for its check.

Every wait has a time limit, and a drive that was switched on has zero current and is reset when the
probe is closed.
"""

import contextlib
import time
from collections.abc import Callable, Iterator

import can

from svsa.errors import SvsaError
from svsa.hardware.bench.emulation import EMULATED_ID
from svsa.hardware.bench.settings import BusSettings, MotorSettings
from svsa.hardware.commissioning.traffic import Counts, HeardFeedback, Traffic
from svsa.hardware.description.file import BenchFile
from svsa.hardware.drives.bus import BusError, open_bus
from svsa.hardware.drives.conversion import Unwrapped, build_motor_scale
from svsa.hardware.drives.drive import Drive, compute_key, merge_stops
from svsa.hardware.drives.installed import build_drive, build_stop, get_family
from svsa.hardware.drives.phase import Phase
from svsa.hardware.encoders import read_source
from svsa.hardware.encoders.source import EncoderError

_ENCODER_POLL_S = 0.001
_RELEASES = 5
_RELEASE_S = 0.02

BusOpener = Callable[[BusSettings], can.BusABC]
Clock = Callable[[], float]


class Probe:
    """A bench's bus and its deflection encoder.

    Methods that send or receive raise `BusError` if the bus is lost.

    Attributes:
        emulated: Whether the bench reported that it is emulated.
        encoder_failure: Why the deflection encoder cannot be read, or None.
    """

    def __init__(
        self, bench: BenchFile, opener: BusOpener = open_bus, now: Clock = time.monotonic
    ) -> None:
        self.bench, self.now = bench, now
        self.motors = {"motor1": bench.motor1, "motor2": bench.motor2}
        self.drives = {name: self._build_drive(motor) for name, motor in self.motors.items()}
        self.families = {name: get_family(motor.drive) for name, motor in self.motors.items()}
        self._takers = {key: name for name, drive in self.drives.items() for key in drive.heard_ids}
        self.emulated = False
        self.encoder_failure: str | None = None
        self._source = read_source(bench.deflection)
        self._unwrapped = Unwrapped(self._source.bits)
        self._encoder_time: float | None = None
        self._opener = opener
        self._bus: can.BusABC | None = None
        self._query_at_s = 0.0
        self._commanding = False

    def _build_drive(self, motor: MotorSettings) -> Drive:
        speed_max = motor.speed_max_rad_per_s / abs(build_motor_scale(motor).angle_per_count)
        return build_drive(motor, self.bench.timing.period_s, speed_max)

    def open(self) -> None:
        """Open the bus, and the encoder if possible.

        Raises:
            BusError: If the bus cannot be opened.
        """
        self._bus = self._opener(self.bench.bus)
        try:
            self._source.open()
        except EncoderError as error:
            self.encoder_failure = str(error)

    def listen(self, duration_s: float) -> Traffic:
        """Record all traffic for this time."""
        traffic = Traffic()
        for _ in self.follow(duration_s, traffic):
            pass
        return traffic

    def follow(self, duration_s: float, traffic: Traffic) -> Iterator[None]:
        """Record traffic, and yield after each frame so that the caller can stop early."""
        end = self.now() + duration_s
        while (left := end - self.now()) > 0.0:
            wait = self._query()
            message = self._receive(min(left, wait, _ENCODER_POLL_S))
            if message is not None:
                self._take(message, traffic)
            self._read_encoder(traffic)
            yield

    def drain(self) -> None:
        """Discard the traffic so far."""
        end, discarded = self.now() + 0.5, Traffic()
        while self.now() < end and (message := self._receive(0.0)) is not None:
            self._take(message, discarded)

    def _query(self) -> float:
        """Query drives that do not send feedback automatically once per period.

        Returns:
            The time until the next query, s.
        """
        now, period = self.now(), self.bench.timing.period_s
        if now >= self._query_at_s:
            self._query_at_s = max(self._query_at_s + period, now)
            with self._sending():
                for drive in self.drives.values():
                    if drive.phase is Phase.READY:
                        drive.query(self._get_bus(), now)
        return max(0.0, self._query_at_s - now)

    def ask(self, name: str) -> None:
        """Send a query that a drive answers in any state."""
        with self._sending():
            self.drives[name].ask(self._get_bus(), self.now())

    def query_all_addresses(self, name: str) -> Traffic:
        """Query every possible address of this motor's drive family."""
        traffic = Traffic()
        for question in self.families[name].list_questions():
            with self._sending():
                self._get_bus().send(question)
            for _ in self.follow(0.001, traffic):
                pass
        for _ in self.follow(0.1, traffic):
            pass
        return traffic

    def begin(self) -> None:
        """Reset both drives at the next `advance`."""
        self._commanding = True
        for drive in self.drives.values():
            drive.begin()

    def advance(self) -> bool:
        """Send the due frames of the start-up; return whether it continues."""
        on = False
        for drive in self.drives.values():
            if drive.phase not in (Phase.READY, Phase.SILENT):
                on = True
                with self._sending():
                    drive.advance(self._get_bus(), self.now())
        return on

    def send_current(self, name: str, current_ma: int) -> None:
        """Command a current, mA, in the drive's own sense, as soon as the drive takes one."""
        self._commanding = True
        drive = self.drives[name]
        if (wait := drive.sent_s + drive.gap_s - self.now()) > 0.0:
            self.listen(wait)
        with self._sending():
            drive.send_current(self._get_bus(), current_ma, self.now())

    def release(self) -> None:
        """Send zero current and resets to commanded drives until they are silent.

        Waits until the last frames have been sent: an adapter behind a socket loses frames in
        transit when it is closed too soon.
        """
        if self._bus is None or not self._commanding:
            return
        resets = merge_stops(
            *(build_stop(motor)._replace(zero=()) for motor in self.motors.values())
        )
        for drive in self.drives.values():
            drive.phase = Phase.OFF
        for _ in range(_RELEASES):
            with contextlib.suppress(BusError):
                self.listen(max(drive.gap_s for drive in self.drives.values()))
                for drive in self.drives.values():
                    with self._sending():
                        drive.send_zero(self._get_bus(), self.now())
                self.listen(max(drive.gap_s for drive in self.drives.values()))
                for reset in resets:
                    with self._sending():
                        self._get_bus().send(reset)
                self.listen(_RELEASE_S)
                if not self.listen(_RELEASE_S).engaged:
                    break
        self._commanding = False

    def close(self) -> None:
        """Leave every drive without current, and close bus and encoder."""
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

    @contextlib.contextmanager
    def _sending(self) -> Iterator[None]:
        try:
            yield
        except (can.CanError, OSError) as error:
            raise BusError(f"The CAN bus accepts no frames: {error}.") from None

    def _receive(self, timeout_s: float) -> can.Message | None:
        try:
            return self._get_bus().recv(timeout_s)
        except (can.CanError, OSError) as error:
            raise BusError(f"The CAN bus is lost: {error}.") from None

    def _take(self, message: can.Message, traffic: Traffic) -> None:
        now = self.now()
        stamp = message.timestamp if self.bench.bus.timestamps == "bus" else now
        traffic.frames += 1
        if message.is_error_frame:
            traffic.bus_errors += 1
        elif message.is_extended_id and message.arbitration_id == EMULATED_ID:
            self.emulated = True
        elif not message.is_remote_frame and not self._source.feed(message, stamp):
            self._take_drive(message, now, stamp, traffic)

    def _take_drive(self, message: can.Message, now: float, stamp: float, traffic: Traffic) -> None:
        key = compute_key(message)
        name = self._takers.get(key)
        if name is None:
            for motor, drive in self.drives.items():
                if key in drive.obeyed_ids:
                    traffic.commanded.add(motor)
            places = (family.find_place(message) for family in self.families.values())
            traffic.places.update(place for place in places if place is not None)
            return
        drive = self.drives[name]
        answers, errors, heard_s = drive.answers, drive.errors, drive.heard_s
        drive.take(message, now)
        if drive.answers != answers:
            traffic.answers.setdefault(name, []).append(now)
        if drive.errors != errors:
            traffic.errors[name] = traffic.errors.get(name, 0) + 1
        if drive.heard_s != heard_s:
            heard = HeardFeedback(now, stamp, drive.counts, drive.current_ma)
            traffic.feedback.setdefault(name, []).append(heard)
            if drive.engaged:
                traffic.engaged.add(name)

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
