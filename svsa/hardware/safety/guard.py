"""The limits of one tick on a bench: permitted torque, and conditions that end the run."""

import math
from collections import deque

from svsa.actuators.domain import INSIDE, Bounds, Domain, check_packed_domain
from svsa.actuators.elasticity import AnyActuator
from svsa.actuators.faults import ALLOWED_TORQUE, FAULT_CODES, label_fault
from svsa.actuators.signals import Disturbance, State, Torque
from svsa.hardware.bench.real_motors import RealMotors
from svsa.hardware.bench.settings import AXIS_WORDS, MotorSettings
from svsa.hardware.description.file import BenchFile
from svsa.hardware.safety.faults import Alarm
from svsa.hardware.safety.heat import (
    HeatReduction,
    HeatReductionState,
    Winding,
    describe_heat_reduction,
)
from svsa.hardware.safety.standstill import NewCounts, Standstill
from svsa.numerics.packed import pack

SWING_RAD_PER_S = 2.0
REVERSALS = 10
WINDOW_S = 0.5


class Vibration:
    """Counts the reversals of one motor; `period` is that of the ticks, s.

    A vibrating motor indicates a loop that is unstable within its limits. Causes: a deflection
    encoder that is frozen or counts in the wrong direction, late feedback, gains that are too high.
    ŵ stays plausible, but the motor reverses faster than any reference (5 Hz) requires.
    """

    def __init__(self, period: float) -> None:
        self._window = round(WINDOW_S / period)
        self._reversals: deque[int] = deque(maxlen=REVERSALS)
        self._tick, self._sign = 0, 0

    def update(self, velocity: float) -> bool:
        """Update with the velocity of a tick (rad/s at the output).

        Returns whether the motor reversed ten times within 0.5 s at ±2 rad/s.
        """
        self._tick += 1
        if abs(velocity) > SWING_RAD_PER_S:
            sign = 1 if velocity > 0.0 else -1
            if sign == -self._sign:
                self._reversals.append(self._tick)
            self._sign = sign
        seen = self._reversals
        return len(seen) == REVERSALS and self._tick - seen[0] <= self._window

    def reset(self) -> None:
        """Reset for a new run."""
        self._reversals.clear()
        self._sign = 0


POSITION_MARGIN_RAD = 0.2
OVERLOAD = 1.05
_STILL = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class MotorGuard:
    """The limits of one motor.

    Its winding is heated by the commanded current or, if that is greater, by the reported one. A
    drive with more current than heat permits brings it above 1.05, which ends the run. `last` is
    the last torque sent, N·m.
    """

    def __init__(self, name: str, motor: MotorSettings, torque_max: float, rate: float) -> None:
        self.name, self._title, self._motor = name, AXIS_WORDS[name].capitalize(), motor
        self._rate = rate
        self.winding, self._holding = Winding(motor, torque_max), HeatReductionState()
        self.last = 0.0

    @property
    def heat_reduction(self) -> HeatReduction | None:
        """Torque reduction by heat, now or within the last half second; None without."""
        return self._holding.present

    def begin(self) -> None:
        """Start a new run; heat carries over from earlier runs."""
        self._holding.forget()

    def warm(self, current_a: float, seconds: float) -> None:
        """Update the heat after this time with the last command; `current_a` is the reported
        current.
        """
        made = abs(current_a) * self.winding.scale
        self.winding.warm(max(abs(self.last), made), seconds)
        self._holding.pass_time(seconds)

    def limit(self, torque: float, angle: float, period: float) -> float:
        """Return the permitted torque (N·m): limit, rate, heat, and position ends."""
        self._holding.note(self.winding.find_heat_reduction(torque))
        most = self.winding.allow()
        torque = min(max(torque, -most), most)
        step = self._rate * period
        torque = min(max(torque, self.last - step), self.last + step)
        # Last: beyond the end of the range the outward torque becomes zero at once, regardless of
        # the rate limit.
        if angle > self._motor.position_max_rad:
            torque = min(torque, 0.0)
        elif angle < self._motor.position_min_rad:
            torque = max(torque, 0.0)
        return torque

    def check(self, angle: float, velocity: float) -> Alarm | None:
        """Return the motor's fault, or None."""
        name, motor = self.name, self._motor
        if abs(velocity) > motor.speed_max_rad_per_s:
            return _exceeded(
                "overspeed",
                f"{self._title} turned with",
                f"{name}_velocity_rad_per_s",
                velocity,
                motor.speed_max_rad_per_s,
                "rad/s",
            )
        beyond = max(angle - motor.position_max_rad, motor.position_min_rad - angle)
        # Up to the margin only the outward torque is blocked (`limit`); beyond it the run ends.
        if beyond > POSITION_MARGIN_RAD:
            end = motor.position_max_rad if angle > 0.0 else motor.position_min_rad
            words = f"{self._title} stood at"
            return _exceeded("position_limit", words, f"{name}_position_rad", angle, end, "rad")
        return None

    def find_overload(self) -> Alarm | None:
        """Return the alarm of a winding hotter than commanded torques explain, or None."""
        heat = self.winding.heat
        if heat <= OVERLOAD:
            return None
        words = f"{self._title} is too warm: its heat (I²t, 1 is the limit of its winding) was"
        return _exceeded("overload", words, f"{self.name}_heat", heat, OVERLOAD, "")

    def explain(self, alarm: Alarm) -> Alarm:
        """Prefix an alarm with the reduction by heat, if there was one."""
        held = self.heat_reduction
        if held is None:
            return alarm
        values = {
            f"{self.name}_heat": self.winding.heat,
            f"{self.name}_commanded_nm": held.commanded_nm,
            self.name + ALLOWED_TORQUE: held.allowed_nm,
        }
        words = describe_heat_reduction(self.name, held, self.winding)
        return Alarm(alarm.code, f"{words} {alarm.message}", {**alarm.values, **values})


class Guard:
    """The limits of the whole bench.

    `counts` are those of motor 1, motor 2 and deflection in this tick; None for one that is too
    old.
    The limits of torque, heat, speed and position are those of the motors `real`.
    """

    def __init__(
        self,
        bench: BenchFile,
        torque_max: tuple[float, float],
        domain: Domain,
        actuator: AnyActuator,
        real: RealMotors,
    ) -> None:
        rate = bench.safety.torque_rate_nm_per_s
        self._safety, self._period = bench.safety, bench.timing.period_s
        self._bounds, self.real = pack(Bounds(domain, actuator)), real
        self.motor1 = MotorGuard("motor1", bench.motor1, torque_max[0], rate)
        self.motor2 = MotorGuard("motor2", bench.motor2, torque_max[1], rate)
        self.motors = (self.motor1, self.motor2)
        self.counts: NewCounts | None = None
        self._standstill = Standstill(bench.safety.standstill_max_nm)
        self._vibrations = (Vibration(self._period), Vibration(self._period))
        check_packed_domain(self._bounds, _STILL)  # compiled here, not in the first running tick

    def limit(self, limited: Torque, known: State) -> Torque:
        """Return the permitted part of `limited`, N·m."""
        torques = self.real.split(limited)
        angle1, angle2 = self.real.find_angles(known.theta1, known.theta2)
        return self.real.join(
            Torque(
                self.motor1.limit(torques.u1, angle1, self._period),
                self.motor2.limit(torques.u2, angle2, self._period),
            )
        )

    def note(self, sent: Torque, current_a: tuple[float, float]) -> None:
        """Note the torque sent in this period, N·m, and the reported currents."""
        for motor, torque, current in zip(
            self.motors, self.real.split(sent), current_a, strict=True
        ):
            motor.last = torque
            motor.warm(current, self._period)

    def pass_ticks(self, missed: int, held_s: float, current_a: tuple[float, float]) -> None:
        """Account for periods without a command, during which a drive holds its last current.

        `held_s` is the maximum of that time, s, after which the supervisor sent zero current;
        `current_a` are the reported currents.
        """
        seconds = missed * self._period
        for motor, current in zip(self.motors, current_a, strict=True):
            motor.warm(current, min(seconds, held_s))
            if seconds > held_s:
                motor.last = 0.0
                motor.warm(current, seconds - held_s)

    def find_overload(self) -> Alarm | None:
        """Return the alarm of an overheated motor, or None."""
        return self.motor1.find_overload() or self.motor2.find_overload()

    def check(self, limited: Torque, known: State, estimate: Disturbance) -> Alarm | None:
        """Return the alarm that ends the run, or None; `known` is x̂, `estimate` ŵ, N·m."""
        # First, because every comparison below is false with NaN.
        if not math.isfinite(limited.u1 + limited.u2 + sum(known) + sum(estimate)):
            return Alarm("not_finite", "A torque or a state was not a finite number.", {})
        alarm = (
            self.check_motion(known)
            or self._check_domain(known)
            or self._check_estimate(estimate)
            or self._check_standstill(estimate)
            or self._check_vibration(known)
        )
        return alarm and self.motor1.explain(self.motor2.explain(alarm))

    def check_motion(self, known: State) -> Alarm | None:
        """Which limit of position or speed is exceeded, or None; holds without torque as well."""
        angle1, angle2 = self.real.find_angles(known.theta1, known.theta2)
        velocity1, velocity2 = self.real.find_angles(known.dtheta1, known.dtheta2)
        return (
            self.motor1.check(angle1, velocity1)
            or self.motor2.check(angle2, velocity2)
            or self._check_link(known)
        )

    def begin(self) -> None:
        """Start a new run."""
        self._standstill.reset()
        for motor in self.motors:
            motor.begin()
        for vibration in self._vibrations:
            vibration.reset()

    def _check_link(self, known: State) -> Alarm | None:
        safety = self._safety
        if abs(known.dq) > safety.link_speed_max_rad_per_s:
            most = safety.link_speed_max_rad_per_s
            words = "The link turned with"
            return _exceeded("overspeed", words, "velocity_rad_per_s", known.dq, most, "rad/s")
        if abs(known.q) > safety.link_position_max_rad:
            most = safety.link_position_max_rad
            words = "The link stood at"
            return _exceeded("position_limit", words, "position_rad", known.q, most, "rad")
        return None

    def _check_domain(self, known: State) -> Alarm | None:
        code = check_packed_domain(self._bounds, known)
        if code == INSIDE:
            return None
        values = {"deflection_rad": known.q - known.theta1, "motor2_position_rad": known.theta2}
        message = (
            f"{label_fault(FAULT_CODES[code])}: the actuator left the domain of the model with a"
            f" deflection of {values['deflection_rad']:.4f} rad and its stiffness motor at"
            f" {known.theta2:.4f} rad."
        )
        return Alarm(FAULT_CODES[code], message, values)

    def _check_standstill(self, estimate: Disturbance) -> Alarm | None:
        motors = self.real.split(Torque(estimate.w4, estimate.w6))
        return self._standstill.check(self.counts, Disturbance(estimate.w2, *motors))

    def _check_vibration(self, known: State) -> Alarm | None:
        velocity1, velocity2 = self.real.find_angles(known.dtheta1, known.dtheta2)
        shakes1 = self._vibrations[0].update(velocity1)
        shakes2 = self._vibrations[1].update(velocity2)
        if not (shakes1 or shakes2):
            return None
        name, velocity = ("motor1", velocity1) if shakes1 else ("motor2", velocity2)
        words = (
            f"{AXIS_WORDS[name].capitalize()} oscillates: it reversed {REVERSALS} times within"
            f" {WINDOW_S:g} s. The loop is unstable: an encoder is frozen or counts in the wrong"
            " direction, feedback is late, or the gains are too high."
        )
        return Alarm("vibration", words, {f"{name}_velocity_rad_per_s": velocity})

    def _check_estimate(self, estimate: Disturbance) -> Alarm | None:
        most = self._safety.disturbance_max_nm
        for name, value in zip(("link", "motor1", "motor2"), estimate, strict=True):
            if abs(value) > most:
                words = (
                    f"The observer estimates a torque on {AXIS_WORDS[name]} that no load"
                    " makes: it was"
                )
                return _exceeded("implausible", words, f"estimate_{name}_nm", value, most, "N·m")
        return None


def _exceeded(code: str, subject: str, name: str, value: float, most: float, unit: str) -> Alarm:
    """Build the alarm of an exceeded limit; `subject` is the quantity for users, `name` for
    scripts.
    """
    words = f"{subject} {value:.4g} {unit}: the limit is {most:.4g} {unit}."
    return Alarm(
        code, words.replace(" :", ":").replace(" .", "."), {name: value, f"{name}_limit": most}
    )
