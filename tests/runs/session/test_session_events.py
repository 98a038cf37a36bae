"""Events of a session: commands, windows, version."""

import numpy as np
import pytest

import svsa
from svsa.runs.definition.command import (
    COMMANDS,
    OF_ARM,
    ApplyLoad,
    RemoveLoad,
    Set,
    Stop,
    build_command,
)
from svsa.runs.session.session import remove_loads
from svsa.runs.timeline import events

from .sessions import PULSE, build_session, list_events, read_samples


def test_finished_window_keeps_the_metrics_of_remaining_lanes():
    """A mark has the values of the table while its event was the newest."""
    session = build_session()
    session.step(10)
    session.change(Set("comparisons", (svsa.Lane(law="fl"), svsa.Lane(law="fl_integral"))))
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.step(30)
    loaded = [metrics.summarize() for metrics in session.journal.metrics.in_window]
    session.change(Set("stiffness", svsa.ConstantStiffness(stiffness_nm_per_rad=20.0)))
    session.change(Set("law", "fl"))
    session.step(5)
    session.change(Set("comparisons", (svsa.Lane(law="fl_integral"),)))
    ended = {one.first_tick: one.lanes for one in session.journal.metrics.ended}
    assert list(ended) == [0, 10]
    assert ended[10] == [loaded[0], loaded[2]]
    assert (ended[0][0].duration_s, ended[0][1]) == (pytest.approx(0.01), None)
    session.change(Set("law", "ndobc"))
    assert [one.first_tick for one in session.journal.metrics.ended] == [0, 10, 40]


def test_every_command_is_logged_with_its_tick():
    session = build_session()
    session.step(5)
    design = svsa.load_prototype()
    session.change(Set("law", "fl"))
    session.change(Set("position", svsa.ConstantPosition(position_rad=0.1)))
    session.change(Set("stiffness", svsa.ConstantStiffness(stiffness_nm_per_rad=40.0)))
    session.change(Set("gains", svsa.Gains.from_poles([-50.0] * 4, [-30.0] * 2)))
    session.change(Set("laws", ("ndobc",)))
    slower = {"fl_integral": {"position_pole_rad_per_s": 50.0}}
    session.change(Set("parameters", slower))
    session.change(Set("observer", svsa.ObserverBandwidth(bandwidth_rad_per_s=(30.0,) * 3)))
    session.change(Set("spring", svsa.SpringEstimation()))
    session.change(Set("actuator", design.actuator))
    session.change(Set("nominal", design.nominal))
    session.change(Set("effects", svsa.RIG))
    session.change(Set("comparisons", (svsa.Lane(law="ndobc"),)))
    session.change(Set("lane", {"lane": 2, "setting": {"law": "fl"}}))
    session.change(Stop())
    changed = [kind for kind in COMMANDS if kind not in ("load", "unload", *OF_ARM)]
    events = [kind for _, kind in list_events(session)]
    assert sorted(events) == sorted(changed)
    assert list_events(session) == [(5, kind) for kind in events]
    assert [(command.tick, command.kind) for command in session.journal.commands] == list_events(
        session
    )
    assert session.run.configuration.law == "ndobc"


def test_rejected_command_changes_nothing_and_is_not_logged():
    session = build_session()
    before = session.run.configuration, session.version
    lanes = list(session.run.lanes)
    with pytest.raises(svsa.ParameterError):
        session.change(Set("stiffness", svsa.ConstantStiffness(stiffness_nm_per_rad=500.0)))
    with pytest.raises(svsa.StateError):
        session.change(RemoveLoad(argument=99))
    assert (session.run.configuration, session.version) == before
    assert session.run.lanes == lanes
    assert session.journal.commands == []
    assert list_events(session) == []


NO_COMMANDS = [
    ("explode", 1),
    ("load", "paper"),
    ("load", None),
    ("position", None),
    ("position", svsa.ConstantStiffness(stiffness_nm_per_rad=40.0)),
    ("gains", "fast"),
    ("effects", 3),
    ("comparisons", "fl"),
    ("unload", "1"),
    ("unload", True),
]


@pytest.mark.parametrize(("kind", "argument"), NO_COMMANDS)
def test_invalid_command_is_rejected_and_leaves_no_trace(kind, argument):
    """A rejected load must not take a number: a replay counts the accepted ones only."""
    session = build_session(PULSE)
    before = session.run.configuration, session.version, session.run.loads
    with pytest.raises(svsa.SvsaError, match=kind):
        session.change(build_command(0, kind, argument))
    assert (session.run.configuration, session.version, session.run.loads) == before
    assert session.journal.commands == []
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    assert [load.number for load in session.run.loads] == [1, 2]
    plain, spoiled = build_session(PULSE), session
    plain.change(ApplyLoad(argument=svsa.PaperLoad()))
    for each in (plain, spoiled):
        each.step(20)
    np.testing.assert_array_equal(read_samples(plain), read_samples(spoiled))


def test_version_increases_with_every_change_and_not_with_time():
    """Clients request the state again after an increase."""
    session = build_session()
    seen = [session.version]
    for change in (
        session.start,
        session.pause,
        lambda: session.set_speed(0.5),
        lambda: session.change(Set("law", "fl")),
        lambda: session.change(ApplyLoad(argument=svsa.PaperLoad())),
        lambda: remove_loads(session),
        session.reset,
    ):
        change()
        seen.append(session.version)
    assert all(np.diff(seen) > 0)
    session.start()
    session.wake(0.0)
    before = session.version
    session.wake(0.1)
    assert session.version == before


def test_record_contains_the_live_events():
    """The same commands give the same events: laws by name, loads planned or not."""
    session = build_session(PULSE)
    session.step(20)
    session.change(Set("law", "fl"))
    session.change(Set("gains", session.run.configuration.gains))
    session.step(50)
    session.change(Set("comparisons", (svsa.Lane(law="ndobc"),)))
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.step(20)
    session.change(Set("laws", ("ndobc", "fl")))
    for torque in (0.1, 0.2):
        session.change(ApplyLoad(argument=svsa.PushLoad(torque_nm=(torque, 0.0, 0.0), hold_s=0.05)))
        session.step(30)
    session.change(RemoveLoad(argument=2))
    session.change(ApplyLoad(argument=svsa.ConstantLoad(torque_nm=(1.0, 0.0, 0.0))))
    session.step(60)
    reported = list(session.journal.events)
    assert [event.label for event in reported] == [
        "NDOBC → FL",
        "Gains changed",
        "Pulse 1 N·m on",
        "Pulse 1 N·m off",
        "NDOBC added",
        "3 kg load on",
        "FL → NDOBC",
        "Push on",
        "3 kg load off",
        "1 N·m on",
        "Push off",
    ]
    assert events.list_events(session.journal.initial, session.journal.commands) == reported


def test_comparison_lanes_are_reported_by_their_laws():
    session = build_session()
    session.step(10)
    for laws in (("fl",), ("fl", "adrc"), ()):
        session.change(Set("comparisons", tuple(svsa.Lane(law=law) for law in laws)))
    labels = [event.label for event in session.journal.events]
    assert labels == ["FL added", "FL, ADRC added", "Comparison off"]
    assert events.list_events(session.journal.initial, session.journal.commands) == list(
        session.journal.events
    )
