"""Every combination of wrong signs, motor leads and encoder channels gets the right advice."""

import itertools

import pytest

from svsa.hardware.commissioning.fit import fit_link
from svsa.hardware.commissioning.pulse import Turn
from svsa.hardware.commissioning.signs import judge_signs
from svsa.hardware.commissioning.step import Result
from svsa.hardware.description.file import read_bench
from tests.hardware.emulator.bus_in_time import EMULATOR_BENCH

DAMPING = 0.5
WRONG = (False, True)


def reverse_counts(turn):
    """With A and B of the encoder exchanged."""
    return Turn(
        *(
            pulse._replace(moved=-pulse.moved, trace=pulse.trace._replace(moved=-pulse.trace.moved))
            for pulse in turn
        )
    )


def reverse_leads(turn):
    """With the leads of the motor exchanged: a current has the opposite effect."""
    return Turn(
        turn.back._replace(current_ma=turn.forth.current_ma),
        turn.forth._replace(current_ma=turn.back.current_ma),
    )


def judge(turns, sign1, sign2, sign3, watched=True, leads=False, channels=False):
    """The steps of a bench whose signs are right where they are 1.

    sign1, sign2, sign3: signs of motor 1, motor 2 and deflection in the file. leads, channels:
    whether the leads or the encoder channels of motor 1 are swapped.
    """
    bench = read_bench(EMULATOR_BENCH)
    bench = bench.changed(
        motor1=bench.motor1.changed(sign=sign1),
        motor2=bench.motor2.changed(sign=sign2),
        deflection=bench.deflection.changed(sign=sign3),
    )
    one, two = turns["motor1"], turns["motor2"]
    one = Turn(*reversed(one)) if sign1 < 0 else one
    two = Turn(*reversed(two)) if sign2 < 0 else two
    one = reverse_leads(one) if leads else one
    one = reverse_counts(one) if channels else one
    seen = {"motor1": (sign1 < 0) == leads, "motor2": sign2 > 0} if watched else {}
    link = fit_link(one, 0.0, DAMPING)
    steps = judge_signs(bench, {"motor1": one, "motor2": two}, link, seen)
    return {step.name: step for step in steps}


@pytest.mark.parametrize("signs", list(itertools.product((1, -1), repeat=3)), ids=str)
def test_every_combination_of_wrong_signs_is_named(turns, signs):
    steps = judge(turns, *signs)
    fields = ("motor1", "motor2", "deflection")
    for name, sign in zip(fields, signs, strict=True):
        step = steps[f"{name}: sign"]
        assert step.result is (Result.OK if sign > 0 else Result.FAIL), step
        wrong = [field for field in fields if f"sign = 1 in [{field}]" in step.advice]
        assert wrong == ([name] if sign < 0 else []), step


@pytest.mark.parametrize("sign3", [1, -1])
@pytest.mark.parametrize("sign1", [1, -1])
@pytest.mark.parametrize("leads", WRONG)
@pytest.mark.parametrize("channels", WRONG)
def test_leads_and_channels_are_distinguished_by_the_observed_direction(
    turns, channels, leads, sign1, sign3
):
    """Exchanged leads with a wrong sign look like exchanged channels, and vice versa."""
    steps = judge(turns, sign1, 1, sign3, leads=leads, channels=channels)
    advice, turned_wrong = steps["motor1: sign"].advice, (sign1 < 0) != leads
    if channels != leads:
        assert ("leads of the motor" if turned_wrong else "encoder's A and B") in advice
        assert "set sign" not in advice.lower()
    else:
        assert (f"sign = {-sign1} in [motor1]" in advice) is turned_wrong
    assert (steps["deflection: sign"].result is Result.FAIL) is (sign3 < 0)


@pytest.mark.parametrize("signs", [(-1, 1, 1), (1, 1, -1)], ids=str)
def test_both_signs_are_named_without_an_observed_direction(turns, signs):
    steps = judge(turns, *signs, watched=False)
    advice = steps["deflection: sign"].advice
    assert f"sign = {-signs[2]} in [deflection]" in advice
    assert f"sign = {-signs[0]} in [motor1]" in advice
    assert "If motor 1 first turned the positive way" in advice
