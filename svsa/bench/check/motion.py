"""Do motors and encoders turn the way the bench file says? Short pulses of current tell.

The pulses grow from 1 % to 15 % of the motor's nominal current and get shorter as they grow, so
that a motor whose encoder is dead gets no more impulse than one that works.
"""

import math
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import NamedTuple

from svsa.bench.check.probe import Probe, Traffic
from svsa.bench.check.step import CheckStep, Result
from svsa.bench.drives.conversion import build_deflection_scale, build_motor_scale
from svsa.bench.drives.robomodule import Address
from svsa.bench.file import BenchFile, MotorSettings

LEVELS = (0.01, 0.02, 0.03, 0.05, 0.08, 0.11, 0.15)
LONGEST_PULSE_S = 0.15
IMPULSE_S = 0.003
MAX_TRAVEL_RAD = 0.03
MIN_COUNTS = 8
MIN_DEFLECTION_COUNTS = 4
COAST_S = 0.02
"""A motor's counts are followed for so long after a pulse: both lag behind the current."""
SETTLE_S = 0.2
MAX_UNHEARD = 0.25
"""A pulse tells only where no longer share of it went by without feedback of its drive."""
MAX_REPEATS = 5
"""Of pulses that told nothing, per motor: the motor gets no more impulse than that."""
_SEND_S = 0.002


class Pulse(NamedTuple):
    """What a pulse did. current_ma, duration_s: asked for.

    moved, deflected: largest change of counts, either way. measured_ma: largest feedback of
    the current, with its sign. errors: D frames. unheard_s: longest time of the pulse without
    feedback.
    """

    current_ma: int
    duration_s: float
    moved: int = 0
    deflected: int = 0
    measured_ma: int = 0
    errors: int = 0
    unheard_s: float = math.inf

    @property
    def was_followed(self) -> bool:
        """Whether enough of it was heard for what it did to tell something of the motor."""
        return self.unheard_s <= MAX_UNHEARD * self.duration_s


def check_motion(probe: Probe, name: str) -> Iterator[CheckStep]:
    """Turn one motor a little forth and back; judge its signs, and those of the deflection.

    The deflection is judged by motor 1, so only where that counts the right way.
    """
    motor: MotorSettings = getattr(probe.bench, name)
    pulse, back = _turn(probe, name, motor)
    judged = _judge_motor(name, motor, pulse, back)
    yield judged
    if name == "motor1" and judged.result is not Result.FAIL:
        yield _judge_deflection(probe.bench, pulse)


def _turn(probe: Probe, name: str, motor: MotorSettings) -> tuple[Pulse, Pulse]:
    """Pulses forth and back, each pair stronger, until one has told enough; returns the last.

    A pair that was not followed, by a computer or a bus that stood still, is given again.
    """
    pulse = back = Pulse(0, 0.0)
    repeats = MAX_REPEATS
    for level in LEVELS:
        current = (motor.sign or 1) * round(1e3 * level * motor.nominal_current_a)
        duration = min(LONGEST_PULSE_S, IMPULSE_S / level)
        while True:
            pulse = _pulse(probe, name, current, duration)
            back = _pulse(probe, name, -current, duration)
            if pulse.errors or back.errors:
                return pulse, back
            if pulse.was_followed and back.was_followed:
                break
            if repeats == 0:
                return pulse, back
            repeats -= 1
        if _is_clear(name, pulse):
            break
    return pulse, back


def _is_clear(name: str, pulse: Pulse) -> bool:
    """Whether the motor has moved, and with motor 1 the deflection as well."""
    deflected = name != "motor1" or abs(pulse.deflected) >= MIN_DEFLECTION_COUNTS
    return abs(pulse.moved) >= MIN_COUNTS and deflected


def _get_most_counts(motor: MotorSettings) -> float:
    """Counts at which a pulse ends: 0.03 rad, or a tenth of a motor turn where unknown."""
    if motor.counts_per_rev and motor.gear_ratio:
        return MAX_TRAVEL_RAD / abs(build_motor_scale(motor).angle_per_count)
    return 0.1 * (motor.counts_per_rev or 1000)


def _pulse(probe: Probe, name: str, current_ma: int, duration_s: float) -> Pulse:
    """A current for this long, or until the motor or the spring has gone far enough."""
    address = probe.motors[name]
    before = probe.listen(0.02)
    if not (before.feedback.get(address) and before.deflection):
        return Pulse(current_ma, duration_s)
    start = before.feedback[address][-1].feedback.position_counts
    spring = before.deflection[-1].counts
    most = _get_most_counts(getattr(probe.bench, name))
    most_spring = MAX_TRAVEL_RAD / abs(build_deflection_scale(probe.bench.deflection))
    traffic, begin = Traffic(), probe.now()
    end = begin + duration_s
    try:
        while probe.now() < end and not traffic.drive_errors.get(address):
            probe.send_current(name, current_ma)
            for _ in probe.follow(_SEND_S, traffic):
                pass
            moved, deflected = _find_travel(traffic, address, start, spring)
            if abs(moved) >= most or abs(deflected) >= max(most_spring, MIN_COUNTS):
                break
    finally:
        probe.send_current(name, 0)
    heard = traffic.feedback.get(address, [])
    times = [begin, *(frame.time_s for frame in heard), probe.now()]
    unheard = max(later - earlier for earlier, later in pairwise(times))
    measured = max((frame.feedback.current_ma for frame in heard), key=abs, default=0)
    _, deflected = _find_travel(traffic, address, start, spring)
    for _ in probe.follow(COAST_S, traffic):
        pass
    moved, _ = _find_travel(traffic, address, start, spring)
    after = probe.listen(SETTLE_S - COAST_S)
    errors = traffic.drive_errors.get(address, 0) + after.drive_errors.get(address, 0)
    return Pulse(current_ma, duration_s, moved, deflected, measured, errors, unheard)


def _find_travel(traffic: Traffic, address: Address, start: int, spring: int) -> tuple[int, int]:
    """The largest change so far of the motor's counts and of the deflection's."""
    heard = [frame.feedback.position_counts for frame in traffic.feedback.get(address, [])]
    moved = max((counts - start for counts in heard), key=abs, default=0)
    return moved, max((counts - spring for counts, _ in traffic.deflection), key=abs, default=0)


def _judge_motor(name: str, motor: MotorSettings, pulse: Pulse, back: Pulse) -> CheckStep:
    title = f"{name}: sign"
    asked = f"{pulse.current_ma:+d} mA"
    measured = (
        f"{asked} (measured {pulse.measured_ma:+d}) moved it by {pulse.moved:+d} counts,"
        f" {back.current_ma:+d} mA by {back.moved:+d}"
    )
    if pulse.errors or back.errors:
        advice = (
            "The drive went into stall protection: see that the motor turns freely, its brake is"
            " off and its leads are not shorted; switch the drive off and on."
        )
        return CheckStep(title, Result.FAIL, measured, advice)
    if not (pulse.was_followed and back.was_followed):
        unheard = 1e3 * max(pulse.unheard_s, back.unheard_s)
        measured += f", no feedback for {unheard:.0f} of {1e3 * pulse.duration_s:.0f} ms"
        advice = (
            "The pulses could not be followed: leave the machine to this program, take other"
            " traffic off the bus, and run the check again."
        )
        return CheckStep(title, Result.FAIL, measured, advice)
    if abs(pulse.moved) < MIN_COUNTS:
        if abs(pulse.measured_ma) < 0.5 * abs(pulse.current_ma):
            advice = (
                "No current flows: check the motor's leads and the drive's supply, and that"
                " pwm_limit is not too low."
            )
        else:
            advice = (
                "Current flows, but the drive counts nothing: either the motor is held (brake,"
                " clamp, stop) or its encoder is not read (5 V, A and B, plug). If you saw it"
                " turn, it is the encoder."
            )
        return CheckStep(title, Result.FAIL, measured, advice)
    if pulse.moved * pulse.current_ma < 0:
        advice = (
            "Positive current turns it towards negative counts: swap the encoder's A and B, or"
            " the two leads of the motor, at the drive. Not the sign in the bench file: it turns"
            " current and counts together."
        )
        return CheckStep(title, Result.FAIL, measured, advice)
    if pulse.moved * back.moved >= 0:
        advice = (
            "It went the same way for both currents: something else moves it (a hung load, a hand,"
            " a stop). Free the mechanism and run the check again."
        )
        return CheckStep(title, Result.FAIL, measured, advice)
    if motor.sign is None:
        advice = f"Give [{name}] sign in the bench file: 1 if it first turned the positive way."
        return CheckStep(title, Result.WARN, measured, advice)
    return CheckStep(title, Result.OK, measured)


def _judge_deflection(bench: BenchFile, pulse: Pulse) -> CheckStep:
    """φ = q − θ1, and the link lags behind: φ goes the other way than motor 1."""
    title = "deflection: sign"
    scale = build_deflection_scale(bench.deflection)
    turned = pulse.moved * build_motor_scale(bench.motor1).angle_per_count
    known = bench.motor1.counts_per_rev and bench.motor1.gear_ratio
    angle = f" ({math.degrees(turned):+.2f}°)" if known else ""
    measured = f"motor1 {pulse.moved:+d} counts{angle}: deflection {pulse.deflected:+d} counts"
    if bench.deflection.counts_per_rev:
        measured += f" ({math.degrees(pulse.deflected * scale):+.2f}°)"
    if abs(pulse.deflected) < MIN_DEFLECTION_COUNTS:
        advice = (
            "The principal motor turned and the deflection did not change: check that the encoder"
            " is coupled to the shaft, its 5 V, A and B, and that the spring's pivot is not at"
            " rigid. An encoder with few lines cannot be tested so: turn the link by hand."
        )
        return CheckStep(title, Result.FAIL, measured, advice)
    if turned * pulse.deflected * scale > 0:
        advice = (
            "The deflection φ = q − θ1 must go the other way than the motor: set sign ="
            f" {-(bench.deflection.sign or 1)} in [deflection] of the bench file, or swap the"
            " encoder's A and B."
        )
        return CheckStep(title, Result.FAIL, measured, advice)
    if bench.deflection.sign is None:
        advice = "Give [deflection] sign in the bench file: 1 fits what was seen."
        return CheckStep(title, Result.WARN, measured, advice)
    return CheckStep(title, Result.OK, measured)


def check_directions(bench: BenchFile, watch: Callable[[str], bool] | None) -> Iterator[CheckStep]:
    """What only somebody who looks can say: which way each motor went first."""
    ways = {
        "motor1": "the way that you count as positive angles of the link",
        "motor2": "the way that makes the actuator stiffer (lever ratio growing)",
    }
    for name, way in ways.items():
        title = f"{name}: direction"
        if watch is None:
            advice = "Run the check again with somebody at the bench who says which way it turned."
            yield CheckStep(title, Result.WARN, "nobody was asked", advice)
        elif watch(f"Did {name} turn first {way}?"):
            yield CheckStep(title, Result.OK, f"turned first {way}")
        else:
            sign = -(getattr(bench, name).sign or 1)
            advice = f"Set sign = {sign} in [{name}] of the bench file, and run the check again."
            yield CheckStep(title, Result.FAIL, f"did not turn {way}", advice)
