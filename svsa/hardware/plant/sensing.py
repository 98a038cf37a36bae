"""Readings of a bench: frames and counts as input, one reading per tick, and alarms."""

import contextlib
import math

import can

from svsa.actuators.signals import Measurement, State
from svsa.hardware.bench.emulation import EMULATED_ID
from svsa.hardware.bench.reading import Reading
from svsa.hardware.bench.real_motors import RealMotors
from svsa.hardware.bench.settings import AXIS_WORDS
from svsa.hardware.description.file import BenchFile
from svsa.hardware.drives.bus import BUS_TROUBLE, take_waiting
from svsa.hardware.drives.conversion import MotorScale, Unwrapped, build_deflection_scale
from svsa.hardware.drives.drive import EXTENDED, Drive
from svsa.hardware.drives.phase import Phase
from svsa.hardware.encoders import read_source
from svsa.hardware.encoders.source import EncoderError
from svsa.hardware.plant.clock import BenchClock
from svsa.hardware.safety.faults import Alarm
from svsa.hardware.safety.standstill import NewCounts

MAX_FRAMES_A_TICK = 200
MAX_FRAMES_UNHEARD = 100_000
"""Number of frames of some seconds on a busy bus."""
NEW_PERIODS = 2
FRESH_PERIODS = 5
"""Older feedback is not used: x̂ is predicted by the model alone."""
UNHEARD = (math.inf, math.inf, math.inf)


class Sensing:
    """Feedback of two drives and a deflection encoder.

    Attributes:
        zero: Counts of the deflection encoder at φ = 0; with a pair of motors it measures the link.
        ages_s: Ages of the last reading, s; current_a and counts likewise.
        emulated: Whether the bus is that of an emulator.
        lost: Whether the bus failed and must be opened again.
    """

    def __init__(
        self,
        bench: BenchFile,
        drives: tuple[Drive, Drive],
        scales: tuple[MotorScale, MotorScale],
        zero: int,
        clock: BenchClock,
        real: RealMotors,
    ) -> None:
        self._drives, self._clock, self._zero, self._real = drives, clock, zero, real
        self._angles = tuple(scale.angle_per_count for scale in scales)
        self._takers = {key: drive for drive in drives for key in drive.heard_ids}
        self._commands = drives[0].obeyed_ids | drives[1].obeyed_ids
        self.source = read_source(bench.deflection)
        self._deflection = Unwrapped(self.source.bits, zero)
        self._deflection_scale = build_deflection_scale(bench.deflection)
        self._heard_deflection: float | None = None
        self._settings = bench.bus
        self._stamped = bench.bus.timestamps == "bus"
        self._wait = 0.5 * bench.timing.period_s  # mean delay of frames without timestamps
        self._new_s = NEW_PERIODS * bench.timing.period_s
        self._fresh_s = FRESH_PERIODS * bench.timing.period_s
        self._age, self._oldest = bench.timing.feedback_age_s, bench.safety.stale_fault_s
        self._alarm: Alarm | None = None
        self._early: list[can.Message] = []
        self.ages_s, self.current_a, self.counts = UNHEARD, (0.0, 0.0), (0, 0, 0)
        self._measurement: Measurement | None = None
        self.emulated = self.lost = False

    def forget_alarm(self) -> None:
        """Discard the alarm."""
        self._alarm = None

    def catch_up(self, bus: can.BusABC, now: float) -> None:
        """Read the frames from before the loop ran: too many for one tick."""
        with contextlib.suppress(*BUS_TROUBLE):
            for message in take_waiting(bus, self._settings, MAX_FRAMES_UNHEARD):
                self._take(message, now)

    def listen(self, bus: can.BusABC) -> None:
        """Read waiting frames for the next `read`, which reports errors."""
        with contextlib.suppress(*BUS_TROUBLE):
            room = MAX_FRAMES_A_TICK - len(self._early)
            self._early += take_waiting(bus, self._settings, room)

    def read(self, bus: can.BusABC, now: float, known: State) -> Reading:
        """Return the reading of this tick; `known` is the current x̂, whose velocities compensate
        the ages.
        """
        self._drain(bus, now)
        drive1, drive2 = self._drives
        heard1, heard2, heard3 = drive1.heard_s, drive2.heard_s, self._read_deflection(now)
        age1 = math.inf if heard1 is None else max(0.0, now - heard1)
        age2 = math.inf if heard2 is None else max(0.0, now - heard2)
        age3 = math.inf if heard3 is None else max(0.0, now - heard3)
        self.ages_s = (age1, age2, age3)
        self.counts = counts = (drive1.counts, drive2.counts, self._deflection.counts)
        measurement = None
        if max(self.ages_s) <= self._oldest:
            measurement = self._measure(counts, known)
        self.current_a = (
            drive1.current_ma * 1e-3 if age1 <= self._oldest else 0.0,
            drive2.current_ma * 1e-3 if age2 <= self._oldest else 0.0,
        )
        self._measurement = measurement
        return Reading(measurement, self.current_a, self.ages_s, counts)

    def _measure(self, counts: tuple[int, int, int], known: State) -> Measurement:
        """Convert the counts to angles of the model at this tick."""
        age1, age2, age3 = self.ages_s
        angle1, angle2 = self._real.find_angles(known.theta1, known.theta2)
        # `known` has its velocities at the middle of each age. The ages of a pair differ by a part
        # of a period, which is less than a count.
        velocity1, velocity2 = self._real.find_angles(known.dtheta1, known.dtheta2)
        theta1, theta2 = self._real.find_coordinates(
            self._bridge(counts[0] * self._angles[0], velocity1, age1, angle1),
            self._bridge(counts[1] * self._angles[1], velocity2, age2, angle2),
        )
        turned = (counts[2] - self._zero) * self._deflection_scale
        if self._real.is_pair:
            phi = self._bridge(turned, known.dq, age3, known.q) - theta1
        else:
            velocity = known.dq - known.dtheta1
            phi = self._bridge(turned, velocity, age3, known.q - known.theta1)
        return Measurement(theta1, theta2, phi, known.dq, known.dtheta1, known.dtheta2)

    def _bridge(self, angle: float, velocity: float, age: float, known: float) -> float:
        """Extrapolate an angle (rad) of that age to the present; if it is too old, use x̂.

        Longer extrapolation would amplify errors of the velocity.
        """
        # If a frame is late, the run continues on the model for `FRESH_PERIODS`; after that a fault
        # ends it.
        if age > self._fresh_s and self._measurement is not None:
            return known
        return angle + velocity * age

    def find_new_counts(self) -> NewCounts | None:
        """Return the counts new in this tick; None if one is too old for x̂."""
        if max(self.ages_s) > self._fresh_s:
            return None
        counts1, counts2, counts3 = (
            counts if age <= self._new_s else None
            for counts, age in zip(self.counts, self.ages_s, strict=True)
        )
        return counts1, counts2, counts3

    def find_angle(self, step: str) -> float:
        """Return the angle of a homing axis from zero, rad; 0 if unknown."""
        y = self._measurement
        if y is None:
            return 0.0
        angle1, angle2 = self._real.find_angles(y.theta1, y.theta2)
        angles = {"link": y.theta1 + y.phi, "motor1": angle1, "motor2": angle2}
        return angles.get(step, 0.0)

    def _drain(self, bus: can.BusABC, now: float) -> None:
        """Read every waiting frame; convert errors of the bus to an alarm."""
        early, self._early = self._early, []
        for message in (*self._clock.take_frames(), *early):
            self._take(message, now)
        try:
            room = MAX_FRAMES_A_TICK - len(early)
            for message in take_waiting(bus, self._settings, room):
                self._take(message, now)
        except BUS_TROUBLE as error:
            self.lost = True
            self._sound("bus_error", f"The bus failed: {error}.")

    def _take(self, message: can.Message, now: float) -> None:
        """Pass a frame to its receiver; remote and foreign frames are ignored."""
        if message.is_error_frame:
            self._sound(
                "bus_error", "The bus reported an error frame: check wiring and termination."
            )
            return
        if message.is_remote_frame or not message.is_rx:
            return
        # Same as `compute_key`, without a function call for each frame.
        key = message.arbitration_id
        if message.is_extended_id:
            key |= EXTENDED
        stamp = self._clock.convert(message.timestamp, now) if self._stamped else now - self._wait
        time_s = min(stamp, now) - self._age
        drive = self._takers.get(key)
        if drive is not None:
            drive.take(message, time_s)
        elif self.source.feed(message, time_s):
            return
        elif key == EXTENDED | EMULATED_ID:
            self.emulated = True
        elif key in self._commands and self._drives[0].phase is Phase.READY:
            words = (
                "Another program on this bus gave the drives a command (identifier"
                f" {message.arbitration_id:03X})."
            )
            self._sound("foreign_command", words)

    def _read_deflection(self, now: float) -> float | None:
        """Return the time of the last deflection reading, and its counts."""
        try:
            reading = self.source.read(now)
        except EncoderError as error:
            self._sound("encoder_lost", str(error))
            return self._heard_deflection
        if reading is not None and reading[1] != self._heard_deflection:
            self._deflection.update(reading[0])
            self._heard_deflection = reading[1]
        return self._heard_deflection

    def _sound(self, code: str, message: str) -> None:
        if self._alarm is None:
            self._alarm = Alarm(code, message, {})

    def find_alarm(self) -> Alarm | None:
        """Return the first alarm of bus, encoder or drives, or None."""
        if self._alarm is not None:
            return self._alarm
        for name, drive in zip(("motor1", "motor2"), self._drives, strict=True):
            if drive.errors:
                words = f"The drive of {AXIS_WORDS[name]} {drive.describe_error()}."
                return Alarm("drive_error", words, {f"{name}_error_frames": drive.errors})
            if drive.zeroed and drive.phase is Phase.READY:
                words = (
                    f"The position of {AXIS_WORDS[name]} jumped to zero: its drive has restarted."
                )
                return Alarm("drive_zeroed", words, {f"{name}_counts": drive.counts})
        return None
