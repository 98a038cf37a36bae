"""The session of an arm: changes of each joint, loads at the tip, a second arm, exact replay."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import svsa
from svsa.actuators.signals import CHANNEL_INDEX
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.definition.command import ApplyLoad, RemoveLoad, Set, read_command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.arm_run import ArmRun
from svsa.runs.execution.replay import build_run_at, simulate_again
from svsa.runs.records.difference import compare_settings
from svsa.runs.records.reader import open_record
from svsa.runs.result.saved import build_arm_result_record
from svsa.runs.session.simulated import SimulatedSession
from svsa.runs.timeline.events import list_events
from svsa.runs.timeline.timeline import read_timeline
from tests.runs.session.scripts import scripted

RIG = build_arm_experiment("rods", {}, {"effects": svsa.RIG, "law": "ndobc"})
JOINT = st.sampled_from([1, 2])
LAWS = st.sampled_from(["fl", "ndobc", "pd", "fl_integral"])
EITHER = st.none() | JOINT
SETTINGS = st.one_of(
    st.builds(Set, st.just("law"), LAWS, joint=EITHER),
    st.builds(
        Set,
        st.just("stiffness"),
        st.builds(svsa.ConstantStiffness, stiffness_nm_per_rad=st.floats(40.0, 100.0)),
        joint=EITHER,
    ),
    st.builds(
        Set,
        st.just("position"),
        st.builds(svsa.ConstantPosition, position_rad=st.floats(-0.5, 0.5)),
        joint=EITHER,
    ),
    st.builds(
        Set,
        st.just("observer"),
        st.builds(svsa.ObserverBandwidth, bandwidth_rad_per_s=st.just((40.0, 50.0, 60.0))),
        joint=EITHER,
    ),
    st.builds(Set, st.just("feedforward"), st.booleans()),
    st.builds(Set, st.just("adaptation"), st.sampled_from([None, svsa.PayloadAdaptation()])),
    st.builds(
        Set,
        st.just("comparisons"),
        st.lists(st.builds(svsa.Lane, law=LAWS), max_size=1).map(tuple),
    ),
)
LOADS = st.one_of(
    st.builds(svsa.TipMass, mass_kg=st.floats(0.01, 0.1)),
    st.builds(svsa.TipPush, force_n=st.just((1.0, -0.5)), hold_s=st.just(0.05)),
    st.builds(svsa.Wall, normal_rad=st.just(3.0), distance_m=st.just(-0.2),
              stiffness_n_per_m=st.just(500.0)),
    st.builds(svsa.PulseLoad, torque_nm=st.just((0.2, 0.0, 0.0)), duration_s=st.just(0.03)),
)  # fmt: skip
COMMANDS = SETTINGS | st.builds(ApplyLoad, argument=LOADS, joint=JOINT)
SCRIPTS = st.lists(st.tuples(st.integers(0, 40), COMMANDS), max_size=6)


def build_session(configuration=RIG):
    return SimulatedSession("lab", configuration)


def read_lanes(session):
    """The samples of every lane since the start of the run."""
    lanes = list(range(len(session.run.lanes)))
    return session.journal.history.read(0, 1, list(CHANNEL_INDEX.values()), lanes)


def collect(configuration, commands, ticks):
    parts = list(simulate_again(configuration, commands, 0, ticks))
    return np.concatenate([part[:2] for part in parts], axis=1).transpose(1, 0, 2)


@scripted
@given(SCRIPTS)
def test_session_of_an_arm_is_replayed_bit_for_bit(script):
    """From JSON alone, with changes of both joints, a second arm and loads at the tip."""
    session = build_session()
    session.step(20)
    for ticks, command in script:
        session.change(command)
        session.step(max(1, ticks))
    session.step(30)
    journal = session.journal
    written = json.loads(json.dumps([command.to_json() for command in journal.commands]))
    configuration = Configuration(**json.loads(journal.initial.model_dump_json()))
    commands = [read_command(one) for one in written]
    again = collect(configuration, commands, session.run.tick)
    assert again.tobytes() == read_lanes(session)[:, :2].tobytes()
    assert list_events(configuration, commands) == [
        event for event in journal.events if event.tick < session.run.tick
    ]
    timeline = read_timeline(configuration, commands, (0, session.run.tick))
    assert timeline.lanes == journal.timeline.lanes
    ended = build_run_at(configuration, commands, session.run.tick)
    assert ended.loads == session.run.loads or commands[-1].tick == session.run.tick


def test_command_of_a_joint_changes_that_joint_only():
    session = build_session()
    session.change(Set("law", "fl", joint=2))
    session.change(Set("stiffness", svsa.ConstantStiffness(stiffness_nm_per_rad=60.0), joint=1))
    first, second = session.run.configuration.joints
    assert (first.law, second.law) == ("ndobc", "fl")
    assert first.stiffness.stiffness_nm_per_rad == 60.0
    assert second.stiffness.stiffness_nm_per_rad == 80.0
    assert [event.label for event in session.journal.events] == [
        "Joint 2: NDOBC → FL",
        "Joint 1: Stiffness changed",
    ]
    names = session.journal.timeline.name_segments(session.journal.timeline.lanes)
    assert set(names.values()) >= {"Joint 1 NDOBC", "Joint 2 FL"}


def test_second_arm_begins_where_the_first_one_is_and_has_its_loads():
    session = build_session(build_arm_experiment("rods", {}, {"law": "ndobc"}))
    session.step(500)
    session.change(Set("comparisons", (svsa.Lane(law="fl"),)))
    session.step(1)
    rows = read_lanes(session)[-1]
    names = ["position_rad", "velocity_rad_per_s", "motor1_position_rad", "motor2_position_rad"]
    columns = [CHANNEL_INDEX[name] for name in names]
    assert rows[:2, columns].tolist() == rows[2:, columns].tolist()
    assert [len(session.run.lanes), len(session.run.configuration.lanes)] == [4, 4]
    session.change(ApplyLoad(argument=svsa.TipMass(mass_kg=0.1)))
    session.step(2000)
    errors = np.abs(read_lanes(session)[-500:, :, CHANNEL_INDEX["position_error_rad"]]).max(axis=0)
    assert np.all(errors[:2] < 0.2 * errors[2:])


@pytest.mark.parametrize("is_on", [True, False])
def test_feedforward_switched_changes_the_torque_by_less_than_its_motion(is_on):
    """ŵ2 already has what the model explains: to add it again would double the torque at once."""
    given = {"feedforward": not is_on}
    session = build_session(build_arm_experiment("rods", given, {"law": "ndobc"}))
    session.step(3000)
    session.change(Set("feedforward", is_on))
    session.step(200)
    rows = read_lanes(session)
    torque = rows[..., CHANNEL_INDEX["torque1_nm"]]
    assert np.all(np.abs(torque[3000] - torque[2999]) < 0.05 * np.abs(torque[2999]))
    error = np.degrees(np.abs(rows[3000:, :, CHANNEL_INDEX["position_error_rad"]]))
    assert error.max() < 0.2, "as without feedforward, or less"
    estimate = rows[..., CHANNEL_INDEX["estimate_link_nm"]]
    assert estimate[3000] == pytest.approx(estimate[2999], rel=0.01)


def test_feedforward_switched_on_lowers_the_error():
    session = build_session(build_arm_experiment("rods", {}, {"law": "ndobc"}))
    session.step(3000)
    before = read_lanes(session)[-1000:]
    session.change(Set("feedforward", True))
    session.step(3000)
    after = read_lanes(session)[-1000:]
    error = CHANNEL_INDEX["position_error_rad"]
    assert np.all(np.abs(after[..., error]).max(0) < 0.3 * np.abs(before[..., error]).max(0))


def test_push_at_the_tip_sent_again_is_one_load():
    session = build_session()
    for _ in range(4):
        session.change(ApplyLoad(argument=svsa.TipPush(force_n=(1.0, 0.0), hold_s=0.1)))
        session.step(50)
    assert [load.number for load in session.run.loads] == [1]
    session.step(200)
    assert [event.kind for event in session.journal.events] == ["load_on", "load_off"]


def test_estimated_mass_is_that_of_the_load():
    session = build_session(
        build_arm_experiment(
            "rods", {"feedforward": True, "adaptation": svsa.PayloadAdaptation()}, {"law": "fl"}
        )
    )
    session.change(ApplyLoad(argument=svsa.TipMass(mass_kg=0.2)))
    session.step(6000)
    assert isinstance(session.run, ArmRun)
    assert session.run.payloads_kg == [pytest.approx(0.2, rel=0.1)]
    session.change(RemoveLoad(argument=1))
    session.step(6000)
    assert abs(session.run.payloads_kg[0]) < 0.05


def test_restart_keeps_settings_and_planned_loads():
    planned = (svsa.TipMass(mass_kg=0.1, start_s=0.2),)
    session = build_session(build_arm_experiment("rods", {}, {"law": "fl"}, tip_loads=planned))
    session.change(Set("law", "pd", joint=2))
    session.change(ApplyLoad(argument=svsa.TipForce(force_n=(1.0, 0.0))))
    session.step(10)
    session.reset()
    assert session.run.tick == 0
    assert [joint.law for joint in session.run.configuration.joints] == ["fl", "pd"]
    assert [held.load for held in session.run.loads] == list(planned)


@pytest.mark.parametrize(
    ("command", "message"),
    [
        (ApplyLoad(argument=svsa.MassLoad()), "tip_mass"),
        (Set("comparisons", (svsa.Lane(law="fl"), svsa.Lane(law="pd"))), "comparisons is 2"),
        (Set("effects", svsa.Effects(gravity={"moment_nm": 0.5}), joint=2), "effects.gravity"),
    ],
)
def test_command_that_an_arm_cannot_take_changes_nothing(command, message):
    session = build_session()
    before = session.run.configuration, session.version
    with pytest.raises(svsa.ParameterError, match=message):
        session.change(command)
    assert (session.run.configuration, session.version) == before


@pytest.mark.parametrize(
    "command",
    [
        ApplyLoad(argument=svsa.TipMass(mass_kg=0.1)),
        Set("feedforward", True),
        Set("law", "fl", joint=2),
    ],
)
def test_single_joint_rejects_what_needs_an_arm(command):
    session = build_session(svsa.simulate("4a", duration_s=0.01).configuration)
    with pytest.raises(svsa.StateError, match="need an arm"):
        session.change(command)


def test_recorded_session_opens_and_is_simulated_again(tmp_path):
    result = svsa.simulate_arm(comparisons=["fl"], duration_s=0.3)
    folder = svsa.save_run(result, tmp_path / "arm")
    assert len(open_record(folder).header.lanes) == 4
    opened = svsa.open_arm_run(folder)
    assert opened.comparisons[0].samples.tobytes() == result.comparisons[0].samples.tobytes()
    assert svsa.resimulate(folder).identical


def test_changes_of_a_script_act_on_their_joint():
    result = svsa.simulate_arm(
        law="fl",
        duration_s=0.2,
        commands=[
            svsa.Change(
                at_s=0.1, joint=2, law="ndobc", load=svsa.ConstantLoad(torque_nm=(0.3, 0, 0))
            ),
            svsa.Change(at_s=0.15, feedforward=True),
        ],
    )
    assert [(one.tick, one.kind, one.joint) for one in result.commands] == [
        (100, "law", 2),
        (100, "load", 2),
        (150, "feedforward", None),
    ]
    without = svsa.simulate_arm(law="fl", duration_s=0.2)
    same = result.samples[:, :100] == without.samples[:, :100]
    assert np.all(same | np.isnan(without.samples[:, :100]))
    estimate = CHANNEL_INDEX["estimate_link_nm"]
    assert abs(result.samples[1, -1, estimate] - without.samples[1, -1, estimate]) > 0.1


def test_settings_that_differ_between_arms_are_listed():
    options = {"law": "fl", "duration_s": 0.05}
    change = svsa.Change(at_s=0.02, joint=2, law="ndobc")
    runs = (
        svsa.simulate_arm(**options),
        svsa.simulate_arm(**options, feedforward=True, joint2={"law": "pd"}, commands=[change]),
    )
    found = compare_settings([build_arm_result_record(run) for run in runs])
    assert {(one.group, one.name): one.values for one in found} == {
        ("Arm", "feedforward"): ("false", "true"),
        ("Arm", "other_joints[0].law"): ('"fl"', '"pd"'),
        ("Arm", "Changes of the arm and of joints from 2 on"): ("", "law at 0.02 s"),
    }
