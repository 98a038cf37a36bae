"""The names of a recorded run's lanes."""

from typing import Any

import pytest

from svsa.runtime.recording.reader import build_record
from svsa_server.lane_names import name_lanes

from ..contract.records import build_header, build_samples

FIRST_TICK = 200
FL, NDOBC = {"law": "fl"}, {"law": "ndobc"}


def find_names(
    lanes: int, rivals: list[Any], commands: list[tuple[int, str, Any]], plant: str = "simulated"
) -> list[str]:
    names = tuple(f"lane{number + 1}" for number in range(lanes))
    configuration = {"law": "ndobc", "rivals": rivals}
    header = build_header(lanes=names, configuration=configuration, plant=plant)
    given = [(tick, {"kind": kind, "argument": argument}) for tick, kind, argument in commands]
    samples = build_samples(10, lanes, FIRST_TICK)
    return name_lanes(build_record(header, given, FIRST_TICK, samples))


@pytest.mark.parametrize(
    ("lanes", "rivals", "commands", "names"),
    [
        (1, [], [], ["NDOBC"]),
        (2, [], [(100, "rivals", [FL])], ["NDOBC", "FL"]),
        (1, [], [(100, "law", "fl")], ["FL"]),
        (2, [FL], [(500, "law", "fl")], ["NDOBC → FL", "FL"]),
        (3, [FL, FL], [], ["NDOBC", "FL (2)", "FL (3)"]),
        (2, [], [], ["lane1", "lane2"]),
        (2, [None], [(0, "rivals", [7])], ["lane1", "lane2"]),
    ],
)
def test_lanes_are_called_by_the_laws_when_the_recording_began(
    lanes: int, rivals: list[Any], commands: list[tuple[int, str, Any]], names: list[str]
) -> None:
    assert find_names(lanes, rivals, commands) == names


def test_a_bench_and_its_twin_are_told_apart() -> None:
    names = find_names(3, [NDOBC, FL], [], plant="emulated")
    assert names == ["Bench NDOBC", "Twin NDOBC", "FL"]
