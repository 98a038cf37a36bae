"""The content of the page of a recorded run: curves, events, numbers; no browser is needed."""

import base64
import json
import math
import re
import zlib
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from svsa.actuators.arm.parameters import RODS
from svsa.actuators.installed import get_mechanism
from svsa.errors import ParameterError
from svsa.runs.metrics.metrics import compute_metrics
from svsa.runs.records.measured_window import MeasuredWindow
from svsa.runs.timeline.events import Event
from svsa_scene.arm_pose import TipLoad, Wall
from svsa_scene.pose import LaneSegment
from svsa_scene.replay_curves import decimate, pack_curves
from svsa_scene.replay_motion import record_motion
from svsa_scene.replay_packing import ArrayPack
from svsa_scene.replay_scenes import ReplayArm
from tests.scene.replay_page import CHANNELS, PERIOD_S, make_run, write_page


@pytest.mark.exhaustive
def test_minute_of_two_lanes_is_below_4_megabytes_with_noise(tmp_path: Path) -> None:
    samples, mass = make_run(ticks=60_000)
    noisy = samples + np.random.default_rng(1).normal(0.0, 1e-3, samples.shape)
    path = write_page(tmp_path, samples=noisy, load_mass_kg=mass)
    assert path.stat().st_size < 4_000_000


def test_decimation_keeps_peaks_and_exact_samples() -> None:
    smooth = np.linspace(0.0, 1.0, 1000)
    np.testing.assert_array_equal(decimate(smooth, 7), smooth[::7])
    spiky = smooth.copy()
    spiky[[333, 779]] = 9.0, -9.0
    kept = decimate(spiky, 7)
    assert kept[333 // 7] == 9.0
    assert kept[779 // 7] == -9.0
    assert np.count_nonzero(kept != smooth[::7]) == 2


def unpack(exported: dict, number: int) -> np.ndarray:
    """Decode a curve of a pack as the page does."""
    start, count, step = exported["places"][number]
    data = zlib.decompress(base64.b64decode(exported["data"]))
    planes = np.frombuffer(data, np.uint8, 4 * count, start).reshape(4, count)
    words = np.ascontiguousarray(planes.T).view("<u4").ravel().astype(np.int64)
    whole = np.cumsum((words >> 1) ^ -(words & 1))
    whole = (whole + 2**31) % 2**32 - 2**31
    return np.where(whole == -(2**31), np.nan, whole * step)


def test_curve_is_within_a_pixel_of_every_sample_at_any_zoom() -> None:
    samples, _ = make_run(ticks=60_000)
    noisy = samples + np.random.default_rng(2).normal(0.0, 1e-3, samples.shape)
    noisy[100:200, 1] = np.nan
    pack = ArrayPack()
    curves = pack_curves(noisy, CHANNELS, PERIOD_S, pack)
    assert curves["step_s"] == PERIOD_S
    exported = pack.export()
    least = {"position_rad": math.radians(2), "position_error_rad": math.radians(0.004)}
    for name, height in least.items():
        for lane, number in enumerate(curves["channels"][name]):
            recorded = noisy[:, lane, CHANNELS.index(name)]
            np.testing.assert_allclose(
                unpack(exported, number), recorded, rtol=0, atol=height / 4000
            )


def test_curve_far_from_zero_is_preserved() -> None:
    values = np.array([0.0, 1e6, -1e6, np.inf, 3.0])
    pack = ArrayPack()
    pack.add_curve(values, 1e-8)
    expected = np.where(np.isinf(values), np.nan, values)
    np.testing.assert_allclose(unpack(pack.export(), 0), expected, rtol=0, atol=1e-3)


def test_page_of_a_long_run_has_fewer_samples_and_states_it() -> None:
    samples, _ = make_run(ticks=130_000, lanes=1)
    curves = pack_curves(samples, CHANNELS, PERIOD_S, ArrayPack())
    assert (curves["stride"], curves["step_s"]) == (2, 2 * PERIOD_S)


def test_equal_arrays_are_stored_once() -> None:
    pack = ArrayPack()
    assert [pack.add([1.0, 2.0]), pack.add([3.0]), pack.add([1.0, 2.0])] == [0, 1, 0]
    assert pack.export()["places"] == [(0, 2), (8, 1)]


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"period_s": 0.0}, "period_s"),
        ({"lanes": []}, "lanes"),
        ({"lanes": ["a"] * 5}, "lanes"),
        ({"channels": CHANNELS[:-1]}, "samples.shape"),
        ({"channels": ["x"] * len(CHANNELS)}, "position_rad"),
        ({"samples": np.zeros((0, 2, len(CHANNELS)))}, "samples.shape"),
        ({"load_mass_kg": np.zeros(3)}, "load_mass_kg"),
    ],
)
def test_mismatched_arrays_are_rejected_by_name(changes: dict, named: str, tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match=re.escape(named)):
        write_page(tmp_path, **changes)


def read_run(page: Path) -> dict[str, Any]:
    """Read the run inside a page, which has to be strict JSON."""
    inner = page.read_text(encoding="utf-8").split('id="run">', 1)[1].split("</script>", 1)[0]
    return json.loads(inner, parse_constant=lambda word: pytest.fail(f"{word} in the JSON"))


def test_run_inside_the_page_is_strict_json(tmp_path: Path) -> None:
    assert read_run(write_page(tmp_path))["lanes"] == ["NDOBC", "FL"]


def test_bench_without_a_known_disturbance_is_animated() -> None:
    """Unknown quantities are not drawn; gaps keep the previous state."""
    samples, mass = make_run(ticks=1000, lanes=1)
    lanes = [[LaneSegment("Bench", 0, 1, 0, 1000)]]
    bench = samples.copy()
    bench[:, :, CHANNELS.index("disturbance_link_nm")] = math.nan
    bench[330:333] = math.nan
    counts = []
    for rows in (samples, bench):
        pack = ArrayPack()
        tracks = record_motion(rows, CHANNELS, lanes, PERIOD_S, mass, pack).content["tracks"]
        places = pack.export()["places"]
        assert isinstance(places, list)
        counts.append({(one["name"], one["field"]): places[one["keys"]][1] for one in tracks})
    known, found = counts
    assert max(known.values()) > 20
    assert found.keys() == known.keys()
    assert all(found[track] >= count - 1 for track, count in known.items()), "one frame is left out"


def test_motor_disturbances_are_drawn_as_in_the_live_view() -> None:
    samples, mass = make_run(ticks=1000, lanes=1)
    names = []
    for load_nm in (0.0, 2.0):
        samples[:, :, CHANNELS.index("disturbance_motor1_nm")] = load_nm
        samples[500:, :, CHANNELS.index("disturbance_motor1_nm")] = 0.5 * load_nm
        lanes = [[LaneSegment("A", 0, 1, 0, 1000)]]
        motion = record_motion(samples, CHANNELS, lanes, PERIOD_S, mass, ArrayPack())
        names.append({one["name"] for one in motion.content["tracks"]})
    assert any("w4" in name for name in names[1] - names[0])


def test_events_match_the_samples_in_page_time(tmp_path: Path) -> None:
    ticks = (2999, 3000, 5000, 7000, 7001)
    events = [Event(tick, tick / 1000, "law", f"at {tick}") for tick in ticks]
    run = read_run(write_page(tmp_path, events=events, first_tick=3000))
    assert run["events"] == [
        {"time_s": 0.0, "kind": "law", "label": "at 3000"},
        {"time_s": 2.0, "kind": "law", "label": "at 5000"},
        {"time_s": 4.0, "kind": "law", "label": "at 7000"},
    ]


def test_metrics_belong_to_the_named_window_in_page_time(tmp_path: Path) -> None:
    window = MeasuredWindow("load", "3 kg load", 5000, 6500, 5.0, 6.5, False, ("NDOBC", "FL"))
    run = read_run(write_page(tmp_path, window=window, first_tick=3000))
    assert (run["window"]["start_s"], run["window"]["end_s"]) == (2.0, 3.5)
    assert [lane["duration_s"] for lane in run["metrics"]] == [1.5, 1.5]
    samples, _ = make_run()
    for lane, metrics in enumerate(run["metrics"]):
        assert metrics == asdict(compute_metrics(samples[2000:3500, lane], PERIOD_S))


def test_motion_of_an_arm_has_both_joints_and_the_path_of_the_tip() -> None:
    """The joints turn, the comparison is an arm of its own, and the path is in the scene."""
    samples, _ = make_run(ticks=2000, lanes=4)
    actuator = get_mechanism("svsa").prototype
    segments = [
        [LaneSegment(name, 0, number, 0, 2000)]
        for number, name in enumerate(("Joint 1 FL", "Joint 2 FL", "Joint 1 PD", "Joint 2 PD"))
    ]
    loaded = TipLoad(mass_kg=0.3, force_n=(3.0, 4.0), wall=Wall(math.pi, 0.2))
    arm = ReplayArm(RODS, [actuator] * 2, [(0, TipLoad()), (1000, loaded)])
    no_mass = np.zeros(len(samples))
    motion = record_motion(
        samples, CHANNELS, segments, PERIOD_S, no_mass, ArrayPack(), actuator, arm
    )
    turned = {track["name"] for track in motion.content["tracks"] if track["field"] == "wxyz"}
    assert {"/a/l", "/a/l/2/l", "/a/g", "/a/g/2", "/a/r", "/a/r/2"} <= turned
    seen = {
        track["name"]: track["words"]
        for track in motion.content["tracks"]
        if track["field"] == "visible"
    }
    for node in ("/a/w", "/a/f", "/a/wall"):
        assert seen[node] == [False, True]
    names = {track["name"] for track in motion.content["tracks"]}
    assert "/a/t" not in names


def test_page_of_an_arm_has_its_links(tmp_path: Path) -> None:
    actuator = get_mechanism("svsa").prototype
    page = write_page(
        tmp_path,
        ("Joint 1 FL", "Joint 2 FL"),
        actuator=actuator,
        arm=ReplayArm(RODS, [actuator] * 2),
    )
    assert read_run(page)["arm"]["chain"][0]["length_m"] == RODS.chain[0].length_m
    assert read_run(write_page(tmp_path))["arm"] is None
