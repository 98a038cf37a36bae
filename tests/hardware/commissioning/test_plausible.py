"""An implausible value is a warning with value, limit and next step."""

import pytest

from svsa.hardware.commissioning.plausible import list_implausible
from svsa.hardware.commissioning.step import Result
from svsa.hardware.description.file import read_bench
from svsa.hardware.realtime.configuration import read_bench_design
from tests.hardware.commissioning.checked_bench import check
from tests.hardware.emulator.bus_in_time import EMULATOR_BENCH, copy_bench

BENCH = read_bench(EMULATOR_BENCH)
CASES = [
    ("motor1", {"position_max_rad": 90.0}, "motor1.position_max_rad is 90 rad", "6.283 rad"),
    ("motor2", {"position_min_rad": -90.0}, "motor2.position_min_rad is -90 rad", "-6.283 rad"),
    ("motor1", {"speed_max_rad_per_s": 900.0}, "motor1.speed_max_rad_per_s", "41.89 rad/s"),
    ("motor1", {"nominal_current_a": 1.16, "peak_current_a": 5.0}, "motor1.peak_current_a", "A"),
    ("motor2", {"peak_current_a": 12.0}, "motor2.peak_current_a is 12 A", "9.497 A"),
    ("safety", {"disturbance_max_nm": 1000.0}, "safety.disturbance_max_nm is 1000 N·m", "30 N·m"),
    ("safety", {"link_position_max_rad": 90.0}, "safety.link_position_max_rad", "6.283 rad"),
    ("safety", {"link_speed_max_rad_per_s": 900.0}, "safety.link_speed_max_rad_per_s", "100 rad/s"),
    ("safety", {"standstill_max_nm": 100.0}, "safety.standstill_max_nm is 100 N·m", "15 N·m"),
    ("home", {"lever_ratio": 0.95}, "home.lever_ratio is 0.95", "0.79"),
]


def list_warnings(bench):
    """Return the implausible values of a bench."""
    return list(list_implausible(bench, read_bench_design(bench)))


def test_bench_of_the_emulator_is_plausible():
    assert list_warnings(BENCH) == []


@pytest.mark.parametrize("case", CASES, ids=lambda case: case[2])
def test_implausible_value_is_found(case):
    section, changes, measured, limit = case
    (step,) = list_warnings(BENCH.changed(**{section: getattr(BENCH, section).changed(**changes)}))
    assert step.result is Result.WARN
    assert measured in step.measured and limit in step.measured
    assert step.advice


def test_check_warns_of_a_bench_without_a_design_and_continues(tmp_path, bus):
    path = copy_bench(
        tmp_path,
        lambda text: text.partition("\n[emulator]")[0].replace("rad = 2.5", "rad = 90.0"),
    )
    steps = check(path, bus)
    assert steps["file: design.file"].result is Result.WARN
    assert "[design] file" in steps["file: design.file"].advice
    assert steps["file: safety.link_position_max_rad"].result is Result.WARN
    assert steps["at rest"].result is Result.OK


def test_missing_design_file_ends_the_check(tmp_path, bus):
    path = copy_bench(
        tmp_path, lambda text: text.replace("[design]", '[design]\nfile = "none.toml"')
    )
    step = check(path, bus)["file"]
    assert step.result is Result.FAIL
    assert "none.toml" in step.measured
