"""What stands in the page of a recorded run: curves, events, numbers; no browser is needed."""

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

from svsa.errors import ParameterError
from svsa.runs.events import Event
from svsa.runs.metrics import compute_metrics
from svsa.runs.records.measured_window import MeasuredWindow
from svsa_scene.pose import LaneSegment
from svsa_scene.replay_curves import decimate, pack_curves
from svsa_scene.replay_motion import record_motion
from svsa_scene.replay_packing import ArrayPack
from tests.scene.replay_page import CHANNELS, PERIOD_S, make_run, write_page


@pytest.mark.exhaustive
def test_a_minute_of_two_lanes_is_below_4_megabytes_even_with_noise(tmp_path: Path) -> None:
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
    """A curve of a pack, as the page reads it."""
    start, count, step = exported["places"][number]
    data = zlib.decompress(base64.b64decode(exported["data"]))
    planes = np.frombuffer(data, np.uint8, 4 * count, start).reshape(4, count)
    words = np.ascontiguousarray(planes.T).view("<u4").ravel().astype(np.int64)
    whole = np.cumsum((words >> 1) ^ -(words & 1))
    whole = (whole + 2**31) % 2**32 - 2**31
    return np.where(whole == -(2**31), np.nan, whole * step)


def test_a_curve_has_every_sample_closer_than_a_pixel_of_any_zoom() -> None:
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


def test_a_curve_far_off_its_axis_is_still_that_curve() -> None:
    values = np.array([0.0, 1e6, -1e6, np.inf, 3.0])
    pack = ArrayPack()
    pack.add_curve(values, 1e-8)
    expected = np.where(np.isinf(values), np.nan, values)
    np.testing.assert_allclose(unpack(pack.export(), 0), expected, rtol=0, atol=1e-3)


def test_of_a_long_run_the_page_has_fewer_samples_and_says_so() -> None:
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
def test_arrays_that_do_not_fit_are_refused_by_name(
    changes: dict, named: str, tmp_path: Path
) -> None:
    with pytest.raises(ParameterError, match=re.escape(named)):
        write_page(tmp_path, **changes)


def read_run(page: Path) -> dict[str, Any]:
    """The run inside a page, which has to be strict JSON."""
    inner = page.read_text(encoding="utf-8").split('id="run">', 1)[1].split("</script>", 1)[0]
    return json.loads(inner, parse_constant=lambda word: pytest.fail(f"{word} in the JSON"))


def test_the_run_inside_the_page_is_strict_json(tmp_path: Path) -> None:
    assert read_run(write_page(tmp_path))["lanes"] == ["NDOBC", "FL"]


def test_a_bench_that_does_not_know_its_disturbance_moves_all_the_same() -> None:
    """Nothing is drawn of what is not known; where nothing is known, what was before stays."""
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


def test_what_acts_on_the_motors_is_drawn_as_it_is_in_the_live_view() -> None:
    samples, mass = make_run(ticks=1000, lanes=1)
    names = []
    for load_nm in (0.0, 2.0):
        samples[:, :, CHANNELS.index("disturbance_motor1_nm")] = load_nm
        samples[500:, :, CHANNELS.index("disturbance_motor1_nm")] = 0.5 * load_nm
        lanes = [[LaneSegment("A", 0, 1, 0, 1000)]]
        motion = record_motion(samples, CHANNELS, lanes, PERIOD_S, mass, ArrayPack())
        names.append({one["name"] for one in motion.content["tracks"]})
    assert any("w4" in name for name in names[1] - names[0])


def test_its_events_are_those_of_its_samples_in_its_own_time(tmp_path: Path) -> None:
    ticks = (2999, 3000, 5000, 7000, 7001)
    events = [Event(tick, tick / 1000, "law", f"at {tick}") for tick in ticks]
    run = read_run(write_page(tmp_path, events=events, first_tick=3000))
    assert run["events"] == [
        {"time_s": 0.0, "kind": "law", "label": "at 3000"},
        {"time_s": 2.0, "kind": "law", "label": "at 5000"},
        {"time_s": 4.0, "kind": "law", "label": "at 7000"},
    ]


def test_its_numbers_are_of_the_window_that_it_names_in_its_own_time(tmp_path: Path) -> None:
    window = MeasuredWindow("load", "3 kg load", 5000, 6500, 5.0, 6.5, False, ("NDOBC", "FL"))
    run = read_run(write_page(tmp_path, window=window, first_tick=3000))
    assert (run["window"]["start_s"], run["window"]["end_s"]) == (2.0, 3.5)
    assert [lane["duration_s"] for lane in run["metrics"]] == [1.5, 1.5]
    samples, _ = make_run()
    for lane, metrics in enumerate(run["metrics"]):
        assert metrics == asdict(compute_metrics(samples[2000:3500, lane], PERIOD_S))
