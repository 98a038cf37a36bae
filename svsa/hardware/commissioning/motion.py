"""Check with short pulses of current that the motors move, and that their encoders count."""

from svsa.hardware.commissioning.probe import Probe
from svsa.hardware.commissioning.pulse import MIN_COUNTS, Turn, turn_a_little, turn_farther
from svsa.hardware.commissioning.step import CheckStep, Result
from svsa.hardware.drives.family import Advice


def check_motion(probe: Probe, name: str) -> tuple[CheckStep, Turn | None]:
    """Turn a motor a little forth and back.

    Returns:
        The step, and a turn whose traces are long enough to check signs and magnitudes; None if the
        motor has failed the step.
    """
    turn = turn_a_little(probe, name)
    step = _judge(name, turn, probe.families[name].advice)
    if step.result is Result.FAIL:
        return step, None
    farther = turn_farther(probe, name, turn)
    return _judge(name, farther, probe.families[name].advice), farther


def _judge(name: str, turn: Turn, advices: Advice) -> CheckStep:
    title = f"{name}: motion"
    pulse, back = turn
    measured = (
        f"{pulse.current_ma:+d} mA (measured {pulse.measured_ma:+d}) moved it by"
        f" {pulse.moved:+d} counts, {back.current_ma:+d} mA by {back.moved:+d}"
    )
    if turn.errors:
        return CheckStep(title, Result.FAIL, measured, advices.error)
    if not turn.was_followed:
        unheard_ms, pulse_ms = 1e3 * turn.unheard_s, 1e3 * pulse.duration_s
        measured += f", no feedback for {unheard_ms:.0f} of {pulse_ms:.0f} ms"
        advice = (
            "The pulses could not be followed: run no other program on this machine,"
            " remove other traffic from the bus, and run the check again."
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
                " turn, it is the encoder. If the other motor turned, the drives are exchanged."
            )
        return CheckStep(title, Result.FAIL, measured, advice)
    if pulse.moved * back.moved >= 0:
        advice = (
            "It went the same way for both currents: something else moves it (a hung load, a hand,"
            " a stop). Free the mechanism and run the check again."
        )
        return CheckStep(title, Result.FAIL, measured, advice)
    return CheckStep(title, Result.OK, measured)
