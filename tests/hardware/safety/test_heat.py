"""The heat of a winding: the torque it permits, and how long it is a reason of a fault."""

import math

import pytest

from svsa.actuators.signals import Torque
from svsa.hardware.bench.settings import AXIS_WORDS
from svsa.hardware.description.file import read_bench
from svsa.hardware.realtime.configuration import build_guard
from svsa.hardware.safety.guard import Guard
from svsa.hardware.safety.heat import LINGERS_S, WARM, Winding, compute_lasting_torque
from tests.hardware.wired_bench import AT_REST, EMULATOR_BENCH, UNDISTURBED

BENCH = read_bench(EMULATOR_BENCH)
PERIOD_S, CALM = BENCH.timing.period_s, (0.0, 0.0)
LASTING_NM = 1.16 * 50.0 * 0.9 * 0.0234
TORQUE_NM = 2.0
AT_ITS_END = AT_REST._replace(theta2=1.4)


def press(guard: Guard, torque2: float, ticks: int) -> None:
    """Run this many ticks with this commanded torque of motor 2."""
    for _ in range(ticks):
        guard.note(guard.limit(Torque(0.0, torque2), AT_REST), CALM)


def find_onset(guard: Guard, torque2: float) -> int:
    """Return the first tick in which heat reduces this torque."""
    for tick in range(20_000):
        if guard.motor2.heat_reduction is not None:
            return tick
        press(guard, torque2, 1)
    raise AssertionError("heat held nothing back")


def test_cold_motor_is_limited_when_its_heat_reaches_the_bound() -> None:
    """h(t) = (τ/τ_n)² (1 − exp(−t/T)) reaches 1 − 0.1 (τ − τ_n)/(τ_p − τ_n)."""
    winding = Winding(BENCH.motor2, 5.0)
    assert winding.lasting_nm == compute_lasting_torque(BENCH.motor2) == pytest.approx(LASTING_NM)
    peak = 5.0 * winding.scale
    reached = 1.0 - (1.0 - WARM) * (TORQUE_NM - LASTING_NM) / (peak - LASTING_NM)
    seconds = -12.0 * math.log(1.0 - reached * (LASTING_NM / TORQUE_NM) ** 2)
    assert find_onset(build_guard(BENCH), TORQUE_NM) * PERIOD_S == pytest.approx(seconds, abs=0.01)


@pytest.mark.parametrize("torque", [0.0, 1.2, -1.2])
def test_continuous_torque_is_never_limited(torque: float) -> None:
    guard = build_guard(BENCH)
    press(guard, torque, 60_000)
    assert guard.motor2.heat_reduction is None
    assert guard.motor2.winding.allow() > abs(torque)


@pytest.mark.parametrize("asked", [5.0, 40.0])
def test_cold_motor_at_full_torque_is_limited_by_heat_alone(asked: float) -> None:
    guard = build_guard(BENCH)
    press(guard, asked, 100)
    assert guard.motor2.winding.allow() == 5.0
    assert guard.motor2.heat_reduction is None


def test_fault_during_a_heat_limit_reports_the_heat_first() -> None:
    """With name, value, unit and bound in words, and the values for scripts."""
    guard = build_guard(BENCH)
    cold = guard.check(Torque(0.0, 0.0), AT_ITS_END, UNDISTURBED)
    assert cold is not None
    assert cold.message.startswith("End of stiffness range")
    press(guard, TORQUE_NM, find_onset(build_guard(BENCH), TORQUE_NM) + 3000)
    warm = guard.check(Torque(0.0, TORQUE_NM), AT_ITS_END, UNDISTURBED)
    assert warm is not None
    assert warm.code == cold.code
    assert warm.message.startswith(
        "The torque of motor 2 was limited by heat: its winding had 100 % of its"
    )
    assert (
        "limited to 1.22 N·m, and 2 N·m were commanded (continuous rating: 1.22 N·m)"
        in warm.message
    )
    assert warm.message.endswith(cold.message)
    heat, asked, held = (
        warm.values[name] for name in ("motor2_heat", "motor2_commanded_nm", "motor2_allowed_nm")
    )
    assert heat == guard.motor2.winding.heat
    assert (asked, LASTING_NM <= held < TORQUE_NM) == (TORQUE_NM, True)
    assert cold.values.items() <= warm.values.items()


def test_heat_is_a_reason_for_half_a_second_and_never_in_the_next_run() -> None:
    guard = build_guard(BENCH)
    press(guard, TORQUE_NM, find_onset(build_guard(BENCH), TORQUE_NM) + 100)
    press(guard, 0.0, round(LINGERS_S / PERIOD_S) - 2)
    assert guard.motor2.heat_reduction is not None
    press(guard, 0.0, 3)
    assert guard.motor2.heat_reduction is None
    alarm = guard.check(Torque(0.0, 0.0), AT_ITS_END, UNDISTURBED)
    assert alarm is not None
    assert AXIS_WORDS["motor2"] not in alarm.message.lower()
    press(guard, 5.0, 10)
    assert guard.motor2.heat_reduction is not None
    guard.begin()
    assert guard.motor2.heat_reduction is None
