"""The lanes of a recorded run: their names, and their laws over time."""

from typing import Any

import pytest

from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.runs.definition.command import ApplyLoad, Set, build_command
from svsa.runs.definition.design import Lane
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.measured_window import trace_record
from svsa.runs.records.reader import Record, build_record
from svsa.runs.session.simulated import SimulatedSession
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa_server.runs.lanes import list_record_segments, name_lanes
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.state import build_state
from tests.runs.records.records import build_header, build_samples

FIRST_TICK = 200
FL, NDOBC = {"law": "fl"}, {"law": "ndobc"}
FASTER = {"bandwidth_rad_per_s": (120.0, 120.0, 120.0)}


def record_lanes(
    lanes: int,
    comparisons: list[Any],
    commands: list[tuple[int, str, Any]],
    plant: str = "simulated",
) -> Record:
    names = tuple(f"lane{number + 1}" for number in range(lanes))
    configuration = get_figure("4a").build_configuration().model_dump(mode="json")
    configuration["comparisons"] = comparisons
    header = build_header(lanes=names, configuration=configuration, plant=plant)
    given = [(tick, {"tick": tick, "kind": k, "argument": a}) for tick, k, a in commands]
    return build_record(header, given, FIRST_TICK, build_samples(10, lanes, FIRST_TICK))


def list_segments(record: Record) -> list[list[tuple[str, int, int, int | None]]]:
    segments = list_record_segments(record, trace_record(record))
    return [[(s.name, s.line_style, s.start_tick, s.end_tick) for s in lane] for lane in segments]


@pytest.mark.parametrize(
    ("lanes", "comparisons", "commands", "names"),
    [
        (1, [], [], ["NDOBC"]),
        (2, [], [(100, "comparisons", [FL])], ["NDOBC", "FL"]),
        (1, [], [(100, "law", "fl")], ["FL"]),
        (2, [FL], [(205, "law", "fl")], ["NDOBC → FL (2)", "FL"]),
        (2, [FL], [(205, "laws", ["fl", "ndobc"])], ["NDOBC → FL", "FL → NDOBC"]),
        (1, [], [(205, "observer", FASTER)], ["NDOBC β 60 → NDOBC β 120"]),
        (3, [FL, FL], [], ["NDOBC", "FL", "FL (2)"]),
        (2, [], [], ["lane1", "lane2"]),
        (2, [None], [(0, "comparisons", [7])], ["lane1", "lane2"]),
    ],
)
def test_lanes_are_named_by_their_laws_during_the_recording(
    lanes: int, comparisons: list[Any], commands: list[tuple[int, str, Any]], names: list[str]
) -> None:
    record = record_lanes(lanes, comparisons, commands)
    assert name_lanes(list_record_segments(record, trace_record(record))) == names


def test_bench_and_its_twin_are_distinguished() -> None:
    record = record_lanes(3, [NDOBC, FL], [(205, "law", "fl")], plant="emulated")
    assert list_segments(record) == [
        [("Bench NDOBC", 0, 0, 205), ("Bench FL", 6, 205, None)],
        [("Twin NDOBC", 5, 0, 205), ("Twin FL", 11, 205, None)],
        [("FL", 1, 0, None)],
    ]


def test_laws_before_the_recording_take_no_color_from_recorded_ones() -> None:
    record = record_lanes(1, [], [(100, "observer", FASTER), (150, "law", "fl")])
    assert list_segments(record) == [[("FL", 1, 150, None)]]
    again = record_lanes(1, [], [(100, "observer", FASTER), (205, "law", "fl")])
    assert list_segments(again) == [[("NDOBC", 0, 100, 205), ("FL", 1, 205, None)]]


def test_segment_over_several_windows_states_it() -> None:
    timeline = trace_record(record_lanes(1, [], [(205, "law", "fl")]))
    assert timeline is not None
    segments = ((200, 210), (205, 210), (200, 205))
    reported = [[one.label for one in timeline.list_windows(*ticks)] for ticks in segments]
    assert reported == [["", "NDOBC → FL"], ["NDOBC → FL"], [""]]


def test_record_with_inconsistent_commands_keeps_the_names_of_its_lanes() -> None:
    assert build_command(0, "unload", 7).kind == "unload"
    assert trace_record(record_lanes(1, [], [(205, "unload", 7)])) is None


def test_recovery_time_belongs_to_the_law_that_recovered() -> None:
    """NDOBC recovered, FL did not; exchanging them afterwards changes neither."""
    fl_comparison = (Lane(law="fl"),)
    figure = get_figure("4a").build_configuration(load=False).changed(comparisons=fl_comparison)
    session = SimulatedSession("test", figure)
    session.step(100)
    session.change(ApplyLoad(argument=PaperLoad()))
    session.step(1500)
    before = {lane.name: lane.since_load for lane in build_state(HostedSession(session)).lanes}
    session.change(Set("laws", ("fl", "ndobc")))
    session.step(1500)
    after = build_state(HostedSession(session))
    assert [lane.name for lane in after.lanes] == ["FL", "NDOBC"]
    assert {lane.name: lane.since_load for lane in after.lanes} == before
    assert before["NDOBC"].recovery_time_s < 0.5
    assert before["FL"].recovery_time_s is None
    session.change(Set("observer", ObserverBandwidth(**FASTER)))
    faster = build_state(HostedSession(session)).lanes[1]
    assert (faster.name, faster.since_load) == ("NDOBC β 120", None), "it was not there then"
