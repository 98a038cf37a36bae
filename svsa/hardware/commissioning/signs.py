"""Check that motors and encoders turn in the directions of the bench file.

Three observations determine every sign: whether the counts of a motor follow its current, whether
the deflection moves opposite to motor 1, and the direction in which the operator saw a motor turn.
"""

from collections.abc import Callable, Iterator, Mapping

from svsa.hardware.commissioning.fit import LinkFit
from svsa.hardware.commissioning.pulse import Turn
from svsa.hardware.commissioning.step import CheckStep, Result
from svsa.hardware.description.file import BenchFile

_WAYS = {
    "motor1": "the way that you count as positive angles of the link",
    "motor2": "the way that makes the actuator stiffer (lever ratio growing)",
}


def prompt_directions(
    turns: Mapping[str, Turn], watch: Callable[[str], bool] | None
) -> dict[str, bool]:
    """Ask the user in which direction each moved motor turned first."""
    if watch is None:
        return {}
    return {name: watch(f"Did {name} turn first {_WAYS[name]}?") for name in turns}


def judge_motor(bench: BenchFile, name: str, turn: Turn, seen: bool | None) -> CheckStep:
    """Judge the sign of a motor; `seen` is whether it turned in positive direction first, None if
    unknown.
    """
    title, sign = f"{name}: sign", getattr(bench, name).sign
    follows = turn.forth.moved * turn.forth.current_ma > 0
    measured = (
        f"{turn.forth.current_ma:+d} mA moved it by {turn.forth.moved:+d} counts,"
        f" {'positive' if seen else 'negative'} direction seen"
    )
    if seen is None:
        measured = measured.rpartition(",")[0] + ", no user was asked for the direction"
    if not follows:
        cause = {
            True: "swap the encoder's A and B",
            False: "swap the two leads of the motor",
            None: "swap the encoder's A and B if it first turned the positive way, else the two"
            " leads of the motor",
        }[seen]
        advice = (
            f"Positive current turns it towards negative counts: {cause}, at the drive. Not the"
            " sign in the bench file: it turns current and counts together."
        )
        return CheckStep(title, Result.FAIL, measured, advice)
    if seen is False:
        advice = f"Set sign = {-(sign or 1)} in [{name}] of the bench file, and check it again."
        return CheckStep(title, Result.FAIL, measured, advice)
    if sign is None:
        advice = f"Give [{name}] sign in the bench file: 1 if it first turned the positive way."
        return CheckStep(title, Result.WARN, measured, advice)
    if seen is None:
        advice = "Run the check again with a user at the bench who sees which way it turns."
        return CheckStep(title, Result.WARN, measured, advice)
    return CheckStep(title, Result.OK, measured)


def judge_deflection(bench: BenchFile, turn: Turn, link: LinkFit, seen: bool | None) -> CheckStep:
    """Judge the sign of the deflection φ = q − θ1; `seen` as in `judge_motor`, for motor 1."""
    title, sign = "deflection: sign", bench.deflection.sign
    motor_sign = bench.motor1.sign or 1
    ratio = link.ratio.value
    fits = ratio * motor_sign * (sign or 1) > 0.0
    measured = (
        f"while motor 1 moves by 100 counts against a link at rest, the deflection moves by"
        f" {-100.0 / ratio:+.1f}"
    )
    follows = turn.forth.moved * turn.forth.current_ma > 0
    # Counts of motor 1 confirm its direction only if their own sign is right.
    is_right = fits == follows if seen is not False else fits != follows
    if not is_right:
        change = (
            f"set sign = {-(sign or 1)} in [deflection] of the bench file, or swap the encoder's A"
            " and B"
        )
        advice = f"The deflection φ = q − θ1 must go the other way than the motor: {change}."
        if seen is None:
            advice = (
                "[motor1] sign and [deflection] sign do not fit each other. If motor 1 first"
                f" turned the positive way, {change}; otherwise set sign = {-motor_sign} in"
                " [motor1]."
            )
        return CheckStep(title, Result.FAIL, measured, advice)
    if sign is None:
        advice = "Give [deflection] sign in the bench file: 1 fits what was measured."
        return CheckStep(title, Result.WARN, measured, advice)
    return CheckStep(title, Result.OK, measured)


def judge_signs(
    bench: BenchFile, turns: Mapping[str, Turn], link: LinkFit | None, seen: Mapping[str, bool]
) -> Iterator[CheckStep]:
    """Judge the signs of all moved motors; `link` is None if the deflection was not measured."""
    for name, turn in turns.items():
        yield judge_motor(bench, name, turn, seen.get(name))
        if name == "motor1" and link is not None:
            yield judge_deflection(bench, turn, link, seen.get(name))
