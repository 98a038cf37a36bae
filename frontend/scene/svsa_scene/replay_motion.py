"""The 3D view of a replay: viser's own page with the scene in it, and its motion as tracks.

The live scene is built and moved once through the run; the messages that it sends are the
replay. They are kept apart from the scene, property by property, so that the page can show any
instant without playing what came before.
"""

import contextlib
import io
import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import msgspec
import numpy as np
import numpy.typing as npt
import viser
import zstandard

from svsa.actuators.parameters import MechanismParameters
from svsa_scene import appearance as look
from svsa_scene import mechanism
from svsa_scene.geometry import turn
from svsa_scene.names import add_label
from svsa_scene.pose import POSE_CHANNELS, ActuatorPose, LaneSegment, draw_nothing_unknown
from svsa_scene.replay_packing import ArrayPack
from svsa_scene.scene import ActuatorScene

RATE_HZ = 30.0
MAX_FRAMES = 5400
_REST = {"wxyz": (1.0, 0.0, 0.0, 0.0), "position": (0.0, 0.0, 0.0), "visible": True}
_SMOOTH = ("wxyz", "position", "scale")
_GHOST_STEP = 0.16
_MAX_NAMED = 2
_LONGEST_NAME = 16
_ON_GHOST = (1.43, 0.1, 0.86)


class Motion(NamedTuple):
    """`html`: the scene as a page. `content`: what the replay moves in it, for JSON."""

    html: str
    content: dict[str, Any]


class _Key(NamedTuple):
    """One property of one node: message type, node name, field."""

    kind: str
    name: str
    field: str


def record_motion(
    samples: npt.NDArray[np.float64],
    channels: Sequence[str],
    lanes: Sequence[Sequence[LaneSegment]],
    period_s: float,
    load_mass_kg: npt.NDArray[np.float64],
    pack: ArrayPack,
    parameters: MechanismParameters | None = None,
) -> Motion:
    """The first lane as the actuator, every other lane as the outline of its link, one for
    each of its controllers that is seen while that one controls.

    parameters: of the plant, which name the actuator; left out, those of the SVSA.
    30 frames a second of the run, fewer where that would be more than `MAX_FRAMES`.
    """
    stride = max(1, round(1.0 / (RATE_HZ * period_s)), math.ceil(len(samples) / MAX_FRAMES))
    columns = [channels.index(name) for name in POSE_CHANNELS]
    position = channels.index("position_rad")
    with _start_viser() as server:
        scene = ActuatorScene(server, parameters)
        named = len(lanes) == _MAX_NAMED
        ghosts = [_Ghosts(server, lane, lanes[lane], named) for lane in range(1, len(lanes))]
        html = _hide_viser_controls(server.get_scene_serializer().as_html())
        recording = server.get_scene_serializer()
        for tick in range(0, len(samples), stride):
            recording.insert_sleep(1.0)
            values = zip(POSE_CHANNELS, samples[tick, 0, columns].tolist(), strict=True)
            pose = draw_nothing_unknown(dict(values))
            mass = float(load_mass_kg[tick])
            scene.update(ActuatorPose(**pose, load_mass_kg=mass, comparisons=()))
            for lane, ghost in enumerate(ghosts, start=1):
                angle = float(samples[tick, lane, position])
                if math.isfinite(angle):
                    ghost.show(tick, angle)
        recording.insert_sleep(1.0)
        scene.set_theme(dark=True)
        messages = _decode(recording.serialize())
    frames = -(-len(samples) // stride)
    themes = [m for _, m in messages if m["type"] == "ThemeConfigurationMessage"]
    content = {
        "step_s": stride * period_s,
        "frames": frames,
        "tracks": [_pack_track(key, *track, pack) for key, track in _sort(messages).items()],
        "theme": themes[-1],
    }
    return Motion(html, content)


@contextlib.contextmanager
def _start_viser() -> Iterator[viser.ViserServer]:
    with contextlib.redirect_stdout(io.StringIO()):
        server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        yield server
    finally:
        with contextlib.redirect_stdout(io.StringIO()):
            server.stop()


class _Ghosts:
    """The outlines of a lane, one a controller; that of the present one is seen."""

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


def _hide_viser_controls(html: str) -> str:
    """The replay has controls of its own: viser's button for its scene tree goes, and its note
    about rendering without a graphics card, which would cover the scene.
    """
    hidden = 'div:has(> [aria-label="Show scene tree"]), .mantine-Notifications-root'
    style = f"<style>{hidden} {{display: none !important}}</style>"
    return html.replace("</head>", style + "</head>", 1)


def _decode(recording: bytes) -> list[tuple[float, dict[str, Any]]]:
    """Messages with their times from viser's own format: a length, then zstd of (a length,
    MessagePack, buffers).
    """
    inner = zstandard.ZstdDecompressor().decompress(recording[8:])
    length = int.from_bytes(inner[:8], "little")
    return msgspec.msgpack.decode(inner[8 : 8 + length])["messages"]


def _sort(
    messages: list[tuple[float, dict[str, Any]]],
) -> dict[_Key, tuple[list[int], list[Any]]]:
    """Frames and values of every property that moves; the first of each is at frame 0."""
    start: dict[tuple[str, str], Any] = {}
    tracks: dict[_Key, tuple[list[int], list[Any]]] = {}
    for time, message in messages:
        name = message.get("name")
        if name is None:
            continue
        fields = message.get("updates") or message.get("props") or message
        for field, value in fields.items():
            if time == 0.0:
                start[name, field] = value
            elif field not in ("name", "type", "owner"):
                frame = round(time) - 1
                first = start.get((name, field), _REST.get(field))
                frames, values = tracks.setdefault(
                    _Key(message["type"], name, field), ([0], [first])
                )
                if frames[-1] == frame:
                    values[-1] = value
                else:
                    frames.append(frame)
                    values.append(value)
    return tracks


def _pack_track(key: _Key, frames: list[int], values: list[Any], pack: ArrayPack) -> dict[str, Any]:
    """Numbers go into the pack, words and switches into the JSON."""
    track: dict[str, Any] = key._asdict() | {"keys": pack.add(frames)}
    if isinstance(values[-1], list):
        width = len(values[-1])
        rows = [np.broadcast_to(np.asarray(value, dtype=float), width) for value in values]
        return track | {"width": width, "values": pack.add(rows), "smooth": key.field in _SMOOTH}
    return track | {"words": values}


def _build_ghost(finish: look.Finish) -> mechanism.Group:
    return [look.paint(mesh, finish) for mesh in mechanism.build_ghost()]
