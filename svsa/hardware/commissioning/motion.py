"""Do motors and encoders turn the way the bench file says? Short pulses of current tell."""

import math
from collections.abc import Callable, Iterator

from svsa.hardware.commissioning.probe import CheckStep, Probe, Result
from svsa.hardware.commissioning.pulse import (
    MIN_COUNTS,
    MIN_DEFLECTION_COUNTS,
    Pulse,
    Turn,
    turn_a_little,
)
from svsa.hardware.drives.conversion import build_deflection_scale, build_motor_scale
from svsa.hardware.drives.family import Advice
from svsa.hardware.file import BenchFile
from svsa.hardware.settings import MotorSettings


def check_motion(probe: Probe, name: str) -> Iterator[CheckStep]:
    """Turn one motor a little forth and back; judge its signs, and those of the deflection.

    The deflection is judged by motor 1, so only where that counts the right way.
    """
    motor: MotorSettings = getattr(probe.bench, name)
    turn = turn_a_little(probe, name)
    judged = _judge_motor(name, motor, turn, probe.families[name].advice)
    yield judged
    if name == "motor1" and judged.result is not Result.FAIL:
        yield _judge_deflection(probe.bench, turn.forth)


def _judge_motor(name: str, motor: MotorSettings, turn: Turn, advices: Advice) -> CheckStep:
    title = f"{name}: sign"
    pulse, back = turn
    asked = f"{pulse.current_ma:+d} mA"
    measured = (
        f"{asked} (measured {pulse.measured_ma:+d}) moved it by {pulse.moved:+d} counts,"
        f" {back.current_ma:+d} mA by {back.moved:+d}"
    )
    if turn.errors:
        return CheckStep(title, Result.FAIL, measured, advices.error)
    if not turn.was_followed:
        unheard_ms, pulse_ms = 1e3 * turn.unheard_s, 1e3 * pulse.duration_s
        measured += f", no feedback for {unheard_ms:.0f} of {pulse_ms:.0f} ms"
        advice = (
            "The pulses could not be followed: leave the machine to this program, take other"
            " traffic off the bus, and run the check again."
        )
        return CheckStep(title, Result.FAIL, measured, advice)
    if abs(pulse.moved) < MIN_COUNTS:
        if abs(pulse.measured_ma) < 0.5 * abs(pulse.current_ma):
            advice = (
                "No current flows: check the motor's leads and the drive's supply, and"
                f" {advices.current}."
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
    """Ask an observer which way each motor went first."""
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
