"""What is wrong with a bench file is said with the name, the value and what to write."""

import pytest

from svsa.errors import ParameterError
from svsa.hardware.file import read_bench
from tests.hardware.emulator.bus_in_time import copy_bench

WRONG = [
    (
        "gear_ratio",
        "gear_ration",
        "motor1.gear_ration is 50.0: it must be left out",
        "the nearest is gear_ratio",
    ),
    ("bitrate", "bit_rate", "bus.bit_rate is 1000000", "the nearest is bitrate"),
    ("[safety]", "[safty]", "safty is ", "the nearest is safety"),
    ("[motor1]", '[motor1]\ndrive = "moteuss"', "moteus, robomodule", "the nearest is moteus"),
    (
        "[motor1]",
        '[motor1]\ndrive = "moteus"',
        "motor1.drive_number is 1: it must be left out: it belongs to drive = 'robomodule'",
        "known drives: moteus, robomodule",
    ),
    ("efficiency = 0.9", "efficiency = 0,9", "line 19: 0,9 has a decimal comma", "point: 0.9"),
]


@pytest.mark.parametrize("case", WRONG, ids=lambda case: case[1])
def test_a_wrong_file_gets_advice_that_fits(tmp_path, case):
    right, wrong, *expected = case
    path = copy_bench(tmp_path, lambda text: text.replace(right, wrong, 1))
    with pytest.raises(ParameterError) as caught:
        read_bench(path)
    for words in expected:
        assert words in str(caught.value)


def test_a_file_that_is_missing_is_not_unreadable(tmp_path):
    path = copy_bench(tmp_path)
    with pytest.raises(ParameterError) as caught:
        read_bench(path.with_name("bensh.toml"))
    assert "there is no file" in str(caught.value)
    assert f"the nearest is {path}" in str(caught.value)
