"""A running lab from Python: settings, loads, recordings, streams, rejections, lost responses."""

from collections.abc import Iterator

import numpy as np
import pytest

import svsa
from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.client import AccessError, ControlError, Lab, LabError
from tests.client.faulty_line import run_faulty_line
from tests.lab import Lab as Server
from tests.lab import run_lab


@pytest.fixture
def server(shared_lab: Server) -> Iterator[Server]:
    shared_lab.restart()
    yield shared_lab
    shared_lab.client.post(shared_lab.session + "/pause")


@pytest.fixture
def lab(server: Server) -> Iterator[Lab]:
    with svsa.connect(server.url) as connected:
        yield connected


def test_settings_are_read_back_with_the_time_of_the_change(lab: Lab) -> None:
    with lab.new_session(load=False) as session:
        session.pause()
        session.run_until(0.25)
        for name, value in {
            "position": svsa.SinePosition(amplitude_rad=0.5, frequency_hz=0.3),
            "stiffness": svsa.ConstantStiffness(stiffness_nm_per_rad=40.0),
            "gains": svsa.Gains.from_poles((-50,) * 4, (-30,) * 2),
            "observer": svsa.ObserverBandwidth(bandwidth_rad_per_s=(40.0, 50.0, 60.0)),
            "effects": svsa.RIG,
            "nominal": session.nominal.changed(link_inertia_kg_m2=0.02),
            "actuator": session.actuator.changed(link_damping_nms_per_rad=0.01),
            "comparisons": (svsa.Lane(law="fl"),),
            "law": "fl_integral",
        }.items():
            setattr(session, name, value)
            assert getattr(session, name) == value
            assert session.applied_at is not None
            assert (session.applied_at.tick, session.applied_at.time_s) == (250, 0.25)


def test_time_of_a_change_is_not_that_of_another_event(lab: Lab) -> None:
    with lab.new_session(load=True) as session:
        session.pause()
        assert session.applied_at is None
        session.law = "fl"
        applied_at = session.applied_at
        session.run_until(5.1)
        assert session.read_state()["events"][-1]["kind"] == "load_on"
        assert session.applied_at == applied_at
        session.law = "fl"
        assert session.applied_at == applied_at


def test_unambiguous_values_are_accepted_and_others_named(lab: Lab) -> None:
    with lab.new_session("4A", load=False, effects="rig", comparisons="fl") as session:
        assert session.effects == svsa.RIG
        assert session.comparisons == (svsa.Lane(law="fl"),)
        session.stiffness = 30
        assert session.stiffness == svsa.ConstantStiffness(stiffness_nm_per_rad=30.0)
        session.set(position=0.2, effects="ideal", observer=50, comparisons=["pd"])
        assert session.position == svsa.ConstantPosition(position_rad=0.2)
        assert session.effects == svsa.IDEAL
        assert session.observer.bandwidth_rad_per_s == (50.0, 50.0, 50.0)
        assert session.comparisons == (svsa.Lane(law="pd"),)
        before = session.nominal
        session.nominal = {"link_inertia_kg_m2": 0.03}
        assert session.nominal == before.changed(link_inertia_kg_m2=0.03)
        assert session.loads.add({"kind": "paper"}).load == svsa.PaperLoad()
        with pytest.raises(svsa.ParameterError, match=r"gains is 60: it must be svsa\.Gains"):
            session.set(gains=60)
    with pytest.raises(svsa.ParameterError, match=r"stifness: .*nearest is stiffness"):
        lab.run("4a", **{"stifness": 40})


def test_rejection_raises_the_error_of_the_library(lab: Lab) -> None:
    with lab.new_session(load=False) as session, pytest.raises(svsa.ParameterError) as refused:
        session.set_parameters("fl_integral", position_pole_rad_per_s=1e6)
    (violation,) = refused.value.violations
    assert (violation.name, violation.value) == ("fl_integral.position_pole_rad_per_s", 1e6)
    assert violation.unit == "rad/s"
    with pytest.raises(svsa.StateError, match="simulated: it has no bench"):
        lab.session.bench.arm()
    with pytest.raises(LabError, match="no run 'nowhere'"):
        _ = lab.runs["nowhere"]


def test_run_with_load_is_recorded_and_streamed(lab: Lab) -> None:
    with lab.new_session(load=False) as session:
        with session.record("3 kg", tags=("test",)) as recording:
            load = session.loads.add(svsa.PaperLoad())
            assert [one.load for one in session.loads] == [svsa.PaperLoad()]
            blocks = list(session.stream("torque1_nm", "position_rad", duration_s=0.2))
            session.loads.remove(load)
            assert len(session.loads) == 0
        result = recording.result
    ticks = np.concatenate([block.ticks for block in blocks])
    assert 0.15 < (ticks[-1] - ticks[0]) * blocks[0].period_s <= 0.2
    first = round(float(result.time_s[0]) / blocks[0].period_s)
    streamed = np.concatenate([block["position_rad"] for block in blocks])
    assert np.array_equal(streamed, result.position_rad[ticks - first].astype("f4"))
    assert [command.kind for command in result.commands] == ["load", "unload"]
    assert result.name == "3 kg"
    assert recording.run_id in set(lab.runs)


FIGURE_5 = svsa.paper.FIGURES["5"].build_configuration()
CHANGES = [
    svsa.Change(at_s=0.3, law="fl"),
    svsa.Change(at_s=0.4, load=svsa.PaperLoad()),
    svsa.Change(at_s=0.5, position=FIGURE_5.position, stiffness=FIGURE_5.stiffness),
]
"""The last ones restart a reference that the session follows already."""


def test_run_in_the_lab_equals_the_run_of_the_library_bit_for_bit(lab: Lab) -> None:
    settings = {
        "effects": svsa.RIG,
        "seed": 7,
        "comparisons": (svsa.Lane(law="fl_integral"),),
        "loads": (svsa.ConstantLoad(start_s=0.2, torque_nm=(0.5, 0.0, 0.0)),),
        "gains": svsa.Gains.from_poles((-50,) * 4, (-30,) * 2),
    }
    here = svsa.simulate("5", duration_s=0.6, commands=CHANGES, **settings)
    there = lab.run(svsa.paper.FIGURES["5"], duration_s=0.6, commands=CHANGES, **settings)
    assert np.array_equal(there.samples, here.samples)
    assert np.array_equal(there.comparisons[0].samples, here.comparisons[0].samples)
    assert there.metrics == here.metrics


def test_run_that_ends_in_a_fault_reports_it(lab: Lab) -> None:
    pull = svsa.ConstantLoad(start_s=0.1, torque_nm=(40.0, 0.0, 0.0))
    here = svsa.simulate("4a", duration_s=1.0, loads=(pull,))
    there = lab.run("4a", duration_s=1.0, loads=(pull,))
    assert there.fault == here.fault is not None
    assert np.array_equal(there.samples, here.samples)


def test_unsupported_limits_are_rejected(lab: Lab) -> None:
    limits = svsa.load_prototype().limits.changed(torque1_nm=3.0)
    with pytest.raises(svsa.ParameterError, match=r"limits\.torque1_nm is 3"):
        lab.run("4a", limits=limits)


def test_call_with_a_lost_response_is_carried_out_once(server: Server) -> None:
    with (
        run_faulty_line(server.url) as line,
        svsa.connect(line.url) as lab,
        lab.new_session(load=False) as session,
    ):
        session.pause()
        line.break_answers = 1
        session.loads.add(svsa.PaperLoad())
        assert line.break_answers == 0
        assert len(session.loads) == 1
        line.break_requests = 1
        session.loads.add(svsa.PaperLoad())
        assert line.break_requests == 0
        assert len(session.loads) == 2


def test_interrupted_stream_continues_with_a_gap(server: Server) -> None:
    with run_faulty_line(server.url) as line, svsa.connect(line.url) as lab:
        blocks = iter(lab.session.stream("position_rad", duration_s=60.0))
        before = next(blocks)
        line.cut()
        after = next(block for block in blocks if block.ticks[0] > before.ticks[-1] + 200)
        blocks.close()
    assert after.run == before.run


def test_missing_lab_is_named_in_the_error() -> None:
    with pytest.raises(LabError, match=r"http://127\.0\.0\.1:9 does not answer"):
        svsa.connect("http://127.0.0.1:9", timeout_s=0.0)


def test_deleted_session_gives_one_error_with_the_next_step(lab: Lab) -> None:
    """As after a restart of the lab: the end of the block raises no second error."""
    with pytest.raises(LabError, match="open a new one") as raised, lab.new_session() as session:
        lab.open_session(session.name).end()
        session.law = "fl"
    assert raised.value.__context__ is None


def test_control_lease_is_acquired_and_released(server: Server, lab: Lab) -> None:
    with svsa.connect(server.url, client="Ada's") as other, lab.new_session(load=False) as session:
        other_s = other.open_session(session.name)
        other_s.take_control("Ada")
        with pytest.raises(ControlError, match="Ada is in control"):
            session.law = "fl"
        other_s.give_control_back()
        session.law = "fl"


@pytest.mark.exhaustive
def test_secret_opens_the_lab() -> None:
    with run_lab(secret="of the class") as guarded:
        with pytest.raises(AccessError):
            svsa.connect(guarded.url, token="of no one")
        with svsa.connect(guarded.url, token="of the class") as lab:
            assert "ndobc" in lab.laws
            assert len(next(iter(lab.session.stream(duration_s=0.1))).ticks)


def test_script_opens_a_session_of_an_actuator(lab: Lab) -> None:
    assert lab.actuators == list_mechanism_names()
    with lab.new_session(actuator="qbmove", law="fl", load=False) as session:
        assert session.actuator == get_mechanism("qbmove").prototype
        session.actuator = {"link_inertia_kg_m2": 0.021}
        assert session.actuator.link_inertia_kg_m2 == 0.021
        assert session.nominal == get_mechanism("qbmove").nominal
    with pytest.raises(svsa.ParameterError, match="the nearest is qbmove"):
        lab.create_session(actuator="qbmov")


def test_joints_of_an_arm_are_changed_one_by_one_and_together(lab: Lab) -> None:
    with lab.new_session(arm="rods", feedforward=True) as session:
        session.pause()
        second = session.open_joint(2)
        second.law = "fl"
        second.stiffness = 60
        assert (session.law, second.law) == ("ndobc", "fl")
        assert session.open_joint(1).stiffness != second.stiffness
        session.set(stiffness=50, observer=40)
        assert session.stiffness == second.stiffness
        second.repeat_position()
        session.change_arm(feedforward=False, adaptation=svsa.PayloadAdaptation())
        arm = session.read_state()["configuration"]["arm"]
        assert (arm["feedforward"], arm["adaptation"]["mass_max_kg"]) == (False, 2.0)
        session.loads.add(svsa.TipMass(mass_kg=0.1))
        second.loads.add(svsa.PulseLoad(torque_nm=(0.1, 0.0, 0.0), duration_s=0.1))
        session.run_until(0.5)
        assert [one.load.kind for one in session.loads if one.active] == ["tip_mass"]
        tip = svsa.TipMove(start_m=(0.2, -0.4), end_m=(0.3, -0.3), duration_s=1.0)
        session.change_arm(tip=tip)
        assert session.tick == 0
        with pytest.raises(svsa.ParameterError, match="away from joint 1"):
            session.change_arm(tip=tip.changed(end_m=(2.0, 0.0)))
    with (
        lab.new_session(load=False) as session,
        pytest.raises(svsa.StateError, match="single joint"),
    ):
        session.change_arm(feedforward=True)
