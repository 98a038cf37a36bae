"""The bench check finds errors and reports what to do."""

import itertools

import pytest

from svsa.hardware.bench.homing import STEPS, Homing
from svsa.hardware.commissioning import SIGN_STEPS, check_bench
from svsa.hardware.commissioning.step import Result
from svsa.hardware.commissioning.zero import calibrate
from svsa.hardware.description.calibration import find_calibration
from svsa.hardware.description.file import read_bench
from svsa.hardware.emulator.emulator import Emulator
from svsa.hardware.emulator.faults import (
    BusErrors,
    CurrentOffset,
    DropFrames,
    FrozenEncoder,
    ReversedEncoder,
    ReversedMotor,
    Silence,
    Stall,
)
from svsa.hardware.emulator.parameters import EmulatedDeflection, EmulatorParameters
from svsa.simulation.plant.loads.constant import ConstantLoad
from tests.exhaustive import exhaust
from tests.hardware.commissioning.checked_bench import Watcher, check, find_current, list_currents
from tests.hardware.emulator.bus_in_time import EmulatorBus, copy_bench

MOVING_S = 1.6


def test_valid_bench_passes_every_step_without_moving(path, bus):
    steps = check(path, bus)
    assert {step.result for step in steps.values()} == {Result.OK}
    assert "EMULATED" in steps["bus"].measured
    assert all(current == 0 for _, _, current in list_currents(bus))
    assert bus.emulator.mechanics.read(bus.emulator.now_us).theta1 == 0.0


def test_valid_bench_that_moves_has_its_signs_confirmed(path, bus):
    path.with_name("bench.calibration.toml").unlink()
    bench, homing = read_bench(path), Homing()
    for step in STEPS:
        homing.confirm(step.name, "Ada")
    calibrate(bench, homing, bus.open, bus.now)
    asked = []
    steps = check(path, bus, move=True, watch=lambda question: asked.append(question) or True)
    assert {step.result for step in steps.values()} == {Result.OK}, steps
    assert set(SIGN_STEPS) <= set(steps)
    assert len(asked) == 2
    calibration = find_calibration(bench)
    assert calibration is not None and calibration.signs_confirmed


@pytest.fixture(scope="module")
def moved(tmp_path_factory):
    """The steps of a check that moves a valid bench without a watching user, and its bus."""
    bus = EmulatorBus()
    return check(copy_bench(tmp_path_factory.mktemp("bench")), bus, move=True), bus


def test_pulses_stay_small_and_respect_the_command_gap_of_the_drives(moved):
    """At most 15 % of nominal, both axes back within a few degrees, 1 ms between commands."""
    bus = moved[1]
    currents = list_currents(bus)
    assert max(abs(mA) for _, address, mA in currents if address.number == 1) <= 1350
    assert max(abs(mA) for _, address, mA in currents if address.number == 2) <= 174
    x = bus.emulator.mechanics.read(bus.emulator.now_us)
    assert max(abs(x.theta1), abs(x.theta2)) < 0.1
    for number in (1, 2):
        times = [time for time, address, _ in currents if address.number == number]
        assert min(b - a for a, b in itertools.pairwise(times)) >= 0.00099


def test_signs_are_not_confirmed_without_a_watching_user(moved):
    steps = moved[0]
    assert steps["motor1: sign"].result is Result.WARN
    assert steps["motor2: sign"].result is Result.WARN


@pytest.mark.exhaustive
def test_observed_wrong_direction_revokes_the_confirmation(path, bus):
    steps = check(path, bus, move=True, watch=lambda question: "motor2" not in question)
    assert "sign = -1 in [motor2]" in steps["motor2: sign"].advice
    calibration = find_calibration(read_bench(path))
    assert calibration is not None and not calibration.signs_confirmed
    assert steps["calibration"].result is Result.WARN


def test_latency_is_that_of_bus_lag_and_feedback_period(moved):
    """Frame 0.13 ms, lag 0.5 ms · ln 2, half a ms of waiting for B, frame 0.13 ms."""
    steps = moved[0]
    median = float(steps["motor1: latency"].measured.split("after ")[1].split(" ms")[0])
    assert median == pytest.approx(0.13 + 0.35 + 0.5 + 0.13, abs=0.5)


@pytest.mark.exhaustive
def test_pulse_during_a_scheduling_delay_is_repeated(path, bus):
    """A delay of 30 ms exceeds the pulse of 27 ms: it is over before it is measured."""
    slept = []

    def sleep_once(message):
        if find_current(message, "motor2") == 128 and not slept:
            slept.append(bus.now())
            bus.sleep(0.03)

    bus.before_send = sleep_once
    steps = check(path, bus, move=True)
    assert len(slept) == 1
    assert steps["motor2: motion"].result is Result.OK


@pytest.mark.exhaustive
def test_repeated_scheduling_delays_are_reported_as_a_problem_of_the_computer(path, bus):
    def sleep(message):
        if find_current(message, "motor2"):
            bus.sleep(0.16)

    bus.before_send = sleep
    step = check(path, bus, move=True)["motor2: motion"]
    assert step.result is Result.FAIL
    assert "run no other program on this machine" in step.advice
    assert sum(address.number == 2 and mA != 0 for _, address, mA in list_currents(bus)) == 12


FAULTS = [
    (Silence(node="motor2"), 0.0, "motor2: drive group 0 number 2", "7 V to 33 V"),
    (Stall(node="motor1"), MOVING_S, "motor1: feedback", "turns freely"),
    (BusErrors(count=100), 0.0, "bus", "120 Ω"),
    (DropFrames(node="motor1", probability=0.95), 0.0, "motor1: feedback", "Frames are lost"),
    (DropFrames(node="deflection"), 0.0, "deflection encoder (can)", "identifier"),
    (CurrentOffset(node="motor2", offset_a=0.2), 0.0, "at rest", "do not arm"),
    (ReversedEncoder(node="motor1"), 0.0, "motor1: sign", "swap the encoder's A and B"),
    (FrozenEncoder(node="motor2"), 0.0, "motor2: motion", "its encoder is not read"),
    (ReversedEncoder(node="deflection"), 0.0, "deflection: sign", "sign = -1 in [deflection]"),
]
REPEATED = [
    (DropFrames(node="motor2"), 0.0, "mode sequence", "not taken the mode"),
    (ReversedMotor(node="motor2"), 0.0, "motor2: sign", "leads of the motor"),
    (FrozenEncoder(node="deflection"), 0.0, "deflection: motion", "coupled"),
]


@pytest.mark.parametrize("case", exhaust(FAULTS + REPEATED, FAULTS), ids=lambda case: case[2])
def test_fault_is_found_with_instructions(path, bus, case):
    fault, at_s, step, advice = case
    bus.emulator.schedule(round(at_s * 1e6), lambda: bus.emulator.inject(fault))
    steps = check(path, bus, move=True, watch=Watcher(bus))
    assert steps[step].result is Result.FAIL
    assert advice in steps[step].advice
    assert [name for name, each in steps.items() if each.result is Result.FAIL] == [step]


def test_no_motor_moves_if_an_encoder_is_silent(path, bus):
    bus.emulator.inject(DropFrames(node="deflection"))
    check(path, bus, move=True)
    assert all(current == 0 for _, _, current in list_currents(bus))


def test_dead_motor_encoder_does_not_cause_a_runaway(path, bus):
    """The worst case of unmeasured pulses: the shaft stays within about a turn."""
    bus.emulator.inject(FrozenEncoder(node="motor1"))
    steps = check(path, bus, move=True)
    assert steps["motor1: motion"].result is Result.FAIL
    assert abs(bus.emulator.mechanics.read(bus.emulator.now_us).theta1) < 0.5


@pytest.mark.exhaustive
def test_motor_moved_by_a_load_is_not_taken_for_a_sign(path, bus):
    bus.emulator.schedule(
        round(MOVING_S * 1e6),
        lambda: bus.emulator.add_load(ConstantLoad(torque_nm=(0.0, 2.0, 0.0))),
    )
    steps = check(path, bus, move=True, watch=lambda _: True)
    assert steps["motor1: motion"].result is Result.FAIL
    assert "something else moves it" in steps["motor1: motion"].advice


def test_drive_at_another_address_is_found(tmp_path, bus):
    path = copy_bench(tmp_path, lambda text: text.replace("drive_number = 2", "drive_number = 3"))
    steps = check(path, bus)
    assert "A drive answers at group 0 number 2" in steps["motor2: drive group 0 number 3"].advice


def test_missing_drive_next_to_a_present_one(path, bus):
    bus.emulator.inject(Silence(node="motor1"))
    assert "factory address" in check(path, bus)["motor1: drive group 0 number 1"].advice


@pytest.mark.exhaustive
def test_wrong_deflection_sign_of_the_bench_is_found(tmp_path):
    emulator = Emulator(EmulatorParameters(deflection=EmulatedDeflection(sign=-1, phase_s=0.0008)))
    steps = check(copy_bench(tmp_path), EmulatorBus(emulator), move=True)
    assert steps["deflection: sign"].result is Result.FAIL


def test_uncalibrated_bench_can_be_checked(tmp_path, bus):
    path = copy_bench(
        tmp_path,
        lambda text: text.replace("sign = 1\n", "").replace("efficiency = 0.9\n", ""),
    )
    steps = check(path, bus, move=True)
    assert steps["file"].result is Result.WARN
    assert "motor1.efficiency is not given" in steps["file"].measured
    assert steps["motor1: sign"].result is Result.WARN
    assert steps["calibration"].result is Result.WARN


@pytest.mark.parametrize("text", ["", "name = ", "name = 'x'\n[bus]\ninterface = 3\n"])
def test_invalid_file_is_one_step_with_the_reason(tmp_path, bus, text):
    path = tmp_path / "bench.toml"
    path.write_text(text, "utf-8")
    (step,) = check_bench(path, opener=bus.open, now=bus.now)
    assert (step.name, step.result) == ("file", Result.FAIL)


def test_missing_file_and_invalid_encoder_option_are_reported(tmp_path, bus):
    (step,) = check_bench(tmp_path / "none.toml", opener=bus.open, now=bus.now)
    assert "none.toml" in step.measured
    path = copy_bench(tmp_path, lambda text: text.replace("width = 32", "width = 12"))
    (step,) = check_bench(path, opener=bus.open, now=bus.now)
    assert "width is 12" in step.measured
