"""What the 3D view shows of a session."""

import math

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.runs.session.session import Session
from svsa.simulation.plant.loads import get_hung_mass
from svsa_scene import ActuatorPose, ComparisonPose
from svsa_scene.pose import POSE_CHANNELS, draw_nothing_unknown
from svsa_server.runs.lanes import list_session_stretches


def read_pose(session: Session) -> ActuatorPose | None:
    """The session's newest sample as the 3D view needs it; None before the first."""
    newest = session.journal.history.read_newest()
    if newest is None:
        return None

    values = {channel: float(newest[CHANNEL_INDEX[channel]]) for channel in POSE_CHANNELS}
    return ActuatorPose(
        **draw_nothing_unknown(values),
        comparisons=_read_comparisons(session),
        load_mass_kg=_find_hung_mass(session),
    )


def _read_comparisons(session: Session) -> tuple[ComparisonPose, ...]:
    """Where the links of the other lanes are; none before a lane's first sample."""
    poses = []
    for number, stretches in enumerate(list_session_stretches(session)[1:], start=1):
        newest = session.journal.history.read_newest(number)
        position = math.nan if newest is None else float(newest[CHANNEL_INDEX["position_rad"]])
        if math.isfinite(position):
            present = stretches[-1]
            poses.append(ComparisonPose(present.name, position, present.line_style))
    return tuple(poses)


def _find_hung_mass(session: Session) -> float:
    on = (held.load for held in session.run.loads if held.is_on(session.run.tick))
    return sum(map(get_hung_mass, on))
