"""A recorded run as one HTML page: 3D and plots on one time axis, opened from a file.

The page is built together with the lab's page (`frontend/web/src/runs/replay`); this module inserts
the run. The page makes no network requests, and its content security policy forbids them.
"""

import html
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from svsa.actuators.parameters import MechanismParameters
from svsa.errors import ParameterError, SvsaError, Violation
from svsa.runs.records.measured_window import MeasuredWindow
from svsa.runs.timeline.events import Event
from svsa_scene.pose import POSE_CHANNELS, LaneSegment
from svsa_scene.replay_curves import compute_metrics, pack_curves
from svsa_scene.replay_motion import record_motion
from svsa_scene.replay_packing import ArrayPack
from svsa_scene.replay_policy import REPLAY_POLICY
from svsa_scene.replay_scenes import ReplayArm

MAX_LANES = 4

_TITLE_MARK = "REPLAY_TITLE"
_RUN_MARK = '"REPLAY_RUN"'


class ReplayError(SvsaError):
    """The page cannot be built; the message contains the reason."""


def build_replay_html(
    title: str,
    period_s: float,
    lanes: list[str],
    channels: list[str],
    samples: np.ndarray,
    load_mass_kg: np.ndarray | None,
    details: dict[str, Any],
    *,
    events: Iterable[Event] = (),
    first_tick: int = 0,
    segments: Sequence[Sequence[LaneSegment]] | None = None,
    window: MeasuredWindow | None = None,
    actuator: MechanismParameters | None = None,
    arm: ReplayArm | None = None,
    plant: str = "simulated",
) -> str:
    """Build the page of a run; takes some seconds and starts viser on a loopback port: call it in a
    thread.

    Args:
        title: Heading, any text.
        period_s: Control period, s.
        lanes: 1–4 names; the first is drawn as the actuator, the others as outlines of their links.
            Of an arm those of its joints, then those of the comparison.
        channels: Names as in `svsa.actuators.signals.CHANNELS`, at least those of a pose; others
            are left out.
        samples: float64 (ticks, lanes, channels), SI.
        load_mass_kg: Hanging mass at every tick, (ticks,), kg; None for none. That of an arm is in
            its `loads`.
        details: Information about the run by label (JSON); the first simple values are in the
            header.
        events: Events, marked on the plots if they are within these samples.
        first_tick: Tick of the first sample, as in events and window; the page's time begins there
            at 0.
        segments: Controllers of every lane, in order; by default one per lane under its name.
        window: Window of the metrics; by default the whole run.
        actuator: Parameters of the plant, which name the actuator; by default the SVSA.
        arm: The arm whose joint 1 has this actuator; None for a single joint.
        plant: "simulated", "emulated" or "bench".

    Returns:
        The HTML.

    Raises:
        ParameterError: If arrays do not fit.
        ReplayError: If the page was not built.
    """
    samples = np.asarray(samples, dtype=np.float64)
    mass = np.zeros(len(samples)) if load_mass_kg is None else np.asarray(load_mass_kg, float)
    _check(period_s, lanes, channels, samples, mass)
    mass = np.nan_to_num(mass, nan=0.0, posinf=0.0, neginf=0.0)
    template = _read_template()
    pack = ArrayPack()
    curves = pack_curves(samples, channels, period_s, pack)
    if segments is None:
        whole = len(samples)
        segments = [[LaneSegment(name, i, i + 1, 0, whole)] for i, name in enumerate(lanes)]
    if window is None:
        end = first_tick + len(samples)
        times = first_tick * period_s, end * period_s
        window = MeasuredWindow("start", "", first_tick, end, *times, True, tuple(lanes))
    motion = record_motion(samples, channels, segments, period_s, mass, pack, actuator, arm)
    run = {
        "title": title,
        "period_s": period_s,
        "ticks": len(samples),
        "lanes": lanes,
        "arm": arm and arm.links.model_dump(mode="json"),
        "segments": [[_write_segment(one, period_s) for one in lane] for lane in segments],
        "plant": plant,
        "details": details,
        "events": [
            _write_event(event, period_s, first_tick)
            for event in events
            if 0 <= event.tick - first_tick <= len(samples)
        ],
        "window": _write_window(window, period_s, first_tick),
        "metrics": compute_metrics(
            samples[window.first_tick - first_tick : window.end_tick - first_tick],
            channels,
            period_s,
            window,
        ),
        "curves": curves,
        "motion": motion.content,
        "arrays": pack.export(),
        "scene": motion.html,
    }
    return _fill(template, title, _write_json(run))


def _write_window(window: MeasuredWindow, period_s: float, first_tick: int) -> dict[str, Any]:
    """In the page's time, which begins at 0."""
    return asdict(window) | {
        "start_s": (window.first_tick - first_tick) * period_s,
        "end_s": (window.end_tick - first_tick) * period_s,
    }


def _write_event(event: Event, period_s: float, first_tick: int) -> dict[str, Any]:
    time_s = (event.tick - first_tick) * period_s
    return {"time_s": time_s, "kind": event.kind, "label": event.label}


def _write_segment(segment: LaneSegment, period_s: float) -> dict[str, Any]:
    return {
        "number": segment.number,
        "name": segment.name,
        "line_style": segment.line_style,
        "has_estimate": segment.has_estimate,
        "start_s": segment.first * period_s,
        "end_s": segment.end * period_s,
    }


def _check(
    period_s: float,
    lanes: Sequence[str],
    channels: Sequence[str],
    samples: npt.NDArray[np.float64],
    mass: npt.NDArray[np.float64],
) -> None:
    wrong: list[Violation] = []
    if not (math.isfinite(period_s) and period_s > 0):
        wrong.append(Violation("period_s", period_s, "s", "above 0"))
    if not 1 <= len(lanes) <= MAX_LANES:
        wrong.append(Violation("lanes", len(lanes), "", f"1 to {MAX_LANES} lanes"))
    missing = [name for name in POSE_CHANNELS if name not in channels]
    if missing:
        wrong.append(Violation("channels", list(channels), "", f"with {', '.join(missing)}"))
    if samples.ndim != 3 or samples.shape[1:] != (len(lanes), len(channels)) or not len(samples):
        bound = f"(at least 1, {len(lanes)}, {len(channels)}): ticks, lanes, channels"
        wrong.append(Violation("samples.shape", samples.shape, "", bound))
    elif mass.shape != samples.shape[:1]:
        wrong.append(Violation("load_mass_kg.shape", mass.shape, "", f"({len(samples)},)"))
    if wrong:
        raise ParameterError(*wrong)


def _read_template() -> str:
    """The folder of the built replay page, found without importing the server."""
    server = find_spec("svsa_server")
    folders = server.submodule_search_locations if server else None
    for folder in folders or ():
        path = Path(folder) / "page" / "replay.html"
        if path.is_file():
            return path.read_text(encoding="utf-8")
    raise ReplayError("The page of a replay was not built: run `make page`.")


def _fill(template: str, title: str, run: str) -> str:
    policy = f'<meta http-equiv="Content-Security-Policy" content="{REPLAY_POLICY}" />'
    head, _, rest = template.partition("<head>")
    before, _, rest = rest.partition(_TITLE_MARK)
    middle, mark, end = rest.partition(_RUN_MARK)
    if not mark:
        raise ReplayError("The page of a replay is not the one of this version: run `make page`.")
    words = html.escape(title.encode("utf-8", "replace").decode("utf-8"))
    return "".join([head, "<head>", policy, before, words, middle, run, end])


def _write_json(run: Mapping[str, Any]) -> str:
    """Encode JSON for use inside a <script>: no part of it can end the element."""
    text = json.dumps(_to_json(run), allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c")


def _to_json(value: Any) -> Any:
    """The value with what JSON does not know as text: infinities, dates, paths."""
    match value:
        case None | bool() | str():
            return value
        case int() | np.integer():
            return int(value)
        case float() | np.floating():
            return float(value) if math.isfinite(value) else str(value)
        case Mapping():
            return {str(key): _to_json(inner) for key, inner in value.items()}
        case list() | tuple() | np.ndarray():
            return [_to_json(inner) for inner in value]
        case _:
            return str(value)
