"""The bench check: file, bus, drives, encoders, signs and latency, one step after another.

Each step says what was measured and, where that is not right, what to do about it. Every step
is bounded in time, and however the check ends the drives are left at zero current.
"""

import time
from collections.abc import Callable, Generator, Iterator
from pathlib import Path

from svsa.errors import ParameterError
from svsa.hardware.calibration import find_calibration, list_problems, note_signs
from svsa.hardware.commissioning.drives import advise_on_bus, bring_up, check_bus, check_drive
from svsa.hardware.commissioning.flow import LISTEN_S, check_deflection, check_feedback, check_rest
from svsa.hardware.commissioning.latency import check_latency
from svsa.hardware.commissioning.motion import check_directions, check_motion
from svsa.hardware.commissioning.probe import BusOpener, CheckStep, Clock, Probe, Result
from svsa.hardware.drives.bus import BusError, open_bus
from svsa.hardware.file import BenchFile, read_bench

SIGN_STEPS = (
    *("motor1: sign", "deflection: sign", "motor2: sign"),
    *("motor1: direction", "motor2: direction"),
)

_LOCKSTEP_ADVICE = (
    "An emulator in lockstep lets time go on only when its loop asks for it, and the check waits"
    " for the clock: start the emulator without --lockstep, and set lockstep = false in the bench"
    " file."
)


def check_bench(
    path: Path | str,
    move: bool = False,
    watch: Callable[[str], bool] | None = None,
    opener: BusOpener = open_bus,
    now: Clock = time.monotonic,
) -> Generator[CheckStep, None, None]:
    """The steps of the check, each yielded when it is done.

    move: also turn both motors a little, by short pulses of at most 15 % of their nominal
    current. watch: asked afterwards which way they turned; without it nobody has seen it and
    the signs stay unconfirmed. Close the iterator (or exhaust it) to leave the bench.
    """
    try:
        bench = read_bench(path)
        probe = Probe(bench, opener, now)
    except ParameterError as error:
        yield CheckStep("file", Result.FAIL, str(error), "Correct the bench file.")
        return
    yield _describe_file(bench)
    if bench.emulator is not None and bench.emulator.lockstep:
        yield CheckStep(
            "bus", Result.FAIL, "not tried: the emulator is in lockstep", _LOCKSTEP_ADVICE
        )
        return
    steps: list[CheckStep] = []
    try:
        for step in _check_on_bus(probe, move):
            steps.append(step)
            yield step
    except BusError as error:
        steps.append(CheckStep("bus", Result.FAIL, str(error), advise_on_bus(bench)))
        yield steps[-1]
    finally:
        probe.close()
    if move and all(step.result is not Result.FAIL for step in steps):
        for step in check_directions(bench, watch):
            steps.append(step)
            yield step
    yield _check_calibration(bench, _judge_signs(steps))


def _judge_signs(steps: list[CheckStep]) -> bool | None:
    """Whether every sign is right, or None where that was not found out."""
    results = {step.name: step.result for step in steps if step.name in SIGN_STEPS}
    if Result.FAIL in results.values():
        return False
    seen = all(results.get(name) is Result.OK for name in SIGN_STEPS)
    return True if seen else None


def _describe_file(bench: BenchFile) -> CheckStep:
    missing = bench.find_missing()
    if missing:
        advice = (
            "Take these values from the data sheets of motor, gearbox and encoder; until they"
            " are given the bench can be checked, but does not arm."
        )
        return CheckStep("file", Result.WARN, "; ".join(missing), advice)
    return CheckStep("file", Result.OK, f"{bench.name}: every motor and encoder is described")


def _check_on_bus(probe: Probe, move: bool) -> Iterator[CheckStep]:
    """From the first frame heard to the last pulse; raises `BusError`."""
    probe.open()
    step = check_bus(probe)
    yield step
    if step.result is Result.FAIL:
        return
    silent = False
    for name in probe.motors:
        step = check_drive(probe, name)
        silent = silent or step.result is Result.FAIL
        yield step
    working = not silent
    if working:
        step = bring_up(probe)
        yield step
        working = step.result is not Result.FAIL
    traffic = probe.listen(LISTEN_S)
    if working:
        for step in check_feedback(probe, traffic):
            working = working and step.result is not Result.FAIL
            yield step
    deflection = check_deflection(probe, traffic)
    yield deflection
    if not working:
        return
    rest = check_rest(probe, traffic)
    yield rest
    if move and Result.FAIL not in (deflection.result, rest.result):
        for name in probe.motors:
            for step in check_motion(probe, name):
                working = working and step.result is not Result.FAIL
                yield step
            if not working:
                return
        for name in probe.motors:
            yield check_latency(probe, name)


def _check_calibration(bench: BenchFile, signs: bool | None) -> CheckStep:
    """What is still missing before this bench arms; notes what was found out of the signs."""
    try:
        if signs is not None:
            note_signs(bench, signs)
        calibration = find_calibration(bench)
    except (ParameterError, OSError) as error:
        return CheckStep(
            "calibration", Result.FAIL, str(error), "Run `svsa bench-home` to write it anew."
        )
    problems = list_problems(bench, calibration)
    if problems:
        return CheckStep(
            "calibration", Result.WARN, "this bench does not arm yet", "; ".join(problems) + "."
        )
    measured = f"of {calibration.date[:10]} by {calibration.by}" if calibration else ""
    return CheckStep("calibration", Result.OK, measured)
