"""The law of each lane over time, and the windows between changes."""

import itertools

import pytest

import svsa
from svsa.control.installed import list_law_names
from svsa.runs.definition.command import ApplyLoad, RemoveLoad, Set, build_command
from svsa.runs.timeline import controllers
from svsa.runs.timeline.controllers import name_controllers
from svsa.runs.timeline.timeline import LINE_COLORS, Timeline, Window, read_timeline
from tests.runs.session.scripts import play_busy_session
from tests.runs.session.sessions import build_configuration, build_session

FL, NDOBC = svsa.Lane(law="fl"), svsa.Lane(law="ndobc")
FASTER = svsa.ObserverBandwidth(bandwidth_rad_per_s=(120.0, 120.0, 120.0))
STIFFER = svsa.Gains.from_poles([-80.0] * 4, [-60.0] * 2)


def report(timeline: Timeline) -> list[list[tuple[str, int, int | None]]]:
    """Return name, first tick and end of every lane."""
    lanes = timeline.list_segments()
    names = name_controllers(one.controller for lane in lanes for one in lane)
    return [[(names[one.controller], one.first_tick, one.end_tick) for one in x] for x in lanes]


def test_exchanged_laws_keep_the_names_of_the_past():
    session = build_session(comparisons=(FL,))
    session.step(30)
    session.change(Set("laws", ("fl", "ndobc")))
    session.step(10)
    assert report(session.journal.timeline) == [
        [("NDOBC", 0, 30), ("FL", 30, None)],
        [("FL", 0, 30), ("NDOBC", 30, None)],
    ]
    line_styles = [
        [one.line_style for one in lane] for lane in session.journal.timeline.list_segments()
    ]
    first, other = (list_law_names().index(law) for law in ("ndobc", "fl"))
    assert line_styles == [[first, other], [other, first]]


def test_comparison_starts_at_its_tick_without_a_past():
    session = build_session()
    session.step(20)
    session.change(Set("comparisons", (FL,)))
    session.step(20)
    session.change(Set("comparisons", (NDOBC, FL)))
    assert report(session.journal.timeline) == [
        [("NDOBC", 0, None)],
        [("NDOBC (2)", 40, None)],
        [("FL", 20, None)],
    ]


def test_same_law_with_other_gains_is_distinguished_by_them():
    session = build_session()
    session.step(10)
    session.change(Set("observer", FASTER))
    session.step(10)
    session.change(Set("gains", STIFFER))
    names = [name for name, _, _ in report(session.journal.timeline)[0]]
    assert names == ["NDOBC β 60 ωq 60 ωσ 40", "NDOBC β 120 ωq 60 ωσ 40", "NDOBC β 120 ωq 80 ωσ 60"]
    assert len({one.line_style for one in session.journal.timeline.list_segments()[0]}) == 3


def test_unused_parameter_does_not_distinguish_a_law():
    session = build_session(law="fl")
    session.step(10)
    session.change(Set("observer", FASTER))
    assert report(session.journal.timeline) == [[("FL", 0, None)]]


def test_change_and_reversal_within_a_tick_is_no_segment():
    session = build_session()
    session.step(10)
    session.change(Set("law", "fl"))
    session.change(Set("law", "ndobc"))
    assert report(session.journal.timeline) == [[("NDOBC", 0, None)]]


def test_law_keeps_its_color_with_other_settings_and_regains_its_line_style():
    timeline = Timeline(build_configuration(), kept_ticks=100)
    session = build_session()
    for tick, observer in ((10, FASTER), (200, session.run.configuration.observer)):
        session.step(tick - session.run.tick)
        session.change(Set("observer", observer))
        timeline.take(session.journal.commands[-1])
    assert [one.line_style for one in timeline.list_segments()[0]] == [LINE_COLORS, 0]


def test_parallel_laws_have_unique_colors_and_the_first_two_keep_theirs():
    laws = list_law_names()
    for comparisons in itertools.combinations(laws[1:], 3):
        lanes = tuple(svsa.Lane(law=law) for law in comparisons)
        timeline = Timeline(build_configuration(law=laws[0], comparisons=lanes))
        line_styles = [lane[-1].line_style for lane in timeline.list_segments()]
        assert len({line_style % LINE_COLORS for line_style in line_styles}) == len(line_styles), (
            comparisons
        )
        assert line_styles[0] == 0
        assert line_styles[1] == 1 or comparisons[0] != laws[1]


def test_law_after_a_law_of_the_same_color_gets_an_unused_color():
    laws = list_law_names()
    timeline = Timeline(build_configuration(law=laws[0]))
    timeline.take(build_command(10, "law", laws[LINE_COLORS]))
    first, second = (one.line_style for one in timeline.list_segments()[0])
    assert first % LINE_COLORS != second % LINE_COLORS


def test_bench_and_twin_remain_in_the_names():
    timeline = Timeline(build_configuration(comparisons=(NDOBC, FL)), is_bench=True)
    session = build_session(comparisons=(NDOBC, FL))
    session.step(5)
    session.change(Set("law", "fl"))
    timeline.take(session.journal.commands[-1])
    assert report(timeline) == [
        [("Bench NDOBC", 0, 5), ("Bench FL", 5, None)],
        [("Twin NDOBC", 0, 5), ("Twin FL", 5, None)],
        [("FL", 0, None)],
    ]


CHANGES = [
    ("position", svsa.ConstantPosition(position_rad=0.1), "Motion changed"),
    ("stiffness", svsa.ConstantStiffness(stiffness_nm_per_rad=40.0), "Stiffness changed"),
    ("law", "fl", "NDOBC → FL"),
    ("laws", ("fl",), "NDOBC → FL"),
    ("gains", STIFFER, "Gains changed"),
    ("observer", FASTER, "Observer changed"),
    ("actuator", svsa.load_prototype().actuator, "Plant changed"),
    ("nominal", svsa.load_prototype().nominal, "Nominal model changed"),
    ("effects", svsa.RIG, "Effects changed"),
    ("comparisons", (FL,), "FL added"),
    ("comparisons", (FL, svsa.Lane(law="adrc")), "FL, ADRC added"),
]


@pytest.mark.parametrize(("kind", "argument", "label"), CHANGES)
def test_every_change_starts_a_window_for_all_lanes(kind, argument, label):
    session = build_session()
    session.step(50)
    assert session.journal.timeline.window == Window("start", "", 0)
    session.change(build_command(0, kind, argument))
    session.step(20)
    assert session.journal.timeline.window == Window("change", label, 50)
    durations = [lane.summarize().duration_s for lane in session.journal.metrics.in_window]
    assert durations == pytest.approx([0.02] * len(durations))


def test_recovery_time_is_latched_at_its_load():
    """Changes of effects, motion and law after it do not change the measured 0.2 s."""
    session = build_session(comparisons=(FL,))
    session.step(100)
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.step(1500)
    ndobc, fl = (lane.summarize() for lane in session.journal.metrics.since_load)
    assert 0.1 < ndobc.recovery_time_s < 0.4
    assert fl.recovery_time_s is None
    session.change(Set("effects", svsa.RIG))
    session.change(Set("position", svsa.ConstantPosition(position_rad=0.5)))
    session.step(1500)
    session.change(Set("laws", ("fl", "ndobc")))
    session.step(1500)
    assert [lane.summarize() for lane in session.journal.metrics.since_load] == [ndobc, fl]
    assert session.journal.timeline.load_window == Window("load", "3 kg load", 100, 1600)
    assert session.journal.timeline.window == Window("change", "NDOBC → FL", 3100)


def test_window_after_a_switch_has_no_peak_of_the_previous_law():
    session = build_session(law="fl")
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.step(1500)
    (fl,) = (lane.summarize() for lane in session.journal.metrics.in_window)
    session.change(Set("law", "ndobc"))
    session.step(1000)
    session.change(Set("comparisons", (FL,)))
    session.step(1)
    first, comparison = (lane.summarize() for lane in session.journal.metrics.in_window)
    assert fl.peak_position_error_rad > 0.1
    assert max(first.peak_position_error_rad, comparison.peak_position_error_rad) < 0.01


def test_simultaneous_changes_are_one_window():
    session = build_session()
    session.step(50)
    session.change(Set("effects", svsa.RIG))
    session.change(Set("gains", STIFFER))
    session.change(Set("gains", STIFFER))
    assert session.journal.timeline.windows == [
        Window("start", "", 0, 50),
        Window("change", "Effects changed, Gains changed", 50),
    ]


def test_settings_before_the_first_tick_are_the_start_of_the_run():
    session = build_session()
    session.change(Set("gains", STIFFER))
    session.change(Set("comparisons", (FL,)))
    session.step(10)
    assert session.journal.timeline.windows == [Window("start", "", 0)]
    for lanes in (session.journal.metrics.since_start, session.journal.metrics.in_window):
        assert [lane.summarize().duration_s for lane in lanes] == pytest.approx([0.01, 0.01])


def test_recorded_run_has_the_timeline_of_its_session():
    """One function of configuration and commands; loads start and end at the same ticks."""
    session = play_busy_session()
    again = read_timeline(session.journal.initial, session.journal.commands, (-1, session.run.tick))
    assert again.windows == session.journal.timeline.windows
    assert again.load_window == session.journal.timeline.load_window
    assert again.list_segments() == session.journal.timeline.list_segments()
    assert {window.kind for window in again.windows} == {"start", "load", "unload", "change"}


def test_label_of_a_window_stays_short_with_many_changes_at_one_tick():
    """A paused session accepts thousands of changes at the same tick."""
    session = build_session()
    session.step(10)
    for mass in range(100):
        session.change(ApplyLoad(argument={"kind": "mass", "mass_kg": 0.01 + 0.01 * mass}))
        session.journal.timeline.remove_load(session.run.loads[-1].load, session.run.tick)
        session.change(RemoveLoad(argument=session.run.loads[-1].number))
    label = session.journal.timeline.window.label
    assert label.startswith("0.01 kg mass off, 0.02 kg mass off")
    assert label.endswith(" …")
    assert len(label) <= 202


def test_names_of_many_controllers_are_computed_once(monkeypatch):
    """A dragged slider creates a controller per step: naming them remains fast."""
    session = build_session()
    for step in range(60):
        session.step(10)
        bandwidth = svsa.ObserverBandwidth(bandwidth_rad_per_s=(70.0 + step,) * 3)
        session.change(Set("observer", bandwidth))
    looked_at = []
    describe = controllers._describe
    monkeypatch.setattr(
        controllers, "_describe", lambda one: looked_at.append(one) or describe(one)
    )
    timeline = session.journal.timeline
    for _ in range(3):
        names = timeline.name_segments(timeline.list_segments())
    assert len(looked_at) == len(names) == 61
    assert list(names.values())[:3] == ["NDOBC β 60", "NDOBC β 70", "NDOBC β 71"]
    session.step(10)
    session.change(Set("law", "fl"))
    assert timeline.name_segments(timeline.list_segments())[62] == "FL"
