"""The bench file of an emulator: `bench.toml` of this folder, changed to fit another actuator."""

import math
from pathlib import Path
from typing import Any

import tomli_w

from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import compute_coordinate_slope
from svsa.actuators.installed import find_mechanism
from svsa.actuators.parameters import SVSA, Limits
from svsa.hardware.bench.real_motors import RealMotors
from svsa.hardware.description.calibration import (
    Calibration,
    compute_fingerprint,
    write_calibration,
)
from svsa.hardware.description.file import BenchFile, read_bench
from svsa.hardware.emulator.parameters import EmulatedMotor, EmulatorParameters
from svsa.hardware.safety.guard import POSITION_MARGIN_RAD
from svsa.inputs.toml_file import read_toml

EMULATOR_BENCH = Path(__file__).parent / "bench.toml"
PEAK_SHARE, NOMINAL_SHARE = 1.25, 0.75
"""Peak current over that of the torque limit; continuous over peak current."""
CORNER_OVER_POLE = 5.0
"""Bandwidth of the state estimator relative to the poles of the position."""
MOTOR_RPM = 19_000.0
SPEED_RAD_PER_S = 30.0
CALIBRATED = {"date": "2026-11-21T00:00:00+00:00", "by": "the emulator"}


def write_bench(
    path: Path, parameters: EmulatorParameters, port: int, control_port: int, lockstep: bool
) -> BenchFile:
    """Write the bench file of an emulator, with its calibration record next to it.

    Args:
        path: The file; an older one is replaced.
        parameters: Of the emulator; its actuator's parameters are the installed prototype's.
        port: Of socketcand.
        control_port: For loads and faults.
        lockstep: Whether the emulator waits for the loop.

    Returns:
        The bench.
    """
    sections = read_toml(EMULATOR_BENCH, "bench file")
    sections["bus"]["options"]["port"] = port
    sections["emulator"] = {"control_port": control_port, "lockstep": lockstep}
    if find_mechanism(parameters.actuator).name != SVSA:
        _suit(sections, parameters)
    path.write_text(tomli_w.dumps(sections), encoding="utf-8")
    bench = read_bench(path)
    calibration = Calibration(
        **CALIBRATED,
        fingerprint=compute_fingerprint(bench),
        deflection_zero_counts=parameters.deflection.offset_counts,
        signs_confirmed=True,
    )
    write_calibration(bench, calibration)
    return bench


def _suit(sections: dict[str, Any], parameters: EmulatorParameters) -> None:
    """Change the sections whose values follow from the actuator."""
    p, mechanism = parameters, find_mechanism(parameters.actuator)
    limits, real = mechanism.limits, RealMotors.of(p.actuator)
    sections["name"] = f"emulator of {mechanism.title}"
    sections["design"] = {
        "actuator": mechanism.name,
        "corner_rad_per_s": CORNER_OVER_POLE * mechanism.poles_rad_per_s[0],
    }
    sections["home"]["lever_ratio"] = p.lever_ratio
    farthest = float(sections["safety"]["link_position_max_rad"])
    slope = compute_coordinate_slope(build_actuator(p.actuator, p.lever_ratio))
    low, high = sorted(
        (end - p.lever_ratio) / slope for end in (p.lever_ratio_min, p.lever_ratio_max)
    )
    ends = ((-farthest, farthest), (low, high))
    if real.is_pair:
        # θa = θ1 + θ2 and θb = θ1 − θ2.
        ends = ((low - farthest, high + farthest), (-high - farthest, -low + farthest))
    for number, (motor, torque) in enumerate(
        ((p.motor1, limits.torque1_nm), (p.motor2, limits.torque2_nm))
    ):
        sections[f"motor{number + 1}"] |= _describe_motor(motor, torque, ends[number])
    _suit_safety(sections["safety"], limits, mechanism.largest_torque_nm)


def _describe_motor(
    motor: EmulatedMotor, torque: float, ends: tuple[float, float]
) -> dict[str, float]:
    """The values of a motor's section. torque: limit, N·m. ends: of its angle, rad."""
    peak = min(PEAK_SHARE * torque / abs(motor.torque_nm_per_a), float(motor.peak_current_a))
    return {
        "counts_per_rev": motor.counts_per_rev,
        "gear_ratio": motor.gear_ratio,
        "torque_constant_nm_per_a": motor.torque_constant_nm_per_a,
        "efficiency": motor.efficiency,
        "sign": motor.sign,
        "peak_current_a": float(f"{peak:.3g}"),
        "nominal_current_a": float(f"{NOMINAL_SHARE * peak:.3g}"),
        "thermal_time_s": 30.0,
        "speed_max_rad_per_s": float(
            f"{min(SPEED_RAD_PER_S, MOTOR_RPM * math.pi / 30.0 / motor.gear_ratio):.3g}"
        ),
        "position_min_rad": float(f"{ends[0] - POSITION_MARGIN_RAD:.3f}"),
        "position_max_rad": float(f"{ends[1] + POSITION_MARGIN_RAD:.3f}"),
    }


def _suit_safety(safety: dict[str, Any], limits: Limits, largest: float) -> None:
    """Limits of torques, in the ratio that those of the SVSA's bench have to its motor 1."""
    safety["disturbance_max_nm"] = float(f"{0.8 * largest:.3g}")
    safety["standstill_max_nm"] = float(f"{max(1.0, limits.torque1_nm / 15.0):.3g}")
