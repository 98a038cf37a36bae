"""The metrics of a recorded run belong to one named window, in which each lane has one law."""

import dataclasses
from collections.abc import Sequence
from typing import Any

import pytest

from svsa.runs.definition.design import Lane
from svsa.runs.definition.paper import get_figure
from svsa.runs.metrics.metrics import compute_metrics
from svsa.runs.records.measured_window import MeasuredWindow, find_measured_window, measure
from svsa.runs.records.reader import Record, build_record
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.pulse import PulseLoad

from .records import PERIOD_S, build_header, build_samples

FIRST_TICK = 200
MASS = MassLoad(mass_kg=3.0).model_dump(mode="json")
FL = {"law": "fl"}


def record(
    commands: Sequence[tuple[int, str, Any]], ticks: int = 100, comparisons: tuple[Lane, ...] = ()
) -> Record:
    figure = get_figure("4a").build_configuration(load=False).changed(comparisons=comparisons)
    lanes = tuple(f"lane{number + 1}" for number in range(1 + len(comparisons)))
    header = build_header(lanes=lanes, configuration=figure.model_dump(mode="json"))
    given = [(tick, {"tick": tick, "kind": kind, "argument": a}) for tick, kind, a in commands]
    samples = build_samples(ticks, len(lanes), FIRST_TICK)
    return build_record(header, given, FIRST_TICK, samples)


def find(made: Record) -> MeasuredWindow:
    window = find_measured_window(made)
    assert window is not None
    return window


@pytest.mark.parametrize(
    ("commands", "kind", "label", "ticks", "lanes"),
    [
        ([], "start", "", (200, 300), ("NDOBC",)),
        ([(150, "law", "fl")], "change", "NDOBC → FL", (200, 300), ("FL",)),
        ([(250, "law", "fl")], "change", "NDOBC → FL", (250, 300), ("FL",)),
        ([(220, "load", MASS)], "load", "3 kg mass", (220, 300), ("NDOBC",)),
        (
            [(220, "load", MASS), (250, "law", "fl")],
            *("load", "3 kg mass", (220, 250), ("NDOBC",)),
        ),
        (
            [(210, "law", "fl"), (220, "load", MASS), (250, "unload", 1), (260, "law", "ndobc")],
            *("load", "3 kg mass", (220, 250), ("FL",)),
        ),
        ([(100, "load", MASS), (240, "law", "fl")], "change", "NDOBC → FL", (240, 300), ("FL",)),
        ([(300, "law", "fl")], "start", "", (200, 300), ("NDOBC",)),
        (
            [(220, "load", MASS), (250, "stop", None)],
            *("load", "3 kg mass", (220, 250), ("NDOBC",)),
        ),
    ],
)
def test_window_is_that_of_the_last_load_or_the_last_one_and_is_named(
    commands: Sequence[tuple[int, str, Any]],
    kind: str,
    label: str,
    ticks: tuple[int, int],
    lanes: tuple[str, ...],
) -> None:
    window = find(record(commands))
    assert (window.kind, window.label) == (kind, label)
    assert (window.first_tick, window.end_tick) == ticks
    assert (window.start_s, window.end_s) == pytest.approx([tick * PERIOD_S for tick in ticks])
    assert window.lanes == lanes
    assert window.is_whole == (kind == "start")


def test_ramp_to_zero_torque_is_excluded_if_there_is_another_window() -> None:
    stopped = find(record([(280, "stop", None)]))
    assert (stopped.kind, stopped.first_tick, stopped.end_tick) == ("start", 200, 280)
    assert not stopped.is_whole
    ramp = find(record([(150, "stop", None)]))
    assert (ramp.kind, ramp.label, ramp.first_tick, ramp.end_tick) == ("stop", "Stop", 200, 300)


def test_no_metric_mixes_two_laws() -> None:
    made = record([(250, "laws", ("fl", "ndobc"))], comparisons=(Lane(law="fl"),))
    window = find(made)
    assert window.lanes == ("FL", "NDOBC")
    found = measure(made, window)
    assert found is not None
    for lane, metrics in enumerate(found):
        assert metrics == compute_metrics(made.samples[50:, lane], PERIOD_S)
        assert metrics != compute_metrics(made.samples[:, lane], PERIOD_S)


def test_error_after_a_finished_load_is_not_an_error_under_load() -> None:
    pulse = PulseLoad(torque_nm=(5.0, 0.0, 0.0), duration_s=0.05).model_dump(mode="json")
    ended = record([(300, "load", pulse)], ticks=2000)
    lasting = record([(300, "load", MASS)], ticks=2000)
    (of_pulse,), (of_mass,) = (
        measure(ended, find(ended)) or (),
        measure(lasting, find(lasting)) or (),
    )
    assert find(ended).load_ended
    assert of_pulse.steady_state_position_error_rad is None
    assert of_mass.steady_state_position_error_rad is not None
    unsettled = dataclasses.replace(
        of_mass,
        steady_state_position_error_rad=None,
        steady_state_stiffness_error_nm_per_rad=None,
    )
    assert of_pulse == unsettled


def test_unreadable_changes_have_no_window_and_a_run_without_changes_is_one() -> None:
    header = build_header(configuration={"law": "future"})
    unknown = [(205, {"tick": 205, "kind": "future", "argument": 1})]
    samples = build_samples(10, 2, FIRST_TICK)
    assert find_measured_window(build_record(header, unknown, FIRST_TICK, samples)) is None
    whole = find(build_record(header, [], FIRST_TICK, samples))
    assert (whole.is_whole, whole.lanes) == (True, header.lanes)
    assert find_measured_window(build_record(header, [], FIRST_TICK, samples[:0])) is None
