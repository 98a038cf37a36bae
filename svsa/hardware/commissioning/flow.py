"""Check that feedback and deflection arrive as the loop needs them, with everything at rest."""

from collections.abc import Iterator

import numpy as np

from svsa.hardware.commissioning.drives import describe_wiring
from svsa.hardware.commissioning.probe import Probe
from svsa.hardware.commissioning.step import CheckStep, Result
from svsa.hardware.commissioning.traffic import Traffic

LISTEN_S = 1.0
MIN_SHARE = 0.98
STILL_COUNTS = 2
REST_CURRENT = 0.03


def check_feedback(probe: Probe, traffic: Traffic) -> Iterator[CheckStep]:
    """Check the regularity of each drive's feedback frames."""
    expected_rate = 1.0 / probe.bench.timing.period_s
    safety, wiring = probe.bench.safety, describe_wiring(probe.bench)
    for name, drive in probe.drives.items():
        title = f"{name}: feedback"
        advices = probe.families[name].advice
        if count := traffic.errors.get(name):
            measured = f"the drive {drive.describe_error()} ({count} times)"
            yield CheckStep(title, Result.FAIL, measured, advices.error)
            continue
        heard = traffic.feedback.get(name, [])
        if len(heard) < 3:
            advice = f"Check that {advices.supply} under load, and: {wiring}."
            yield CheckStep(title, Result.FAIL, f"{len(heard)} frames in {LISTEN_S:g} s", advice)
            continue
        gaps = np.diff([frame.stamp_s for frame in heard])
        rate, jitter, longest = len(heard) / LISTEN_S, np.std(gaps), float(np.max(gaps))
        measured = (
            f"{rate:.0f} frames/s of {expected_rate:.0f}, jitter {1e3 * jitter:.2f} ms, longest gap"
            f" {1e3 * longest:.2f} ms"
        )
        if longest > safety.stale_fault_s:
            advice = f"The loop would end in a fault. Frames are lost: {wiring}."
            yield CheckStep(title, Result.FAIL, measured, advice)
        elif rate < MIN_SHARE * expected_rate or longest > safety.stale_zero_s:
            advice = (
                "The loop would fall to zero torque in the gaps. Remove other traffic from the bus,"
                " use a faster adapter, and run no other program on this machine."
            )
            yield CheckStep(title, Result.WARN, measured, advice)
        else:
            yield CheckStep(title, Result.OK, measured)


def check_deflection(probe: Probe, traffic: Traffic) -> CheckStep:
    """Check whether and how often counts arrive."""
    source = probe.bench.deflection.source
    title = f"deflection encoder ({source})"
    if probe.encoder_failure is not None:
        return CheckStep(title, Result.FAIL, "not readable", probe.encoder_failure)
    if not traffic.deflection:
        advice = {
            "can": "Check the node's power and wiring, and its identifier in the bench file.",
            "serial": "Check the device's power, its baudrate and format, and the port's name.",
        }.get(source, "Check the [deflection] section of the bench file.")
        return CheckStep(title, Result.FAIL, f"no counts in {LISTEN_S:g} s", advice)
    rate = len(traffic.deflection) / LISTEN_S
    measured = f"{rate:.0f} readings/s, {traffic.deflection[-1].counts} counts"
    needed = 1.0 / probe.bench.safety.stale_zero_s
    if rate < needed:
        advice = f"Let the encoder send more often: the loop needs {needed:.0f}/s, better 1000/s."
        return CheckStep(title, Result.FAIL, measured, advice)
    return CheckStep(title, Result.OK, measured)


def check_rest(probe: Probe, traffic: Traffic) -> CheckStep:
    """Check that at zero current nothing moves and no current flows."""
    spreads, currents, strong = {}, {}, []
    for name, motor in probe.motors.items():
        heard = traffic.feedback[name]
        spreads[name] = _compute_spread([feedback.counts for feedback in heard])
        currents[name] = float(np.mean([feedback.current_ma for feedback in heard]))
        nominal = 1e3 * motor.nominal_current_a
        if abs(currents[name]) > REST_CURRENT * nominal:
            strong.append(name)
    spreads["deflection"] = _compute_spread([counts for counts, _ in traffic.deflection])
    measured = ", ".join(
        [f"{name} moves {spread} counts" for name, spread in spreads.items()]
        + [f"{name} draws {current:.0f} mA" for name, current in currents.items()]
    )
    if strong:
        advice = (
            f"The drive of {' and '.join(strong)} makes current although 0 was commanded: have the"
            " maker calibrate its current measurement; do not arm."
        )
        return CheckStep("at rest", Result.FAIL, measured, advice)
    moving = [name for name, spread in spreads.items() if spread > STILL_COUNTS]
    if moving:
        advice = (
            f"{' and '.join(moving)} is not still: hold the mechanism still and run the check"
            " again; counts that change without motion are interference (shield, ground, 5 V of the"
            " encoder)."
        )
        return CheckStep("at rest", Result.WARN, measured, advice)
    return CheckStep("at rest", Result.OK, measured)


def _compute_spread(counts: list[int]) -> int:
    return max(counts) - min(counts) if counts else 0
