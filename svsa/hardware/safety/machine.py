"""The state machine of a bench: permitted commands of each state, and its transitions.

    OFF → RESET → CONFIG → MODE → READY → RUN → RAMP → READY        any → FAULT → OFF

A fault is latched with its values, the first one counts, and only `clear` leaves it. Outside RUN
and RAMP the torque is zero.
"""

import math
from enum import StrEnum
from typing import NamedTuple

from svsa.actuators.signals import Disturbance, State, Torque
from svsa.errors import Fault, StateError
from svsa.hardware.bench.homing import Homing
from svsa.hardware.bench.settings import AXIS_WORDS
from svsa.hardware.description.file import BenchFile
from svsa.hardware.drives.phase import Phase
from svsa.hardware.safety.faults import Alarm, FaultLatch
from svsa.hardware.safety.guard import Guard

NO_TORQUE = Torque(0.0, 0.0)
AXES = ("motor1", "motor2", "deflection")


class BenchStatus(StrEnum):
    """The states."""

    OFF = "off"
    RESET = "reset"
    CONFIG = "config"
    MODE = "mode"
    READY = "ready"
    RUN = "run"
    RAMP = "ramp"
    FAULT = "fault"


class Conditions(NamedTuple):
    """The conditions of a bench in a tick.

    Attributes:
        phase: Phase of the drive with the slower start-up.
        ages_s: Ages of motor 1, motor 2, deflection, s; infinite before the first reading.
        alarm: Alarm of the sensing, or None.
        missed: Number of ticks lost before this one.
        supervisor_age_s: Time since the supervisor's last heartbeat, s; infinite if there is none.
        operator_age_s: Time since the operator's last heartbeat, s; infinite if there is none.
        late_s: Delay of the loop when the supervisor stopped the drives, s; None if it has not
            since they were armed.
    """

    phase: Phase
    ages_s: tuple[float, float, float]
    alarm: Alarm | None
    missed: int
    supervisor_age_s: float
    operator_age_s: float
    late_s: float | None = None


SEQUENCE = {
    Phase.RESET: BenchStatus.RESET,
    Phase.CONFIG: BenchStatus.CONFIG,
    Phase.MODE: BenchStatus.MODE,
    Phase.READY: BenchStatus.READY,
}
ARMING = (BenchStatus.RESET, BenchStatus.CONFIG, BenchStatus.MODE)
MOVING = (BenchStatus.RUN, BenchStatus.RAMP)


class Machine:
    """The state of a bench. problems: reasons why it cannot be armed."""

    def __init__(self, bench: BenchFile, guard: Guard, problems: list[str]) -> None:
        self.status = BenchStatus.OFF
        self._latch = FaultLatch()
        self.problems = problems
        self.homing = Homing()
        self._safety, self._guard = bench.safety, guard
        self._period = bench.timing.period_s
        self._tick = 0
        self._share = 0.0

    @property
    def fault(self) -> Fault | None:
        """The latched fault; None unless FAULT."""
        return self._latch.fault

    def check_arming(self) -> None:
        """Raise `StateError` unless calibrated, and OFF or READY."""
        if self.status not in (BenchStatus.OFF, BenchStatus.READY):
            raise StateError(f"The bench is {self.status}: it is armed from OFF or READY.")
        if self.problems:
            raise StateError("The bench does not arm. " + "; ".join(self.problems) + ".")

    def arm(self) -> None:
        """Start up the drives.

        Raises:
            StateError: As `check_arming`.
        """
        self.check_arming()
        self.homing.reset()
        self.status = BenchStatus.RESET

    def confirm_home(self, step: str, by: str) -> None:
        """Confirm that an axis is at its zero mark.

        Raises:
            StateError: Unless READY.
        """
        if self.status is not BenchStatus.READY:
            raise StateError(f"The bench is {self.status}: its marks are confirmed in READY.")
        self.homing.confirm(step, by)

    def start(self, operator_age_s: float) -> None:
        """Enter RUN.

        Raises:
            StateError: Unless READY, homed, and with the dead-man's switch held.
        """
        if self.status is not BenchStatus.READY:
            raise StateError(f"The bench is {self.status}: it starts from READY; arm it first.")
        if self.homing.next_step is not None:
            axis = AXIS_WORDS[self.homing.next_step]
            raise StateError(f"The zero mark of {axis} is not confirmed yet.")
        if self._safety.dead_man and operator_age_s > self._safety.operator_s:
            raise StateError("The dead-man's switch is not held: hold it, then start.")
        self.status, self._share, self._tick = BenchStatus.RUN, 1.0, 0
        self._guard.begin()

    def stop(self) -> None:
        """Ramp to zero torque; no effect unless running."""
        if self.status is BenchStatus.RUN:
            self.status = BenchStatus.RAMP

    def clear(self) -> None:
        """Clear the latched fault: the bench changes from FAULT to OFF.

        Raises:
            StateError: In any other state.
        """
        if self.status is not BenchStatus.FAULT:
            raise StateError(f"The bench is {self.status}: there is no fault to clear.")
        self._latch.clear()
        self.status = BenchStatus.OFF

    def fail(self, alarm: Alarm) -> None:
        """Latch a fault, unless there is one; its time is the run's."""
        time_s = self._tick * self._period
        self._latch.take(Fault(alarm.code, 0, self._tick, time_s, alarm.message, alarm.values))
        self.status = BenchStatus.FAULT

    def update(
        self, conditions: Conditions, limited: Torque, known: State, estimate: Disturbance
    ) -> Torque:
        """Update the state.

        Args:
            conditions: Conditions of this tick.
            limited: Torque of the law within its limits, N·m.
            known: x̂, `State`.
            estimate: ŵ, `Disturbance`, N·m.

        Returns:
            The permitted torque of this tick, N·m.
        """
        # Ticks missed before tick 0 are not part of the run.
        if self._tick and self.status in MOVING:
            self._tick += conditions.missed
        alarm = self._find_alarm(conditions)
        if alarm is None and self.status in MOVING:
            alarm = self._guard.check(limited, known, estimate)
        elif alarm is None and self.status is not BenchStatus.OFF:
            # A load can move the mechanism without motor torque.
            alarm = self._guard.check_motion(known)
        if alarm is not None:
            self.fail(alarm)
        if self.status in ARMING:
            self.status = SEQUENCE.get(conditions.phase, self.status)
        silent = self._safety.dead_man and conditions.operator_age_s > self._safety.operator_s
        if self.status is BenchStatus.RUN and silent:
            self.status = BenchStatus.RAMP
        if self.status is BenchStatus.RAMP:
            # Missed ticks count: the ramp lasts `ramp_s` of real time.
            self._share -= (1 + conditions.missed) * self._period / self._safety.ramp_s
            if self._share <= 0.0:
                self.status = BenchStatus.READY
        if self.status not in MOVING:
            return NO_TORQUE
        self._tick += 1
        # Feedback older than 5 ms gives zero torque, older than 20 ms (`stale_fault_s`) a fault: a
        # short gap on the bus does not end the run.
        if max(conditions.ages_s) > self._safety.stale_zero_s:
            return NO_TORQUE
        share = self._share
        return self._guard.limit(Torque(share * limited.u1, share * limited.u2), known)

    def _find_alarm(self, conditions: Conditions) -> Alarm | None:
        """Return the alarm that the bench's conditions cause in the monitored states."""
        if self.status in (BenchStatus.OFF, BenchStatus.FAULT):
            return None
        # Before the alarms of the bus: they would report the supervisor's frames as those of
        # another program, and its reset as a restart of a drive.
        if conditions.late_s is not None:
            return _describe_lateness(conditions.late_s, self._safety.loop_s)
        supervisor_age_s = conditions.supervisor_age_s
        if self.status not in ARMING and supervisor_age_s > self._safety.supervisor_s:
            return _describe_lost_supervisor(supervisor_age_s)
        if conditions.alarm is not None:
            return conditions.alarm
        if conditions.phase is Phase.SILENT:
            return Alarm(
                "drive_silent",
                "A drive did not answer: check its supply, the CAN wiring, both 120 Ω"
                " terminators, the bit rate and the drive's address.",
                {},
            )
        if self.status in ARMING:
            return None
        safety = self._safety
        for axis, age in zip(AXES, conditions.ages_s, strict=True):
            if age > safety.stale_fault_s:
                words = (
                    f"The feedback of {AXIS_WORDS[axis]} is older than"
                    f" {1e3 * safety.stale_fault_s:g} ms."
                )
                return Alarm("stale_feedback", words, {f"{axis}_age_s": min(age, 1e6)})
        if conditions.missed >= safety.missed_ticks:
            words = f"The loop missed {conditions.missed} ticks in a row."
            return Alarm("missed_ticks", words, {"missed_ticks": conditions.missed})
        return self._guard.find_overload()


def _describe_lateness(late_s: float, waits_s: float) -> Alarm:
    """Describe the alarm for drives stopped by frames of the supervisor."""
    late_s = max(late_s, waits_s)
    words = (
        f"The control loop was {1e3 * late_s:.0f} ms late. The supervisor, which waits"
        f" {1e3 * waits_s:g} ms, has set both drives to zero current and reset them."
    )
    return Alarm("loop_late", words, {"late_s": late_s, "supervisor_waits_s": waits_s})


def _describe_lost_supervisor(age_s: float) -> Alarm:
    if math.isinf(age_s):
        words = (
            "There is no supervisor: its process has ended, or has not received a frame of"
            " the bus yet."
        )
        return Alarm("supervisor_lost", words, {})
    words = f"The supervisor has been silent for {age_s:.3f} s."
    return Alarm("supervisor_lost", words, {"supervisor_age_s": age_s})
