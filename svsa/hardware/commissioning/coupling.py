"""Check that the deflection follows motor 1, and that its byte order is right."""

from collections.abc import Mapping

import numpy as np

from svsa.actuators.parameters import MechanismParameters
from svsa.hardware.commissioning.fit import LinkFit, fit_link
from svsa.hardware.commissioning.pulse import MIN_DEFLECTION_COUNTS, Trace, Turn
from svsa.hardware.commissioning.step import CheckStep, Result
from svsa.hardware.description.file import BenchFile
from svsa.hardware.encoders import read_source

_FARTHEST = 0.5
"""Deflection in turns beyond which the counts must have a wrong format."""
_COUNTS = 10_000
"""Counts per turn if the bench file does not give them."""


def check_coupling(
    bench: BenchFile, actuator: MechanismParameters, turns: Mapping[str, Turn], rest: float
) -> tuple[CheckStep, LinkFit | None]:
    """Check that the deflection moves with motor 1, and not with motor 2.

    Args:
        bench: The bench file.
        actuator: Inertias and damping of the bench's design.
        turns: Turns of the motors that have moved, motor 1 among them.
        rest: Counts of the deflection at rest.

    Returns:
        The step, and the result of the deflection; None if the step has failed.
    """
    title = "deflection: motion"
    farthest = {name: _find_farthest(turn, rest) for name, turn in turns.items()}
    measured = ", ".join(f"{name} deflects by {most:.0f} counts" for name, most in farthest.items())
    limit = _FARTHEST * (bench.deflection.counts_per_rev or _COUNTS)
    if max(farthest.values()) > limit:
        measured += f"; a spring allows less than {limit:.0f}"
        return CheckStep(title, Result.FAIL, measured, _advise_on_format(bench, turns, limit)), None
    damping = actuator.link_damping_nms_per_rad / actuator.link_inertia_kg_m2
    link = fit_link(turns["motor1"], rest, damping)
    if farthest["motor1"] >= MIN_DEFLECTION_COUNTS and link.ratio.is_sharp:
        return CheckStep(title, Result.OK, measured), link
    if farthest.get("motor2", 0.0) >= MIN_DEFLECTION_COUNTS:
        field = bench.motor1.address_field
        advice = (
            "The deflection follows motor 2, not motor 1: the drives are exchanged. Exchange"
            f" {field} = {getattr(bench.motor1, field)} in [motor1] and {field} ="
            f" {getattr(bench.motor2, field)} in [motor2] of the bench file."
        )
        return CheckStep(title, Result.FAIL, measured, advice), None
    advice = (
        "The principal motor turned and the deflection did not follow: check that the encoder is"
        " coupled to the shaft, its 5 V, A and B, and that the spring's pivot is not at rigid. If"
        " the stiffness motor turned instead, the drives are exchanged: exchange"
        f" {bench.motor1.address_field} in [motor1] and [motor2]. An encoder with few lines cannot"
        " be tested so: turn the link by hand."
    )
    return CheckStep(title, Result.FAIL, measured, advice), None


def _find_farthest(turn: Turn, rest: float) -> float:
    both = [*turn.forth.trace.deflected, *turn.back.trace.deflected]
    return max((abs(counts - rest) for counts in both), default=0.0)


def _advise_on_format(bench: BenchFile, turns: Mapping[str, Turn], limit: float) -> str:
    source, options = bench.deflection, bench.deflection.options
    width = read_source(source).bits // 8
    is_big = options.get("big_endian", True)
    traces = [trace for turn in turns.values() for trace in (turn.forth.trace, turn.back.trace)]
    if source.source == "can" and all(_swap(trace, width, is_big) < limit for trace in traces):
        return (
            "Read in the other byte order, the counts move as a spring allows: set big_endian ="
            f" {str(not is_big).lower()} in the options of [deflection]."
        )
    return (
        "Compare offset, width and signed in the options of [deflection] with what the encoder"
        " sends, and look for interference on its lines."
    )


def _swap(trace: Trace, width: int, is_big: bool) -> float:
    """Return the range of the counts in the other byte order."""
    first, second = ("big", "little") if is_big else ("little", "big")
    raw = [
        int.from_bytes((int(counts) % 256**width).to_bytes(width, first), second, signed=True)
        for counts in trace.deflected
    ]
    return float(np.ptp(raw)) if raw else 0.0
