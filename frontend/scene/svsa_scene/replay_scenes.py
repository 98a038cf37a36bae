"""The scenes of a replay, which show any tick of recorded samples: an actuator, or an arm."""

import bisect
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import viser

from svsa.actuators.arm.parameters import ArmParameters
from svsa.actuators.parameters import MechanismParameters
from svsa_scene import appearance as look
from svsa_scene import mechanism
from svsa_scene.arm import ArmScene
from svsa_scene.arm_pose import ArmPose, TipLoad
from svsa_scene.geometry import turn
from svsa_scene.names import add_label
from svsa_scene.pose import POSE_CHANNELS, ActuatorPose, LaneSegment, replace_unknown_disturbances
from svsa_scene.scene import ActuatorScene

_GHOST_STEP = 0.16
_MAX_NAMED = 2
_LONGEST_NAME = 16
_ON_GHOST = (1.43, 0.1, 0.86)
_PATH_POINTS = 1500


class ReplayArm(NamedTuple):
    """The arm of a recorded run.

    Attributes:
        links: The links.
        actuators: The actuator of each joint.
        loads: Loads at the tip, each with the tick from which it acts, from the first sample on.
    """

    links: ArmParameters
    actuators: Sequence[MechanismParameters]
    loads: Sequence[tuple[int, TipLoad]] = ((0, TipLoad()),)


@dataclass(frozen=True)
class RecordedSamples:
    """Recorded samples, as `record_motion` receives them.

    Attributes:
        values: (ticks, lanes, channels), SI.
        channels: Names of the channels.
        lanes: Controllers of every lane.
        load_mass_kg: Hanging mass at every tick, (ticks,), kg; for a single joint.
    """

    values: npt.NDArray[np.float64]
    channels: Sequence[str]
    lanes: Sequence[Sequence[LaneSegment]]
    load_mass_kg: npt.NDArray[np.float64]

    def read(self, tick: int, lane: int, load_mass_kg: float = 0.0) -> ActuatorPose:
        """Read the pose of a lane at a tick."""
        columns = [self.channels.index(name) for name in POSE_CHANNELS]
        values = zip(POSE_CHANNELS, self.values[tick, lane, columns].tolist(), strict=True)
        known = replace_unknown_disturbances(dict(values))
        return ActuatorPose(**known, load_mass_kg=load_mass_kg, comparisons=())

    def get_column(self, name: str) -> npt.NDArray[np.float64]:
        """A channel of all lanes, (ticks, lanes)."""
        return self.values[:, :, self.channels.index(name)]


class ActuatorReplay:
    """The first lane as the actuator, every other lane as the outline of its link, one for each of
    its controllers, visible while that one is in control.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        samples: RecordedSamples,
        parameters: MechanismParameters | None,
    ) -> None:
        self._samples = samples
        self.scene = ActuatorScene(server, parameters)
        lanes = samples.lanes
        named = len(lanes) == _MAX_NAMED
        self._ghosts = [_Ghosts(server, lane, lanes[lane], named) for lane in range(1, len(lanes))]

    def show(self, tick: int) -> None:
        """Show a tick, counted from the first sample."""
        samples = self._samples
        self.scene.update(samples.read(tick, 0, float(samples.load_mass_kg[tick])))
        angles = samples.get_column("position_rad")[tick]
        for lane, ghost in enumerate(self._ghosts, start=1):
            if math.isfinite(angles[lane]):
                ghost.show(tick, float(angles[lane]))


class ArmReplay:
    """The first lanes as the joints of an arm, further ones as the outline of the comparison, and
    the whole path of the tip and of its reference.
    """

    def __init__(
        self,
        server: viser.ViserServer,
        samples: RecordedSamples,
        arm: ReplayArm,
    ) -> None:
        self._samples, self._loads, self._count = samples, arm.loads, len(arm.actuators)
        self.scene = ArmScene(server, arm.links, arm.actuators, has_trail=False)
        stride = max(1, math.ceil(len(samples.values) / _PATH_POINTS))
        position, reference = (
            samples.get_column(name)[::stride, : self._count]
            for name in ("position_rad", "position_reference_rad")
        )
        self.scene.draw_paths(position, reference)

    def show(self, tick: int) -> None:
        """Show a tick, counted from the first sample."""
        samples, count = self._samples, self._count
        others = samples.get_column("position_rad")[tick, count:].tolist()
        is_compared = len(others) == count and all(map(math.isfinite, others))
        name = samples.lanes[count][-1].name.split(" ", 2)[-1] if is_compared else ""
        pose = ArmPose(
            [samples.read(tick, lane) for lane in range(count)],
            comparison=others if is_compared else None,
            comparison_name=name,
            load=self._loads[bisect.bisect(self._loads, tick, key=lambda one: one[0]) - 1][1],
        )
        self.scene.update(pose)


class _Ghosts:
    """The outlines of a lane, one a controller; that of the current one is seen."""

    def __init__(
        self, server: viser.ViserServer, lane: int, segments: Sequence[LaneSegment], named: bool
    ) -> None:
        self._segments = segments
        self._frames: dict[int, viser.SceneNodeHandle] = {}
        for segment in segments:
            if segment.number not in self._frames:
                name = segment.name if named and len(segment.name) <= _LONGEST_NAME else ""
                self._frames[segment.number] = _add_ghost(server, lane, segment, name)

    def show(self, tick: int, angle: float) -> None:
        """The lane's link at a tick, counted from the first sample."""
        present = next((one for one in self._segments if one.first <= tick < one.end), None)
        for number, frame in self._frames.items():
            is_seen = present is not None and number == present.number
            if frame.visible != is_seen:
                frame.visible = is_seen
            if is_seen:
                frame.wxyz = turn(angle)


def _add_ghost(
    server: viser.ViserServer, lane: int, segment: LaneSegment, name: str
) -> viser.SceneNodeHandle:
    node = f"/a/lane{lane}c{segment.number}"
    finish = look.Finish(look.get_line_color(segment.line_style), 0.0, 0.8, 0.45)
    frame = server.scene.add_frame(
        node,
        show_axes=False,
        position=(0.0, 0.0, _GHOST_STEP * lane),
        visible=segment.first <= 0,
    )
    server.scene.add_glb(f"{node}/solid", mechanism.export(_build_ghost, finish))
    if name:
        add_label(server, f"{node}/t", name, _ON_GHOST)
    return frame


def _build_ghost(finish: look.Finish) -> mechanism.Group:
    return [look.paint(mesh, finish) for mesh in mechanism.build_ghost()]
