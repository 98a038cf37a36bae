"""Bench files: rejected values with their reasons, and missing values of an incomplete bench."""

import tomllib
from pathlib import Path
from typing import Any

import pytest
import tomli_w

from svsa.errors import ParameterError
from svsa.hardware.description.file import read_bench
from tests.hardware.wired_bench import EMULATOR_BENCH


def write(folder: Path, **changes: Any) -> Path:
    """Write the emulator's bench file with fields replaced (section__name=value; None: omitted)."""
    sections = tomllib.loads(EMULATOR_BENCH.read_text(encoding="utf-8"))
    for name, value in changes.items():
        section, field = name.split("__")
        if value is None:
            sections[section].pop(field)
        else:
            sections[section][field] = value
    path = folder / "bench.toml"
    path.write_text(tomli_w.dumps(sections), encoding="utf-8")
    return path


def test_file_of_the_rig_is_complete() -> None:
    bench = read_bench(EMULATOR_BENCH)
    assert bench.find_missing() == []
    assert bench.path == str(EMULATOR_BENCH)


def test_motor_specific_values_have_no_default(tmp_path: Path) -> None:
    """Winding, gearbox, efficiency, sign and counts: each omitted one is reported."""
    names = ["counts_per_rev", "gear_ratio", "torque_constant_nm_per_a", "efficiency", "sign"]
    changes = {f"motor1__{name}": None for name in names}
    bench = read_bench(write(tmp_path, **changes, deflection__sign=None))
    missing = " ".join(bench.find_missing())
    assert all(f"motor1.{name}" in missing for name in names)
    assert "deflection.sign" in missing
    assert len(bench.find_missing()) == 6


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("motor1__gear_ratio", 0.0, "motor1.gear_ratio is 0.0: it must be greater than 0"),
        ("motor1__sign", 2, "sign"),
        ("motor1__torque_constant_nm_per_a", float("nan"), "torque_constant_nm_per_a"),
        ("motor1__efficiency", 1.2, "motor1.efficiency is 1.2: it must be at most 1"),
        ("motor2__drive_number", 0, "motor2.drive_number is 0"),
        ("motor2__drive_number", 1, "different from motor1's"),
        (
            "motor2__position_min_rad",
            9.0,
            "motor2.position_min_rad is 9.0 rad: it must be less than position_max_rad = 3 rad",
        ),
        ("motor2__peak_current_a", 1.0, "at least nominal_current_a = 1.16 A"),
        ("deflection__source", "guess", "source"),
        ("timing__period_s", 0.003, "timing.period_s"),
        ("safety__torque_rate_nm_per_s", -1.0, "torque_rate_nm_per_s"),
        ("safety__dead_man", "no", "dead_man"),
        ("motor1__gearratio", 50.0, "motor1.gearratio"),
        ("home__lever_ratio", 1.0, "lever_ratio"),
    ],
)
def test_invalid_value_is_named_with_its_bound(
    tmp_path: Path, name: str, value: Any, words: str
) -> None:
    with pytest.raises(ParameterError) as refused:
        read_bench(write(tmp_path, **{name: value}))
    assert words in str(refused.value)


@pytest.mark.parametrize("text", ["not toml", "name = 'empty'", ""])
def test_other_file_is_an_error_with_reason(tmp_path: Path, text: str) -> None:
    path = tmp_path / "bench.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ParameterError):
        read_bench(path)
    with pytest.raises(ParameterError, match="there is no file"):
        read_bench(tmp_path / "nowhere.toml")
