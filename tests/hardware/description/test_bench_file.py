"""Errors of a bench file contain the name, the value and what to write."""

import pytest

from svsa.errors import ParameterError
from svsa.hardware.description.file import read_bench
from tests.hardware.emulator.bus_in_time import copy_bench

WRONG = [
    (
        "gear_ratio",
        "gear_ration",
        "motor1.gear_ration: unknown field",
        "did you mean 'gear_ratio'?",
    ),
    ("bitrate", "bit_rate", "bus.bit_rate: unknown field", "did you mean 'bitrate'?"),
    ("[safety]", "[safty]", "safty: unknown field", "did you mean 'safety'?"),
    ("[motor1]", '[motor1]\ndrive = "moteuss"', "moteus, robomodule", "the nearest is moteus"),
    (
        "[motor1]",
        '[motor1]\ndrive = "moteus"',
        "motor1.drive_number is 1: it must be omitted: it belongs to drive = 'robomodule'",
        "known drives: moteus, robomodule",
    ),
    ("efficiency = 0.9", "efficiency = 0,9", "line 19: 0,9 has a decimal comma", "point: 0.9"),
]


@pytest.mark.parametrize("case", WRONG, ids=lambda case: case[1])
def test_invalid_file_gets_fitting_advice(tmp_path, case):
    right, wrong, *expected = case
    path = copy_bench(tmp_path, lambda text: text.replace(right, wrong, 1))
    with pytest.raises(ParameterError) as caught:
        read_bench(path)
    for words in expected:
        assert words in str(caught.value)


def test_missing_file_is_not_reported_as_unreadable(tmp_path):
    path = copy_bench(tmp_path)
    with pytest.raises(ParameterError) as caught:
        read_bench(path.with_name("bensh.toml"))
    assert "there is no file" in str(caught.value)
    assert f"the nearest is {path}" in str(caught.value)
