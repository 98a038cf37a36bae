"""The limits of one tick: the permitted torque, and conditions that end the run."""

import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from svsa.actuators.domain import build_domain
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.signals import Disturbance, State, Torque
from svsa.hardware.bench.real_motors import RealMotors
from svsa.hardware.description.file import read_bench
from svsa.hardware.realtime.configuration import build_guard, read_bench_design
from svsa.hardware.safety.guard import Guard
from tests.hardware.wired_bench import AT_REST, EMULATOR_BENCH, UNDISTURBED

BENCH = read_bench(EMULATOR_BENCH)
CALM = (0.0, 0.0)
NM_PER_A = (50.0 * 0.9 * 0.0396, 50.0 * 0.9 * 0.0234)
FULL = Torque(100.0, -100.0)
NO_TORQUE = Torque(0.0, 0.0)
PEAK = Torque(15.0, -5.0)


def build(**safety: float) -> Guard:
    return build_guard(BENCH.changed(safety=BENCH.safety.changed(**safety)))


def test_torque_stays_within_design_and_peak_current() -> None:
    """Motor 1: 15 N·m of the design. Motor 2: 5 A give 5.265 N·m, the design limit is 5."""
    guard = build()
    assert guard.limit(FULL, AT_REST) == (15.0, -5.0)
    weak = BENCH.changed(motor1=BENCH.motor1.changed(peak_current_a=9.0, nominal_current_a=4.0))
    limited = build_guard(weak).limit(FULL, AT_REST)
    assert limited.u1 == pytest.approx(min(15.0, 9.0 * NM_PER_A[0]))
    one_ampere = BENCH.changed(motor1=BENCH.motor1.changed(peak_current_a=1.0, nominal_current_a=1))
    assert build_guard(one_ampere).limit(FULL, AT_REST).u1 == pytest.approx(NM_PER_A[0])


@given(asked=st.lists(st.tuples(st.floats(-50, 50), st.floats(-50, 50)), min_size=1, max_size=30))
def test_no_torque_changes_faster_than_its_rate(asked: list[tuple[float, float]]) -> None:
    guard, last = build(torque_rate_nm_per_s=300.0), Torque(0.0, 0.0)
    for torque in asked:
        sent = guard.limit(Torque(*torque), AT_REST)
        guard.note(sent, CALM)
        assert abs(sent.u1 - last.u1) <= 0.3 + 1e-9
        assert abs(sent.u2 - last.u2) <= 0.3 + 1e-9
        last = sent


def test_only_the_outward_torque_is_blocked_beyond_an_end() -> None:
    guard, beyond = build(), AT_REST._replace(theta1=2.6, theta2=-3.1)
    assert guard.limit(Torque(1.0, -1.0), beyond) == (0.0, 0.0)
    assert guard.limit(Torque(-1.0, 1.0), beyond) == (-1.0, 1.0)
    other = AT_REST._replace(theta1=-2.6, theta2=3.1)
    assert guard.limit(Torque(-1.0, 1.0), other) == (0.0, 0.0)
    assert guard.limit(Torque(1.0, -1.0), other) == (1.0, -1.0)
    assert guard.check(Torque(0.0, 0.0), AT_REST._replace(theta1=2.6, q=2.4), UNDISTURBED) is None


def test_warm_motor_is_limited_to_its_nominal_current() -> None:
    """I²t: permanent full torque settles at the nominal current, smoothly, without a fault."""
    guard, sent = build(), [Torque(0.0, 0.0)]
    nominal = BENCH.motor2.nominal_current_a * NM_PER_A[1]
    for _ in range(60_000):
        sent.append(guard.limit(FULL, AT_REST))
        guard.note(sent[-1], CALM)
        assert guard.find_overload() is None
    falling = [after.u2 - before.u2 for before, after in itertools.pairwise(sent[1:])]
    assert sent[1].u2 == -5.0, "cold, it has the peak"
    assert sent[-1].u2 == pytest.approx(-nominal, rel=0.01)
    assert max(abs(step) for step in falling) < 0.1, "no switching to and fro"
    assert guard.motor2.winding.heat <= 1.0
    for _ in range(60_000):
        guard.note(Torque(0.0, 0.0), CALM)
    assert guard.limit(FULL, AT_REST).u2 == -5.0, "rested, it has the peak again"


def test_heat_uses_the_current_of_the_drive_if_it_is_larger() -> None:
    guard = build()
    for _ in range(3000):
        guard.note(Torque(0.0, 0.0), (0.0, -3.0))
    alarm = guard.find_overload()
    assert alarm is not None
    assert alarm.code == "overload"
    assert alarm.message.startswith("Motor 2 is too warm: its heat")
    assert alarm.message.endswith("the limit is 1.05.")
    assert alarm.values["motor2_heat_limit"] == 1.05


def test_heat_uses_the_elapsed_time() -> None:
    """A loop that runs every tenth tick warms the motor as fast as one that runs every tick."""
    late, punctual = build(), build()
    for _ in range(300):
        late.pass_ticks(9, math.inf, CALM)
        late.note(PEAK, CALM)
    for _ in range(3000):
        punctual.note(PEAK, CALM)
    assert punctual.motor2.winding.heat > 1.0
    assert late.motor2.winding.heat == pytest.approx(punctual.motor2.winding.heat, rel=0.01)


def test_drive_stopped_by_the_supervisor_cools_down() -> None:
    """After 60 s without a loop the motor is cool, and may have its peak again."""
    guard = build()
    guard.note(PEAK, CALM)
    guard.pass_ticks(60_000, 0.02, CALM)
    assert guard.motor2.winding.heat < 0.02
    assert guard.motor2.last == 0.0


@pytest.mark.parametrize(
    ("known", "code"),
    [
        (AT_REST, None),
        (AT_REST._replace(dtheta1=19.9, dq=19.9), None),
        (AT_REST._replace(dtheta1=-20.1), "overspeed"),
        (AT_REST._replace(dtheta2=30.1), "overspeed"),
        (AT_REST._replace(dq=25.1), "overspeed"),
        (AT_REST._replace(theta1=2.71, q=2.4), "position_limit"),
        (AT_REST._replace(theta1=2.3, q=2.51), "position_limit"),
        (AT_REST._replace(q=0.45), None),
        (AT_REST._replace(q=-0.48), "deflection_limit"),
        (AT_REST._replace(theta2=1.4), "lever_end"),
        (AT_REST._replace(theta2=-3.19), "lever_end"),
        (AT_REST._replace(q=math.nan), "not_finite"),
    ],
)
def test_forbidden_state_ends_the_run(known: State, code: str | None) -> None:
    alarm = build().check(Torque(0.0, 0.0), known, UNDISTURBED)
    assert (alarm and alarm.code) == code
    if alarm is not None and code != "not_finite":
        assert alarm.values
        assert all(math.isfinite(value) for value in alarm.values.values())


def test_deflection_limit_of_a_run_depends_on_the_lever_ratio() -> None:
    """Stiff (larger μ), the stiffness is zero earlier: 0.5 rad is beyond the limit only there."""
    guard, soft = build(), AT_REST._replace(theta2=-1.5, q=0.5)
    stiff = AT_REST._replace(theta2=1.0, q=0.5)
    assert guard.check(Torque(0.0, 0.0), soft, UNDISTURBED) is None
    alarm = guard.check(Torque(0.0, 0.0), stiff, UNDISTURBED)
    assert alarm is not None
    assert alarm.code == "deflection_limit"


def test_nearly_singular_decoupling_matrix_ends_the_run() -> None:
    design = read_bench_design(BENCH)
    limits = design.limits.changed(singularity_fraction=0.6)
    guard = Guard(
        BENCH,
        (15.0, 5.0),
        build_domain(design.nominal, limits),
        build_actuator(design.nominal, BENCH.home.lever_ratio),
        RealMotors(is_pair=False),
    )
    alarm = guard.check(Torque(0.0, 0.0), AT_REST._replace(q=0.45), UNDISTURBED)
    assert alarm is not None
    assert alarm.code == "singular_decoupling"


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_torque_without_a_load_ends_the_run(axis: int, sign: float) -> None:
    below, above = [0.0] * 3, [0.0] * 3
    below[axis], above[axis] = 11.9 * sign, 12.1 * sign
    guard = build()
    assert guard.check(Torque(0.0, 0.0), AT_REST, Disturbance(*below)) is None
    alarm = guard.check(Torque(0.0, 0.0), AT_REST, Disturbance(*above))
    assert alarm is not None
    assert alarm.code == "implausible"
    assert f"torque on {('the link', 'motor 1', 'motor 2')[axis]} that no load" in alarm.message


def test_late_counts_are_not_frozen() -> None:
    guard = build()
    guard.counts = (100, 200, 300)
    assert guard.check(NO_TORQUE, AT_REST, UNDISTURBED) is None
    changed = Disturbance(0.0, 1.1, 0.0)
    guard.counts = (None, 200, 300)
    assert guard.check(NO_TORQUE, AT_REST, changed) is None
    guard.counts = (101, 200, 300)
    assert guard.check(NO_TORQUE, AT_REST, changed) is None
    guard.counts = None
    assert guard.check(NO_TORQUE, AT_REST, UNDISTURBED) is None
    guard.counts = (101, 200, 300)
    assert guard.check(NO_TORQUE, AT_REST, UNDISTURBED) is None
    guard.counts = (None, 200, 300)
    assert guard.check(NO_TORQUE, AT_REST, changed) is None
    guard.counts = (101, 200, 300)
    frozen = guard.check(NO_TORQUE, AT_REST, changed)
    assert frozen is not None
    assert (frozen.code, frozen.values["motor1_change_nm"]) == ("encoder_frozen", 1.1)
