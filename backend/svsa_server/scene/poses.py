"""The pose of a session's actuator or arm, from its newest samples."""

import math
from dataclasses import replace

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.runs.session.session import Session
from svsa.simulation.plant.loads import Load
from svsa_scene import ActuatorPose, ComparisonPose
from svsa_scene.arm_pose import ArmPose
from svsa_scene.pose import POSE_CHANNELS, replace_unknown_disturbances
from svsa_server.runs.lanes import list_session_segments
from svsa_server.runs.tip_load import sum_tip_loads


def read_pose(session: Session) -> ActuatorPose | ArmPose | None:
    """Read the pose from the session's newest sample; None before the first."""
    if session.run.configuration.arm is not None:
        return _read_arm(session)
    pose = _read_lane(session, 0)
    return pose and replace(
        pose,
        comparisons=_read_comparisons(session),
        load_mass_kg=sum(load.get_hung_mass() for load in _list_acting(session)),
    )


def _read_lane(session: Session, lane: int) -> ActuatorPose | None:
    """Read the pose of a lane, from 0, without loads; None before its first sample."""
    newest = session.journal.history.read_newest(lane)
    if newest is None:
        return None
    values = {channel: float(newest[CHANNEL_INDEX[channel]]) for channel in POSE_CHANNELS}
    known = replace_unknown_disturbances(values)
    return ActuatorPose(**known, load_mass_kg=0.0, comparisons=())


def _read_comparisons(session: Session) -> tuple[ComparisonPose, ...]:
    """Read the link angles of the other lanes; none before a lane's first sample."""
    poses = []
    for number, segments in enumerate(list_session_segments(session)[1:], start=1):
        pose = _read_lane(session, number)
        position = math.nan if pose is None else pose.position_rad
        if math.isfinite(position):
            present = segments[-1]
            poses.append(ComparisonPose(present.name, position, present.line_style))
    return tuple(poses)


def _list_acting(session: Session) -> list[Load]:
    """List the loads that act now."""
    return [held.load for held in session.run.loads if held.is_on(session.run.tick)]


def _read_arm(session: Session) -> ArmPose | None:
    """Read the joints, the comparison's angles and the loads at the tip."""
    lanes = range(len(session.run.configuration.lanes))
    poses = [_read_lane(session, lane) for lane in lanes]
    count = len(session.run.configuration.joints)
    joints = tuple(pose for pose in poses[:count] if pose is not None)
    if len(joints) < count:
        return None
    angles = tuple(math.nan if pose is None else pose.position_rad for pose in poses[count:])
    is_compared = len(angles) == count and all(map(math.isfinite, angles))
    segments = list_session_segments(session)
    return ArmPose(
        joints,
        comparison=angles if is_compared else None,
        comparison_name=segments[count][-1].name.split(" ", 2)[-1] if is_compared else "",
        load=sum_tip_loads(_list_acting(session)),
    )
