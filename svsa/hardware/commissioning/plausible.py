"""Plausibility of a bench file: permitted values that no such bench has."""

import math
from collections.abc import Iterator

from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import compute_coordinate_for_stiffness, compute_coordinate_slope
from svsa.hardware.bench.settings import MotorSettings
from svsa.hardware.commissioning.step import CheckStep, Result
from svsa.hardware.description.file import BenchFile
from svsa.hardware.drives.conversion import MA_PER_A, build_motor_scale
from svsa.runs.definition.design import Design

MAX_ANGLE_RAD = 2.0 * math.pi
TURN_SHARE = 1.5
"""Position limit of motor 2 over its turn to the end of the stiffness range."""
MOST_MOTOR_RPM = 20_000.0
MOST_LINK_RAD_PER_S = 100.0
MOST_DISTURBANCE = 2.0
"""Maximum plausible value, as a multiple of the design's torque limit."""
MOST_PEAK = 2.0
"""The same for the torque at the peak current."""


def list_implausible(bench: BenchFile, design: Design) -> Iterator[CheckStep]:
    """A warning for each limit that protects nothing, and for a design that is not the bench's."""
    if bench.design.file is None and bench.emulator is None:
        yield CheckStep(
            "file: design.file",
            Result.WARN,
            "design.file is not given: gains, limits and inertias are those of the paper's"
            " prototype",
            "Write a parameter file with the values of this bench, and name it in [design] file.",
        )
    plant, home = build_actuator(design.actuator, bench.home.lever_ratio), bench.home.lever_ratio
    low, high = sorted(
        float(compute_coordinate_for_stiffness(plant, sigma))
        for sigma in (
            design.limits.stiffness_min_nm_per_rad,
            design.limits.stiffness_max_nm_per_rad,
        )
    )
    turn = max(abs(end - home) for end in (low, high)) / abs(compute_coordinate_slope(plant))
    for name, torque_nm, most_turn in (
        ("motor1", design.limits.torque1_nm, MAX_ANGLE_RAD),
        ("motor2", design.limits.torque2_nm, max(MAX_ANGLE_RAD, TURN_SHARE * turn)),
    ):
        yield from _list_of_motor(name, getattr(bench, name), torque_nm, most_turn)
    safety, most_nm = bench.safety, design.limits.torque1_nm
    angle = "Give the angle at which the mechanism ends, in rad: 90° are 1.571 rad."
    for field, unit, most, advice in (
        ("link_position_max_rad", "rad", MAX_ANGLE_RAD, angle),
        (
            "link_speed_max_rad_per_s",
            "rad/s",
            MOST_LINK_RAD_PER_S,
            "Give a speed that only a fault can reach: 25 rad/s suits the prototype.",
        ),
        (
            "disturbance_max_nm",
            "N·m",
            MOST_DISTURBANCE * most_nm,
            "Give somewhat more than the largest load: motor 1 makes"
            f" {most_nm:g} N·m, and a wrong encoder is found by this limit only.",
        ),
        (
            "standstill_max_nm",
            "N·m",
            most_nm,
            "Give a little more than twice the friction of a motor.",
        ),
    ):
        yield from _compare(f"safety.{field}", getattr(safety, field), unit, 0.0, most, advice)
    advice = "Give the lever ratio at the zero mark of the stiffness motor, within its end stops."
    yield from _compare("home.lever_ratio", home, "", low, high, advice)


def _list_of_motor(
    name: str, motor: MotorSettings, torque_nm: float, most_turn: float
) -> Iterator[CheckStep]:
    """List the implausible values of a motor.

    Args:
        name: Section of the motor.
        motor: Its settings.
        torque_nm: The design's limit for it.
        most_turn: Largest plausible angle, rad.
    """
    for field in ("position_min_rad", "position_max_rad"):
        advice = "Give the angle at which the mechanism ends, in rad: 90° are 1.571 rad."
        value = getattr(motor, field)
        yield from _compare(f"{name}.{field}", value, "rad", -most_turn, most_turn, advice)
    if motor.gear_ratio is not None:
        most = MOST_MOTOR_RPM * 2.0 * math.pi / 60.0 / motor.gear_ratio
        advice = (
            f"Beyond it the motor turns faster than {MOST_MOTOR_RPM:g} rpm: give the speed at the"
            " gearbox output that the data sheet allows."
        )
        value = motor.speed_max_rad_per_s
        yield from _compare(f"{name}.speed_max_rad_per_s", value, "rad/s", 0.0, most, advice)
    if None in (motor.gear_ratio, motor.torque_constant_nm_per_a, motor.efficiency):
        return
    per_a = abs(build_motor_scale(motor).torque_per_ma) * MA_PER_A
    advice = (
        f"The design commands up to {torque_nm:g} N·m, which need {torque_nm / per_a:.3g} A:"
        " compare nominal_current_a and peak_current_a with the data sheet of this motor (not of"
        " the other one), or the torque limit in the [design] file."
    )
    least, most = torque_nm / per_a, MOST_PEAK * torque_nm / per_a
    yield from _compare(f"{name}.peak_current_a", motor.peak_current_a, "A", least, most, advice)


def _compare(
    field: str, value: float, unit: str, least: float, most: float, advice: str
) -> Iterator[CheckStep]:
    if not least <= value <= most:
        unit = f" {unit}" if unit else ""
        bound = f"at most {most:.4g}{unit}" if value > most else f"at least {least:.4g}{unit}"
        measured = f"{field} is {value:g}{unit}: plausible is {bound}"
        yield CheckStep(f"file: {field}", Result.WARN, measured, advice)
