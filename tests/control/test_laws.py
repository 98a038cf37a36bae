"""A law is one file: found by its entry point, called by a loop compiled without it."""

import dataclasses
import math
from importlib.metadata import EntryPoint
from typing import NamedTuple

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS, Torque
from svsa.analysis.design.sampled_loop import linearize_tick
from svsa.cli import prepare
from svsa.control import installed
from svsa.control.installed import LawError, get_law, list_law_names
from svsa.control.law import Law
from svsa.numerics.compilation import compiled, watch_compilation
from svsa.runs.definition.command import Set, build_command
from svsa.runs.execution.replay import replay
from svsa.runs.execution.run import Run
from svsa.runs.records.wording import describe_law
from svsa.runs.session.simulated import SimulatedSession
from svsa.runs.timeline.controllers import list_controllers, name_controllers
from svsa.simulation.loop.loop import advance as advance_lane
from tests.runs.session.sessions import PULSE, advance, build_configuration, read_samples

INTEGRAL = svsa.Lane(law="fl_integral")
FASTER = {"position_pole_rad_per_s": 70.0}
U1 = CHANNEL_INDEX["torque1_nm"]


class Memory(NamedTuple):
    """An estimate of the law, and the values that it received last."""

    w2: float = 0.25
    w4: float = 0.0
    w6: float = 0.0
    u1: float = 0.0
    calls: int = 0


@compiled
def watch(nominal, constants, memory, x, reference, estimate, applied, period):
    memory.u1 = applied.u1
    memory.calls += 1
    memory.w4 = 0.5 * memory.calls
    return Torque(0.1 * memory.calls, 0.0)


WATCH = Law("watch", "Watch", "", "", "", watch, memory=Memory, estimate="own")


@pytest.fixture
def install(monkeypatch):
    """Register laws of this file as an installed package would."""

    def register(**values: object) -> None:
        for name, value in values.items():
            entry = EntryPoint(name, f"{__name__}:{value}", installed.GROUP)
            monkeypatch.setitem(installed._find_entries(), name, entry)
            installed._load_law.cache_clear()

    yield register
    installed._load_law.cache_clear()


def test_law_that_fails_to_load_is_imported_once(monkeypatch, install):
    """A second attempt takes as long as the first, and the loop of a bench has no time for it."""
    install(absent="ABSENT")
    tried = []
    load = EntryPoint.load
    monkeypatch.setattr(EntryPoint, "load", lambda entry: tried.append(entry.name) or load(entry))
    for _ in range(2):
        with pytest.raises(LawError, match=r"The law absent .* does not load: AttributeError"):
            get_law("absent")
    assert tried == ["absent"]


def test_laws_of_the_paper_are_found_like_all_others():
    names = list_law_names()
    assert names[:2] == ("ndobc", "fl"), (
        "so that FL is what NDOBC is compared with, in its own color"
    )
    assert list(names[2:]) == sorted(names[2:])
    assert {get_law(name).title for name in ("fl", "ndobc")} == {"FL", "NDOBC"}


@pytest.mark.parametrize("law", ["no_law", "Not a name", ""])
def test_unknown_law_error_lists_the_installed_laws(law):
    with pytest.raises(svsa.ParameterError, match=r"law is '.*installed here: ndobc, fl, "):
        svsa.simulate("4a", law, duration_s=0.01)
    with pytest.raises(svsa.ParameterError, match=r"comparisons\[1\]\.law|law is"):
        svsa.simulate("4a", comparisons=(INTEGRAL, svsa.Lane(law=law)), duration_s=0.01)


def test_rejected_law_changes_nothing():
    run = Run(build_configuration(comparisons=(INTEGRAL,)))
    before, lanes = run.configuration, list(run.lanes)
    for kind, argument in (("law", "no_law"), ("comparisons", (svsa.Lane(law="no_law"),))):
        with pytest.raises(svsa.ParameterError):
            run.change(build_command(0, kind, argument))
    assert run.configuration == before
    assert all(one is other for one, other in zip(run.lanes, lanes, strict=True))


def test_new_law_does_not_recompile_the_loop(install):
    advance(Run(build_configuration()), 10)
    install(watch="WATCH")
    names: list[str] = []
    compiled_before = len(advance_lane.signatures)
    with watch_compilation(names.append):
        advance(Run(build_configuration(law="watch")), 10)
    assert len(advance_lane.signatures) == compiled_before
    assert set(names) <= {"watch"}


def test_law_receives_the_actual_torque_and_its_own_estimate_is_plotted(install):
    """It commands 0.1, 0.2, … N·m; with a delay of two samples it receives them three
    ticks later.
    """
    install(watch="WATCH")
    run = Run(build_configuration(law="watch", effects=svsa.Effects(delay_samples=2)))
    samples = advance(run, 10)[0]
    np.testing.assert_allclose(samples[2:, U1], 0.1 * np.arange(1, 9))
    memory = run.lanes[0].memory
    assert (memory[0], memory[2]) == (0.25, 0.0)
    assert memory[3] == samples[-2, U1], "what acted in the period before the last call"
    assert memory[4:5].view(np.int64)[0] == 10
    shown = samples[:, CHANNEL_INDEX["estimate_motor1_nm"]]
    np.testing.assert_allclose(shown, 0.5 * np.arange(1, 11))


def test_call_of_the_loop_does_not_modify_its_initial_state():
    run = Run(build_configuration(PULSE, law="fl_integral"))
    first = run.lanes[0]
    before = first.memory.copy()
    whole = advance(run, 300)
    np.testing.assert_array_equal(first.memory, before)
    assert np.any(run.lanes[0].memory != before)
    again = np.empty((300, len(CHANNELS)))
    advance_lane(run.blocks[0], run.laws[0], run.inputs, first, 0, again)
    np.testing.assert_array_equal(again, whole[0])


def test_memory_is_preserved_by_replay_branch_and_split_calls():
    configuration = build_configuration(PULSE, law="fl_integral", comparisons=(INTEGRAL,))
    session = SimulatedSession("cut", configuration)
    for ticks, kind, argument in (
        (90, "parameters", {"fl_integral": FASTER}),
        (60, "law", "fl"),
        (50, "law", "fl_integral"),
    ):
        session._advance(ticks)
        session.change(build_command(0, kind, argument))
    branch = SimulatedSession.branch("branch", configuration, session.journal.commands, 200)
    branch.change(Set("law", "fl_integral"))
    for one in (session, branch):
        for _ in range(100):
            one._advance(1)
    parts = [part.copy() for _, part in replay(configuration, session.journal.commands, 300)]
    whole = np.concatenate(parts, axis=1)
    for one in (session, branch):
        for lane in (0, 1):
            np.testing.assert_array_equal(read_samples(one, lane), whole[lane])


def test_lane_after_the_fault_of_another_is_rewound_with_its_memory():
    fragile = svsa.Lane(law="fl", gains=svsa.Gains.from_poles([-900.0] * 4, [-900.0] * 2))
    effects = svsa.RIG
    run = Run(
        build_configuration(law="fl_integral", comparisons=(fragile, INTEGRAL), effects=effects)
    )
    samples = np.empty((3, 2000, len(CHANNELS)))
    done = run.advance(samples)
    assert run.fault is not None
    alone = Run(build_configuration(law="fl_integral", effects=effects))
    advance(alone, done)
    for lane in (0, 2):
        np.testing.assert_array_equal(run.lanes[lane].memory, alone.lanes[0].memory)


def test_new_law_starts_without_memory_and_unchanged_law_keeps_it():
    run = Run(
        build_configuration(PULSE, law="fl_integral", comparisons=(svsa.Lane(law="fl"), INTEGRAL))
    )
    advance(run, 200)
    first, _, third = (lane.memory.copy() for lane in run.lanes)
    assert np.all(third != 0.0)
    run.change(Set("laws", ("fl", "fl_integral")))
    assert np.all(run.lanes[1].memory == 0.0)
    np.testing.assert_array_equal(run.lanes[2].memory, third)
    run.change(Set("parameters", {"fl_integral": get_law("fl_integral").parameters(**FASTER)}))
    np.testing.assert_array_equal(run.lanes[2].memory, third)
    assert np.any(first != 0.0)


def test_same_law_with_other_parameters_is_two_controllers():
    other = svsa.Lane(law="fl_integral", parameters=FASTER)
    configuration = build_configuration(law="fl_integral", comparisons=(other,))
    session = SimulatedSession("two", configuration)
    names = [lane[-1].controller for lane in session.journal.timeline.lanes]
    assert list(name_controllers(names).values()) == ["FL + I a 54.6", "FL + I a 70"]
    samples = advance(session.run, 300)
    assert np.any(samples[0] != samples[1])


def test_parameters_are_validated_by_their_law_and_stored_unchanged():
    with pytest.raises(svsa.ParameterError) as refused:
        build_configuration(parameters={"fl_integral": {"position_pole_rad_per_s": 1e9}})
    assert "parameters.fl_integral.position_pole_rad_per_s" in str(refused.value)
    assert "at most 150 rad/s" in str(refused.value)
    with pytest.raises(svsa.ParameterError, match="takes the run's gains"):
        svsa.Lane(law="ndobc", parameters={})
    configuration = build_configuration(
        parameters={"fl_integral": FASTER},
        comparisons=(svsa.Lane(law="fl_integral", parameters=FASTER),),
    )
    written = configuration.model_dump(mode="json")
    assert written["parameters"]["fl_integral"]["position_pole_rad_per_s"] == 70.0
    assert svsa.Configuration(**written) == configuration


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("missing", "does not load: AttributeError"),
        ("TICKS", "contains an object of type int"),
        ("WATCH", "contains the law watch"),
    ],
)
def test_broken_package_is_named_and_the_lab_continues(install, value, words):
    install(broken=value)
    with pytest.raises(LawError, match=words):
        svsa.simulate("4a", "broken", duration_s=0.01)
    assert svsa.simulate("4a", "fl", duration_s=0.01).fault is None


TICKS = 3


@compiled
def fail(nominal, constants, memory, x, reference, estimate, applied, period):
    return Torque(x.no_such_angle, 0.0)


STUMBLE = Law("fail", "Stumble", "", "", "", fail)


def test_law_that_fails_to_compile_is_named_and_changes_nothing(install):
    install(fail="STUMBLE")
    run = Run(build_configuration())
    before = run.configuration
    with pytest.raises(LawError, match="law fail does not compile: Typing"):
        run.change(Set("law", "fail"))
    assert run.configuration == before
    assert advance(run, 10).shape[1] == 10


def test_lab_starts_without_broken_laws(install, capsys):
    install(broken="missing", fail="STUMBLE")
    prepare()
    reported = capsys.readouterr().err
    assert "The law broken of the package" in reported
    assert "The law fail does not compile" in reported


def test_record_of_a_law_that_fails_to_load_shows_its_name(install):
    install(broken="missing")
    configuration = build_configuration(law="broken", parameters={"broken": {"rate": 2.0}})
    (controller,) = list_controllers(configuration, is_bench=False)
    assert name_controllers([controller]) == {controller: "broken (does not load)"}
    assert describe_law("broken") == "broken"


def test_law_without_name_or_with_unknown_estimate_is_invalid():
    with pytest.raises(svsa.ParameterError, match="lowercase letter"):
        dataclasses.replace(WATCH, name="Watch!")
    with pytest.raises(svsa.ParameterError, match="w2, w4, w6"):
        dataclasses.replace(WATCH, memory=type(get_law("fl_integral").memory()))


def test_memory_of_a_law_is_part_of_the_linearized_loop():
    """FL + I has two states more than FL, which add a slow pole; a constant is not a state."""
    exact = {"nominal": svsa.load_prototype().actuator}
    fl, integral = (
        linearize_tick(build_configuration(law=law, **exact), 15.0).A
        for law in ("fl", "fl_integral")
    )
    assert len(integral) == len(fl) + 2
    radii = [max(abs(np.linalg.eigvals(A))) for A in (fl, integral)]
    assert radii == pytest.approx([math.exp(-0.04), math.exp(-0.0329)], abs=8e-3)
