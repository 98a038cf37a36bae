"""The 3D view of a session of an arm: its poses, and the scene that shows them."""

import math

import pytest

import svsa
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.definition.command import ApplyLoad, Set
from svsa.runs.session.simulated import SimulatedSession
from svsa_scene.arm_pose import ArmPose, TipLoad, Wall
from svsa_server.scene.bridge import SceneBridge
from svsa_server.scene.poses import read_pose
from tests.server.scene.poses import make_pose

ARM = build_arm_experiment("rods", {}, {"law": "fl"})


@pytest.fixture
def session() -> SimulatedSession:
    return SimulatedSession("lab", ARM)


def read_arm(session: SimulatedSession) -> ArmPose:
    pose = read_pose(session)
    assert isinstance(pose, ArmPose)
    return pose


def test_pose_has_both_joints_and_the_loads_at_the_tip(session: SimulatedSession) -> None:
    assert read_pose(session) is None
    session.step(5)
    bare = read_arm(session)
    assert bare.load == TipLoad()
    assert bare.joints[0].position_rad != bare.joints[1].position_rad
    for load in (
        svsa.TipMass(mass_kg=0.1),
        svsa.TipForce(force_n=(1.0, 0.5)),
        svsa.TipPush(force_n=(0.5, 0.0), hold_s=0.5),
        svsa.Wall(normal_rad=math.pi, distance_m=-0.55, stiffness_n_per_m=500.0),
    ):
        session.change(ApplyLoad(argument=load))
    session.step(5)
    assert read_arm(session).load == TipLoad(0.1, (1.5, 0.5), Wall(math.pi, -0.55))


def test_comparison_is_in_the_pose_from_its_first_sample_on(session: SimulatedSession) -> None:
    session.step(5)
    session.change(Set("comparisons", (svsa.Lane(law="ndobc"),)))
    assert read_arm(session).comparison is None
    session.step(5)
    pose = read_arm(session)
    assert pose.comparison == pytest.approx([joint.position_rad for joint in pose.joints], abs=1e-3)
    assert pose.comparison_name == "NDOBC"


def test_view_of_an_arm_shows_poses_of_an_arm_only(session: SimulatedSession) -> None:
    session.step(5)
    bridge = SceneBridge(ARM)
    try:
        bridge.show(read_arm(session))
        bridge.show(make_pose(1.0))
        link = bridge._viser.scene.get_handle_by_name("/a/l")
        angle = read_arm(session).joints[0].position_rad
        assert link is not None
        assert link.wxyz[3] == pytest.approx(math.sin(angle / 2), abs=1e-3)
    finally:
        bridge.stop()
