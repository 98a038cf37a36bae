"""The bench as a plant: read and written once per tick, over any bus of python-can."""

import contextlib
import math

import can

from svsa.actuators.signals import Disturbance, State, Torque
from svsa.errors import Fault, StateError, SvsaError
from svsa.hardware.bench.homing import Axis
from svsa.hardware.bench.reading import Reading
from svsa.hardware.bench.settings import AXIS_WORDS
from svsa.hardware.description.calibration import Calibration, list_problems
from svsa.hardware.description.file import BenchFile
from svsa.hardware.drives.bus import BUS_TROUBLE, DELIVERY_S, open_bus
from svsa.hardware.drives.conversion import build_motor_scale, compute_current_ma
from svsa.hardware.drives.drive import Drive, merge_stops
from svsa.hardware.drives.installed import build_drive, build_stop
from svsa.hardware.drives.phase import Phase
from svsa.hardware.plant.clock import BenchClock
from svsa.hardware.plant.sensing import Sensing
from svsa.hardware.safety.faults import Alarm
from svsa.hardware.safety.guard import Guard, MotorGuard
from svsa.hardware.safety.heartbeat import Heartbeats, Slot
from svsa.hardware.safety.machine import NO_TORQUE, BenchStatus, Conditions, Machine

HOME_TOLERANCE_RAD = 0.05
PAUSE_S = 0.0001
"""Additional pause beyond the minimum time between two commands of the drives, s."""
_ORDER = (Phase.SILENT, Phase.OFF, Phase.RESET, Phase.CONFIG, Phase.MODE, Phase.READY)


class CanPlant:
    """Two drives, a deflection encoder and the bench's states, on one bus.

    Each tick calls `read`, then `write`. `skipped_commands` counts currents that were not sent
    because a tick came too soon after the previous one.
    """

    def __init__(
        self,
        bench: BenchFile,
        calibration: Calibration | None,
        clock: BenchClock,
        guard: Guard,
        beats: Heartbeats | None = None,
    ) -> None:
        self._bench, self._clock, self._beats, self._guard = bench, clock, beats, guard
        motors, period = (bench.motor1, bench.motor2), bench.timing.period_s
        self._scales = (build_motor_scale(bench.motor1), build_motor_scale(bench.motor2))
        drive1, drive2 = (
            build_drive(motor, period, motor.speed_max_rad_per_s / abs(scale.angle_per_count))
            for motor, scale in zip(motors, self._scales, strict=True)
        )
        self._drives = (drive1, drive2)
        zero = calibration.deflection_zero_counts if calibration else 0
        self._sensing = Sensing(bench, self._drives, self._scales, zero, clock, guard.real)
        self._machine = Machine(bench, guard, list_problems(bench, calibration))
        self._bus: can.BusABC | None = None
        stops = [build_stop(motor) for motor in motors]
        self._resets = merge_stops(*(stop._replace(zero=()) for stop in stops))
        self._gap_s = max(drive1.gap_s, drive2.gap_s)
        self._reset_sent = self._zero_sent = False
        self._stops_known, self._late_s = 0, 0.0
        self.skipped_commands = 0

    @property
    def status(self) -> BenchStatus:
        """The bench's state."""
        return self._machine.status

    @property
    def fault(self) -> Fault | None:
        """The latched fault."""
        return self._machine.fault

    @property
    def problems(self) -> list[str]:
        """Reasons why it cannot be armed."""
        return self._machine.problems

    @property
    def homing_step(self) -> Axis | None:
        """The axis to confirm next, or None if all are confirmed."""
        return self._machine.homing.next_step

    @property
    def emulated(self) -> bool:
        """Whether the bus reported an emulator."""
        return self._sensing.emulated

    @property
    def motors(self) -> tuple[MotorGuard, MotorGuard]:
        """Heat and limits of both motors."""
        return self._guard.motors

    def open(self) -> None:
        """Open bus and encoder, and reset the drives, which may hold an old current.

        Raises:
            SvsaError: If one of them cannot be opened, with what to do; both are closed then.
        """
        bus = open_bus(self._bench.bus)
        try:
            self._clock.bind(bus)
            self._sensing.source.open()
        except SvsaError:
            bus.shutdown()
            raise
        self._bus = bus
        self._send_resets(bus)

    def arm(self, now: float) -> None:
        """Reset both drives and bring them to READY; a lost bus is opened again.

        Raises:
            StateError: If arming is not permitted.
            BusError: If the bus cannot be opened.
        """
        bus = self._get_bus()
        self._machine.check_arming()
        if self._sensing.lost:
            with contextlib.suppress(*BUS_TROUBLE):
                bus.shutdown()
            self._bus = open_bus(self._bench.bus)
            self._clock.bind(self._bus)
            self._sensing.lost = False
        self._machine.arm()
        self._sensing.forget_alarm()
        self._stops_known, self._late_s = self._count_stops(), 0.0
        self._reset_sent = self._zero_sent = False
        for drive in self._drives:
            drive.begin()

    def confirm_home(self, step: str, by: str) -> None:
        """Confirm that an axis is at its zero mark, by `by`.

        A drive's zero is its position at the reset: an axis that has moved since is not at its
        mark.

        Raises:
            StateError: If the axis has moved, or it is not its turn.
        """
        angle = self._sensing.find_angle(step)
        if self.status is BenchStatus.READY and abs(angle) > HOME_TOLERANCE_RAD:
            name = AXIS_WORDS[step]
            raise StateError(
                f"{name.capitalize()} is {angle:.3f} rad from zero: set the mechanism to its marks,"
                " release it, and arm again."
            )
        self._machine.confirm_home(step, by)

    def start(self, now: float) -> None:
        """Enter RUN at the next tick.

        Raises:
            StateError: If that is not permitted.
        """
        self._machine.start(self._find_age("operator"))

    def stop(self, now: float, reason: str) -> None:
        """Ramp to zero torque."""
        self._machine.stop()

    def quick_stop(self, now: float, reason: str) -> None:
        """Zero current from the next tick on, latched."""
        self.fail("quick_stop", f"Zero current at once: {reason}.", {})

    def clear(self, now: float) -> None:
        """Clear the latched fault: the bench changes from FAULT to OFF.

        Raises:
            StateError: In any other state.
        """
        self._machine.clear()
        self._reset_sent = self._zero_sent = False
        for drive in self._drives:
            drive.phase = Phase.OFF

    def fail(self, code: str, message: str, values: dict[str, float]) -> None:
        """Latch a fault that was found elsewhere."""
        self._machine.fail(Alarm(code, message, values))

    def catch_up(self) -> None:
        """Read the frames since `open`: thousands if the loop took long to load."""
        self._sensing.catch_up(self._get_bus(), self._clock.now())

    def listen(self) -> None:
        """Read waiting frames before a tick is due, so that less is left in the tick."""
        self._sensing.listen(self._get_bus())

    def read(self, now: float, known: State) -> Reading:
        """Read the bench for this tick; `known` is the current x̂, whose velocities compensate the
        ages.
        """
        return self._sensing.read(self._get_bus(), now, known)

    def write(
        self, now: float, limited: Torque, known: State, estimate: Disturbance, missed: int
    ) -> Torque:
        """Send the permitted part of the limited torque.

        Args:
            now: Time, s.
            limited: Torque of the law within its limits, N·m.
            known: x̂, `State`.
            estimate: ŵ, `Disturbance`, N·m.
            missed: Number of ticks lost before this one.

        Returns:
            The torque actually sent, N·m.
        """
        if missed:
            held_s = self._bench.safety.loop_s if self._is_stopped else math.inf
            self._guard.pass_ticks(missed, held_s, self._sensing.current_a)
        self._guard.counts = self._sensing.find_new_counts()
        torque = self._machine.update(self._find_conditions(missed), limited, known, estimate)
        status, sent = self._machine.status, NO_TORQUE
        try:
            # Repeated in every tick: a drive may keep its last current indefinitely, since not
            # every family has a watchdog.
            if status is BenchStatus.FAULT:
                self._silence(now)
            elif status is not BenchStatus.OFF:
                torques = self._guard.real.split(torque)
                sent = self._guard.real.join(
                    Torque(self._send(0, torques.u1, now), self._send(1, torques.u2, now))
                )
        except BUS_TROUBLE as error:
            self._sensing.lost = True
            self.fail("bus_error", f"The bus failed: {error}.", {})
        self._guard.note(sent, self._sensing.current_a)
        return sent

    def _send(self, number: int, torque: float, now: float) -> float:
        """Send one drive's command; return the torque that it holds from now on, N·m."""
        drive, scale = self._drives[number], self._scales[number]
        if drive.phase is not Phase.READY:
            drive.advance(self._get_bus(), now)
            return 0.0
        current = compute_current_ma(torque, scale)
        if drive.send_current(self._get_bus(), current, now):
            return current * scale.torque_per_ma
        self.skipped_commands += 1
        return self._guard.motors[number].last

    def _silence(self, now: float) -> None:
        """Send zero current in every tick, and after the first of them the reset of every drive."""
        bus = self._get_bus()
        if self._zero_sent and not self._reset_sent and self._is_open(now):
            self._send_resets(bus)
            self._reset_sent = True
            for drive in self._drives:
                drive.sent_s = now
            return
        reached = [self._try_zero(bus, drive, now) for drive in self._drives]
        self._zero_sent = self._zero_sent or all(reached)

    def _try_zero(self, bus: can.BusABC, drive: Drive, now: float) -> bool:
        """Send zero current; return success. A failure does not affect the other drive."""
        try:
            return drive.send_zero(bus, now)
        except BUS_TROUBLE:
            self._sensing.lost = True
            return False

    def _send_resets(self, bus: can.BusABC) -> None:
        for frame in self._resets:
            with contextlib.suppress(*BUS_TROUBLE):
                bus.send(frame)

    def _is_open(self, now: float) -> bool:
        return all(drive.is_open(now) for drive in self._drives)

    def _find_conditions(self, missed: int) -> Conditions:
        if missed:
            self._late_s = missed * self._bench.timing.period_s
        return Conditions(
            min((drive.phase for drive in self._drives), key=_ORDER.index),
            self._sensing.ages_s,
            self._sensing.find_alarm(),
            missed,
            self._find_age("supervisor"),
            self._find_age("operator"),
            self._late_s if self._is_stopped else None,
        )

    @property
    def _is_stopped(self) -> bool:
        """Whether the supervisor has stopped the drives since they were armed."""
        return self._count_stops() > self._stops_known

    def _count_stops(self) -> int:
        """Count how often the supervisor has stopped the drives."""
        return self._beats.stops if self._beats is not None else 0

    def _find_age(self, slot: Slot) -> float:
        """Since this heartbeat, s. Without heartbeats, only an emulator goes unsupervised."""
        if self._beats is not None:
            return self._beats.age_s(slot)
        return 0.0 if slot == "supervisor" and self.emulated else math.inf

    def close(self) -> None:
        """Send zero current, reset the drives, and close bus and encoder."""
        self._sensing.source.close()
        if self._bus is None:
            return
        bus, self._bus = self._bus, None
        with contextlib.suppress(SvsaError, *BUS_TROUBLE):
            self._pause(self._gap_s + PAUSE_S)
            for drive in self._drives:
                # An infinite time is later than any command, so no gap delays it.
                self._try_zero(bus, drive, math.inf)
            self._pause(self._gap_s + PAUSE_S)
            self._send_resets(bus)
            self._pause(DELIVERY_S)
        bus.shutdown()

    def _pause(self, seconds: float) -> None:
        self._clock.wait_until(self._clock.now() + seconds)

    def _get_bus(self) -> can.BusABC:
        if self._bus is None:
            raise StateError("The bus of the bench is not open.")
        return self._bus
