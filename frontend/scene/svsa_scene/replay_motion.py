"""The 3D view of a replay: viser's page with the scene in it, and its motion as tracks.

The live scene is built and moved once through the run; the messages that it sends are the replay.
They are stored separately from the scene, property by property, so that the page can show any
instant without replaying earlier ones.
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
from svsa_scene.pose import LaneSegment
from svsa_scene.replay_packing import ArrayPack
from svsa_scene.replay_scenes import ActuatorReplay, ArmReplay, RecordedSamples, ReplayArm

RATE_HZ = 30.0
MAX_FRAMES = 5400
_REST = {"wxyz": (1.0, 0.0, 0.0, 0.0), "position": (0.0, 0.0, 0.0), "visible": True}
_SMOOTH = ("wxyz", "position", "scale")


class Motion(NamedTuple):
    """`html`: the scene as a page. `content`: the parts that the replay moves, for JSON."""

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
    arm: ReplayArm | None = None,
) -> Motion:
    """Record the lanes as `ActuatorReplay` shows them, or as `ArmReplay` those of an arm.

    `parameters` are those of the plant, which name the actuator; by default those of the SVSA. 30
    frames per second of the run, fewer if that would exceed `MAX_FRAMES`.
    """
    stride = max(1, round(1.0 / (RATE_HZ * period_s)), math.ceil(len(samples) / MAX_FRAMES))
    recorded = RecordedSamples(samples, channels, lanes, load_mass_kg)
    with _start_viser() as server:
        shown = _build_replay(server, recorded, parameters, arm)
        html = _hide_viser_controls(server.get_scene_serializer().as_html())
        recording = server.get_scene_serializer()
        for tick in range(0, len(samples), stride):
            recording.insert_sleep(1.0)
            shown.show(tick)
        recording.insert_sleep(1.0)
        shown.scene.set_theme(dark=True)
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


def _build_replay(
    server: viser.ViserServer,
    samples: RecordedSamples,
    parameters: MechanismParameters | None,
    arm: ReplayArm | None,
) -> ActuatorReplay | ArmReplay:
    if arm is None or parameters is None:
        return ActuatorReplay(server, samples, parameters)
    return ArmReplay(server, samples, arm)


@contextlib.contextmanager
def _start_viser() -> Iterator[viser.ViserServer]:
    with contextlib.redirect_stdout(io.StringIO()):
        server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    try:
        yield server
    finally:
        with contextlib.redirect_stdout(io.StringIO()):
            server.stop()


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
