"""The bench check: file, bus, drives, encoders, signs and latency, step by step.

Each step reports the measured value and, if it is not right, what to do. Every step has a time
limit, and at the end of the check the drives always have zero current.
"""

import time
from collections.abc import Callable, Generator, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from svsa.actuators.parameters import MechanismParameters
from svsa.errors import ParameterError
from svsa.hardware.bench.real_motors import RealMotors
from svsa.hardware.commissioning.coupling import check_coupling
from svsa.hardware.commissioning.drives import advise_on_bus, bring_up, check_bus, check_drive
from svsa.hardware.commissioning.flow import LISTEN_S, check_deflection, check_feedback, check_rest
from svsa.hardware.commissioning.latency import check_latency
from svsa.hardware.commissioning.magnitudes import compare_magnitudes
from svsa.hardware.commissioning.motion import check_motion
from svsa.hardware.commissioning.plausible import list_implausible
from svsa.hardware.commissioning.probe import BusOpener, Clock, Probe
from svsa.hardware.commissioning.pulse import Turn
from svsa.hardware.commissioning.signs import judge_signs, prompt_directions
from svsa.hardware.commissioning.step import CheckStep, Result
from svsa.hardware.description.calibration import find_calibration, list_problems, note_signs
from svsa.hardware.description.file import BenchFile, read_bench
from svsa.hardware.drives.bus import BusError, open_bus
from svsa.hardware.realtime.configuration import read_bench_design

SIGN_STEPS = ("motor1: sign", "deflection: sign", "motor2: sign")

_LOCKSTEP_ADVICE = (
    "An emulator in lockstep advances time only when its loop requests it, and the check waits"
    " for the clock: start the emulator without --lockstep, and set lockstep = false in the bench"
    " file."
)
_PAIR_ADVICE = (
    "A pulse of one of two antagonistic motors turns both coordinates of the model, and the check"
    " judges motors that turn one each. Turn each motor and the link by hand, compare the direction"
    " of their counts, and set signs_confirmed = true in the calibration record."
)


def check_bench(
    path: Path | str,
    move: bool = False,
    watch: Callable[[str], bool] | None = None,
    opener: BusOpener = open_bus,
    now: Clock = time.monotonic,
) -> Generator[CheckStep, None, None]:
    """Yield the steps of the check, each when it is finished.

    Close the iterator (or exhaust it) to leave the bench.

    Args:
        path: The bench file.
        move: Whether to turn both motors a little, by short pulses of at most 15 % of their nominal
            current, and compare signs and magnitudes of currents, motors and deflection.
        watch: Called afterwards for the directions that the operator saw; without it the signs stay
            unconfirmed.
        opener: Opens the bus.
        now: Clock, s.
    """
    try:
        bench = read_bench(path)
        design = read_bench_design(bench)
        probe = Probe(bench, opener, now)
    except ParameterError as error:
        advice = "Correct the bench file."
        if not Path(path).exists():
            advice = "Give the path of a bench file; README, *First power-up*, has a model."
        yield CheckStep("file", Result.FAIL, str(error), advice)
        return
    yield _describe_file(bench)
    yield from list_implausible(bench, design)
    if bench.emulator is not None and bench.emulator.lockstep:
        yield CheckStep(
            "bus", Result.FAIL, "not tried: the emulator is in lockstep", _LOCKSTEP_ADVICE
        )
        return
    if move and RealMotors.of(design.actuator).is_pair:
        yield CheckStep("signs", Result.WARN, "not tried: two antagonistic motors", _PAIR_ADVICE)
        move = False
    moved, judged = Moved(), list[CheckStep]()
    try:
        yield from _check_on_bus(probe, moved if move else None)
    except BusError as error:
        advice = error.advice or advise_on_bus(bench)
        yield CheckStep("bus", Result.FAIL, error.finding, advice)
    finally:
        probe.close()
    if "motor1" in moved.turns:
        for step in _judge(bench, design.actuator, moved, watch):
            judged.append(step)
            yield step
    yield _check_calibration(bench, _conclude(judged))


@dataclass
class Moved:
    """Results of the pulses: a turn of each motor that moved, and deflection counts at rest."""

    turns: dict[str, Turn] = field(default_factory=dict)
    rest: float = 0.0


def _judge(
    bench: BenchFile,
    actuator: MechanismParameters,
    moved: Moved,
    watch: Callable[[str], bool] | None,
) -> Iterator[CheckStep]:
    """Check signs and magnitudes with the pulses, and with what the user has observed."""
    step, link = check_coupling(bench, actuator, moved.turns, moved.rest)
    yield step
    yield from judge_signs(bench, moved.turns, link, prompt_directions(moved.turns, watch))
    if link is not None:
        yield from compare_magnitudes(bench, actuator, moved.turns, link, moved.rest)


def _conclude(judged: list[CheckStep]) -> bool | None:
    """Whether every sign and scale is right; None if that is unknown."""
    if any(step.result is Result.FAIL for step in judged):
        return False
    results = {step.name: step.result for step in judged}
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


def _check_on_bus(probe: Probe, moved: Moved | None) -> Iterator[CheckStep]:
    """Check from the first frame received to the last pulse.

    `moved` is filled with the motion of the motors; None if they must not move.

    Raises:
        BusError: If the bus is lost.
    """
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
    if moved is None or Result.FAIL in (deflection.result, rest.result):
        return
    moved.rest = traffic.deflection[-1].counts
    for name in probe.motors:
        step, turn = check_motion(probe, name)
        yield step
        if turn is None:
            return
        moved.turns[name] = turn
    for name in probe.motors:
        yield check_latency(probe, name)


def _check_calibration(bench: BenchFile, signs: bool | None) -> CheckStep:
    """List what is missing before this bench can be armed; stores the result of the sign check."""
    try:
        if signs is not None:
            note_signs(bench, signs)
        calibration = find_calibration(bench)
    except (ParameterError, OSError) as error:
        return CheckStep(
            "calibration", Result.FAIL, str(error), "Run `svsa bench-home` to write it again."
        )
    problems = list_problems(bench, calibration)
    if problems:
        return CheckStep(
            "calibration", Result.WARN, "this bench does not arm yet", "; ".join(problems) + "."
        )
    measured = f"of {calibration.date[:10]} by {calibration.by}" if calibration else ""
    return CheckStep("calibration", Result.OK, measured)
