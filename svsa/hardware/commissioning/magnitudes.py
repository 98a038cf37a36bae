"""Check the scales of the bench file: fitted values, compared with those of the file.

The gain k of a motor contains its gear ratio twice, its counts per turn and its torque constant
once. The ratio r of motor 1 to the deflection contains gear ratio and counts once, and no torque
constant. Therefore the errors of both together identify the wrong field of motor 1 or of the
deflection.
"""

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import compute_coordinate_for_stiffness, compute_stiffness_of
from svsa.actuators.parameters import MechanismParameters
from svsa.hardware.bench.settings import MotorSettings
from svsa.hardware.commissioning.fit import LinkFit, fit_motor
from svsa.hardware.commissioning.pulse import Turn
from svsa.hardware.commissioning.step import CheckStep, Result
from svsa.hardware.description.file import BenchFile

GAIN_TOLERANCE = 1.5
"""Factor by which k may differ, because of the uncertainty of inertia, efficiency and friction."""
RATIO_TOLERANCE = 1.25
"""The same for r, which depends only on counts and a gear ratio."""
STIFFNESS_TOLERANCE = 1.5
_SOLD = {
    "counts_per_rev": (16.0, 100_000.0),
    "gear_ratio": (1.0, 1000.0),
    "torque_constant_nm_per_a": (0.001, 1.0),
}
"""Values of commercial motors and encoders: others are not proposed."""
_HINTS = {
    "counts_per_rev": " (after quadrature: four times the lines)",
    "torque_constant_nm_per_a": " (or efficiency, or this is another motor)",
}


class Cause(NamedTuple):
    """A field that may be wrong.

    Attributes:
        section: Section of the bench file.
        field: Name of the field.
        gain: Power of its value in k.
        ratio: Power of its value in r.
    """

    section: str
    field: str
    gain: int
    ratio: int


def list_causes(motor: str) -> tuple[Cause, ...]:
    """The fields that are in k and r of this motor."""
    own = (
        Cause(motor, "counts_per_rev", 1, 1),
        Cause(motor, "gear_ratio", 2, 1),
        Cause(motor, "torque_constant_nm_per_a", 1, 0),
    )
    return (Cause("deflection", "counts_per_rev", 0, -1), *own) if motor == "motor1" else own


def compare_magnitudes(
    bench: BenchFile,
    actuator: MechanismParameters,
    turns: Mapping[str, Turn],
    link: LinkFit | None,
    rest: float,
) -> Iterator[CheckStep]:
    """Compare the measured scales with those of the bench file.

    Args:
        bench: The bench file.
        actuator: Inertias and spring of the bench's design.
        turns: Turns of the motors that have moved.
        link: Fit of the turn of motor 1; None if the deflection was not measured.
        rest: Counts of the deflection at rest.
    """
    inertias = {"motor1": actuator.motor1_inertia_kg_m2, "motor2": actuator.motor2_inertia_kg_m2}
    for name, turn in turns.items():
        if name == "motor2":
            yield _compare(bench, name, turn, inertias[name], None, rest)
        elif link is not None:
            yield _compare(bench, name, turn, inertias[name], link, rest)
            yield _compare_stiffness(bench, actuator, link)


def _compare(
    bench: BenchFile, name: str, turn: Turn, inertia: float, link: LinkFit | None, rest: float
) -> CheckStep:
    title = f"{name}: scale" if link is None else f"{name}, deflection: scale"
    motor: MotorSettings = getattr(bench, name)
    known = (motor.counts_per_rev, motor.gear_ratio, motor.torque_constant_nm_per_a)
    if None in (*known, motor.efficiency) or (link and bench.deflection.counts_per_rev is None):
        advice = "Give the missing values in the bench file, and run the check again."
        return CheckStep(title, Result.WARN, "not compared: a value is not known", advice)
    counts, gear, constant, efficiency = (float(value or 1) for value in (*known, motor.efficiency))
    counts_a_rad = gear * counts / (2.0 * math.pi)
    fit = fit_motor(turn, None if link is None else rest)
    expected = gear * efficiency * constant / inertia
    gain = abs(fit.gain.value) / counts_a_rad
    measured = [
        f"1 A accelerates it by {gain:.3g} rad/s², expected {expected:.3g} rad/s² (tolerance:"
        f" factor {GAIN_TOLERANCE:g})"
    ]
    if not fit.is_sharp:
        share = f"friction takes {100.0 * min(fit.friction, 1.0):.0f} % of the torque"
        measured = [f"its acceleration cannot be measured: {share}"]
    gain_error = math.log(gain / expected) if fit.is_sharp and gain else None
    ratio_error = None
    if link is not None:
        ratio, expected_ratio = (
            abs(link.ratio.value),
            gear * counts / (bench.deflection.counts_per_rev or 1),
        )
        ratio_error = math.log(ratio / expected_ratio)
        measured.append(
            f"{ratio:.3g} counts of motor 1 for each of the deflection, expected"
            f" {expected_ratio:.3g} (tolerance: factor {RATIO_TOLERANCE:g})"
        )
    if _measure(gain_error, ratio_error) > 1.0:
        advice = _name_causes(bench, name, gain_error, ratio_error)
        return CheckStep(title, Result.FAIL, "; ".join(measured), advice)
    if gain_error is None:
        advice = "Compare the values of [{name}] with the data sheets of motor and gearbox."
        return CheckStep(title, Result.WARN, "; ".join(measured), advice.format(name=name))
    return CheckStep(title, Result.OK, "; ".join(measured))


def _measure(gain_error: float | None, ratio_error: float | None) -> float:
    """The greater of two logarithmic errors, each relative to its tolerance; None is unknown."""
    gain = abs(gain_error or 0.0) / math.log(GAIN_TOLERANCE)
    return max(gain, abs(ratio_error or 0.0) / math.log(RATIO_TOLERANCE))


def _name_causes(
    bench: BenchFile, motor: str, gain_error: float | None, ratio_error: float | None
) -> str:
    """Each field that alone explains both errors, with its expected value."""
    causes: list[tuple[float, str]] = []
    for cause in list_causes(motor):
        uses_ratio = ratio_error is not None and cause.ratio != 0
        error, power = (ratio_error, cause.ratio) if uses_ratio else (gain_error, cause.gain)
        if error is None or power == 0:
            continue
        change = error / power
        left = _measure(
            None if gain_error is None else gain_error - cause.gain * change,
            None if ratio_error is None else ratio_error - cause.ratio * change,
        )
        present = getattr(getattr(bench, cause.section), cause.field)
        value = present * math.exp(change)
        least, most = _SOLD[cause.field]
        if left <= 1.0 and (cause.section == "deflection" or least <= value <= most):
            hint = _HINTS.get(cause.field, "")
            change_to = f"{_write(value)}{hint}, not {present:g}"
            causes.append((left, f"{cause.field} in [{cause.section}] to about {change_to}"))
    if not causes:
        return (
            "No single value explains this: compare counts_per_rev, gear_ratio,"
            f" torque_constant_nm_per_a and efficiency of [{motor}] with the data sheets,"
            " and the inertia in the [design] file."
        )
    return f"Set {'; or '.join(text for _, text in sorted(causes))}; then run the check again."


def _write(value: float) -> str:
    """Three digits, without a power of ten."""
    return f"{float(f'{value:.3g}'):g}"


def _compare_stiffness(bench: BenchFile, actuator: MechanismParameters, link: LinkFit) -> CheckStep:
    """σ at rest from σ/M, with that of the lever ratio at the zero mark."""
    title, mu = "home: lever ratio", bench.home.lever_ratio
    plant, M = build_actuator(actuator, mu), actuator.link_inertia_kg_m2
    if not link.stiffness.is_sharp or link.stiffness.value <= 0.0:
        advice = "Free the link, remove its loads, and run the check again."
        return CheckStep(title, Result.WARN, "the link's movement shows no stiffness", advice)
    expected, measured = float(compute_stiffness_of(plant, mu, 0.0)), link.stiffness.value * M
    coordinate = float(compute_coordinate_for_stiffness(plant, measured))
    words = (
        f"{measured:.3g} N·m/rad at rest, lever ratio {coordinate:.3f}; expected"
        f" {expected:.3g} N·m/rad, {mu:.3f} (tolerance: factor {STIFFNESS_TOLERANCE:g})"
    )
    if abs(math.log(measured / expected)) > math.log(STIFFNESS_TOLERANCE):
        advice = (
            f"If the stiffness motor is at its zero mark, set lever_ratio in [home] to about"
            f" {coordinate:.2f}, not {mu:g}; otherwise bring it there. If both are right, correct"
            " link_inertia_kg_m2 or spring_stiffness_n_per_m in the [design] file."
        )
        return CheckStep(title, Result.FAIL, words, advice)
    return CheckStep(title, Result.OK, words)
