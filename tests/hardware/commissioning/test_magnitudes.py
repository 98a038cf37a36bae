"""A wrong scale in the bench file is found by its magnitude, and its field is named."""

import re

import pytest

from svsa.hardware.commissioning.coupling import check_coupling
from svsa.hardware.commissioning.magnitudes import compare_magnitudes
from svsa.hardware.commissioning.step import Result
from svsa.hardware.description.file import read_bench
from svsa.hardware.realtime.configuration import read_bench_design
from tests.exhaustive import exhaust
from tests.hardware.commissioning.checked_bench import Watcher, check
from tests.hardware.emulator.bus_in_time import EMULATOR_BENCH, EmulatorBus, copy_bench

BENCH = read_bench(EMULATOR_BENCH)
ONE = "motor1, deflection: scale"
CASES = [
    ("deflection", "counts_per_rev", 2000, ONE),
    ("deflection", "counts_per_rev", 10_500, ONE),
    ("motor1", "gear_ratio", 5.0, ONE),
    ("motor1", "gear_ratio", 500.0, ONE),
    ("motor1", "counts_per_rev", 500, ONE),
    ("motor1", "torque_constant_nm_per_a", 0.0234, ONE),
    ("motor2", "gear_ratio", 5.0, "motor2: scale"),
    ("motor2", "counts_per_rev", 500, "motor2: scale"),
    ("motor2", "torque_constant_nm_per_a", 0.0396, "motor2: scale"),
    ("home", "lever_ratio", 0.27, "home: lever ratio"),
]


def compare(turns, bench=BENCH):
    """Return the steps of the comparison."""
    actuator = read_bench_design(bench).actuator
    step, link = check_coupling(bench, actuator, turns, 0.0)
    assert step.result is Result.OK
    return list(compare_magnitudes(bench, actuator, turns, link, 0.0))


def test_valid_file_agrees_within_a_fifth(turns):
    steps = compare(turns)
    assert [step.name for step in steps] == [ONE, "home: lever ratio", "motor2: scale"]
    for step in steps:
        assert step.result is Result.OK, step
        for found, expected in re.findall(r"([\d.]+) .*?expected ([\d.]+)", step.measured):
            if found != "1":
                assert float(found) == pytest.approx(float(expected), rel=0.2)


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case[0]}.{case[1]}={case[2]}")
def test_wrong_value_is_reported_with_the_correct_value(turns, case):
    section, field, wrong, title = case
    present = getattr(BENCH, section)
    bench = BENCH.changed(**{section: present.changed(**{field: wrong})})
    steps = compare(turns, bench)
    assert [step.name for step in steps if step.result is Result.FAIL] == [title]
    (advice,) = (step.advice for step in steps if step.result is Result.FAIL)
    found = re.search(rf"{field} in \[{section}\] to about ([\d.]+)", advice)
    assert found is not None, advice
    assert float(found[1]) == pytest.approx(getattr(present, field), rel=0.2)
    if title == ONE:
        assert advice.startswith(f"Set {field} in [{section}]")


def test_two_wrong_values_are_not_explained_by_one(turns):
    bench = BENCH.changed(
        motor1=BENCH.motor1.changed(gear_ratio=5.0),
        deflection=BENCH.deflection.changed(counts_per_rev=1000),
    )
    steps = compare(turns, bench)
    assert steps[0].result is Result.FAIL
    assert "No single value explains this" in steps[0].advice


FILES = [
    ("gear_ratio = 50.0", "gear_ratio = 5.0", ONE, "gear_ratio in [motor1] to about 49"),
    ("counts_per_rev = 8000", "counts_per_rev = 2000", ONE, "counts_per_rev in [deflection]"),
    ("big_endian = true", "big_endian = false", "deflection: motion", "big_endian = true"),
    ("gear_ratio = 50.0", "gear_ratio = 500.0", ONE, "gear_ratio in [motor1] to about 49"),
]


@pytest.mark.parametrize("case", exhaust(FILES, FILES[:3:2]), ids=lambda case: case[1])
def test_complete_check_finds_a_wrong_file(tmp_path, case):
    """With pulses whose travel is limited by the wrong values."""
    right, wrong, title, advice = case
    bus = EmulatorBus()
    path = copy_bench(tmp_path, lambda text: text.replace(right, wrong, 1))
    steps = check(path, bus, move=True, watch=Watcher(bus))
    failed = [step for step in steps.values() if step.result is Result.FAIL]
    assert [step.name for step in failed] == [title]
    assert advice in failed[0].advice


@pytest.mark.exhaustive
def test_exchanged_drives_are_found(tmp_path):
    numbers = {"drive_number = 1": "drive_number = 2", "drive_number = 2": "drive_number = 1"}
    path = copy_bench(
        tmp_path, lambda text: re.sub(r"drive_number = [12]", lambda found: numbers[found[0]], text)
    )
    bus = EmulatorBus()
    step = check(path, bus, move=True)["deflection: motion"]
    assert step.result is Result.FAIL
    assert "the drives are exchanged" in step.advice
