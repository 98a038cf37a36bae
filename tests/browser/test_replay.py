"""An exported run in a real browser: opened from a file, with no network at all."""

import base64
import json
import math
import re
import zlib
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import BrowserContext, Page, expect

from svsa.errors import ParameterError
from svsa.signals import CHANNEL_NAMES
from svsa_scene.replay import build_replay_html
from svsa_scene.replay_curves import decimate, list_events, pack_curves
from svsa_scene.replay_packing import ArrayPack

PATIENCE_MS = 60_000
PERIOD_S = 0.001
CHANNELS = list(CHANNEL_NAMES)

# Half the angle of the link as the 3D view has it, sin of it.
LINK_IN_3D = """() => document.querySelector("iframe").contentWindow
    .__viserMutable.nodePoseData["/a/l"].wxyz[3]"""
LOAD_IN_3D = """() => document.querySelector("iframe").contentWindow
    .__viserSceneTree.getState()["/a/w"].visibility"""
NOW_LINES = """() => [...document.querySelectorAll(".now")]
    .map((line) => Number.parseFloat(line.style.translate) / line.parentElement.clientWidth)"""


def make_run(ticks: int = 4000, lanes: int = 2) -> tuple[np.ndarray, np.ndarray]:
    """A sine of 0.5 rad at 0.25 Hz, the second lane 0.2 rad behind from 2 s on, with 3 kg."""
    time = np.arange(ticks) * PERIOD_S
    samples = np.zeros((ticks, lanes, len(CHANNELS)))

    def put(name: str, values: np.ndarray | float) -> None:
        samples[:, :, CHANNELS.index(name)] = np.broadcast_to(values, (lanes, ticks)).T

    reference = 0.5 * np.sin(2 * np.pi * 0.25 * time)
    error = np.arange(lanes)[:, None] * np.where(time >= 2.0, 0.2, 0.0)
    put("time_s", time)
    put("position_reference_rad", reference)
    put("position_rad", reference - error)
    put("position_error_rad", error)
    put("motor1_position_rad", reference - error)
    put("lever_ratio", 0.5)
    put("stiffness_nm_per_rad", 20.0)
    put("stiffness_reference_nm_per_rad", 20.0)
    put("deflection_limit_rad", 0.4)
    return samples, np.where(time >= 2.0, 3.0, 0.0)


def write_page(folder: Path, lanes: tuple[str, ...] = ("NDOBC", "FL"), **changes: object) -> Path:
    samples, mass = make_run(lanes=len(lanes))
    arguments = {
        "title": "A test run",
        "period_s": PERIOD_S,
        "lanes": list(lanes),
        "channels": CHANNELS,
        "samples": samples,
        "load_mass_kg": mass,
        "details": {
            "version": "9.9.9",
            "configuration": {"law": "ndobc", "end_s": math.inf},
            "commands": [{"tick": 1000, "kind": "gains"}, (2000, {"kind": "load"})],
        },
    }
    path = folder / "run.html"
    path.write_text(build_replay_html(**(arguments | changes)), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_page(tmp_path_factory.mktemp("replay"))


class Watch:
    """What a page asks of the network, and what it complains about."""

    def __init__(self, page: Page) -> None:
        self.requests: list[str] = []
        self.errors: list[str] = []
        page.on("request", lambda request: self.requests.append(request.url[:200]))
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on(
            "console",
            lambda message: self.errors.append(message.text) if message.type == "error" else None,
        )

    def check(self, path: Path) -> None:
        asked = [url for url in self.requests if not url.startswith(("data:", "blob:"))]
        assert asked == [path.as_uri()]
        assert self.errors == []


def open_file(page: Page, path: Path) -> Watch:
    """Open the file without network and wait until the 3D view stands."""
    page.context.set_offline(True)
    watch = Watch(page)
    page.goto(path.as_uri())
    expect(page.locator(".view.is-shown")).to_be_attached(timeout=PATIENCE_MS)
    return watch


def wait_for_link(page: Page, angle_rad: float) -> None:
    page.wait_for_function(
        f"Math.abs(({LINK_IN_3D})() - {math.sin(angle_rad / 2)}) < 5e-4", timeout=PATIENCE_MS
    )


@pytest.mark.browser
def test_one_scrubber_moves_the_3d_view_and_the_plots_together(page: Page, exported: Path) -> None:
    watch = open_file(page, exported)
    scrubber = page.get_by_role("slider", name="Time")
    position = page.get_by_role("region", name="Position", exact=True)
    for time_s, lag in ((1.0, 0.0), (3.0, 0.2), (0.5, 0.0)):
        scrubber.fill(str(time_s))
        expect(page.get_by_role("status", name="Time")).to_have_text(f"{time_s:.2f} s")
        lines = page.evaluate(NOW_LINES)
        assert len(lines) == 5
        assert lines == pytest.approx([time_s / 3.999] * 5, abs=2e-3)
        reference = 0.5 * math.sin(2 * math.pi * 0.25 * time_s)
        wait_for_link(page, reference)
        readings = [
            float(text.replace("−", "-")) for text in position.locator("output").all_text_contents()
        ]
        assert readings == pytest.approx(
            [math.degrees(reference), math.degrees(reference - lag), math.degrees(reference)],
            abs=0.1,
        )
        assert page.evaluate(LOAD_IN_3D) is (time_s >= 2.0)
    watch.check(exported)


@pytest.mark.browser
def test_the_picture_in_3d_changes_with_the_time(page: Page, exported: Path) -> None:
    watch = open_file(page, exported)
    view = page.locator("iframe")
    page.wait_for_timeout(1500)
    before = view.screenshot()
    page.get_by_role("slider", name="Time").fill("3")
    wait_for_link(page, -0.5)
    page.wait_for_timeout(1500)
    assert view.screenshot() != before
    watch.check(exported)


@pytest.mark.browser
def test_it_plays_pauses_and_obeys_keys_also_from_inside_the_3d_view(
    page: Page, exported: Path
) -> None:
    watch = open_file(page, exported)
    read = "svsaReplay.time()"
    page.get_by_role("button", name="Play").click()
    page.wait_for_function(f"{read} > 0.3", timeout=PATIENCE_MS)
    page.keyboard.press("Space")
    expect(page.get_by_role("button", name="Play")).to_be_visible()
    page.keyboard.press("Home")
    assert page.evaluate(read) == 0.0
    page.keyboard.press("ArrowRight")
    assert page.evaluate(read) == pytest.approx(0.033)
    page.keyboard.press("Shift+ArrowRight")
    assert page.evaluate(read) == pytest.approx(1.033)
    page.keyboard.press("End")
    assert page.evaluate(read) == pytest.approx(3.999)
    page.locator("iframe").click(position={"x": 5, "y": 5})
    page.keyboard.press("Home")
    page.wait_for_function(f"{read} === 0")
    page.keyboard.press("Space")
    page.wait_for_function(f"{read} > 0.1", timeout=PATIENCE_MS)
    watch.check(exported)


@pytest.mark.browser
def test_a_click_goes_there_and_a_drag_zooms(page: Page, exported: Path) -> None:
    open_file(page, exported)
    over = page.locator(".u-over").first
    box = over.bounding_box()
    assert box is not None
    over.click(position={"x": box["width"] / 2, "y": box["height"] / 2})
    assert page.evaluate("svsaReplay.time()") == pytest.approx(2.0, abs=0.02)
    whole = page.get_by_role("button", name="Whole run")
    expect(whole).to_be_disabled()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] * 0.4, middle)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.6, middle, steps=4)
    page.mouse.up()
    expect(whole).to_be_enabled()
    assert page.evaluate(NOW_LINES) == pytest.approx([0.5] * 5, abs=0.05)
    whole.click()
    expect(whole).to_be_disabled()


CURVE = """plot => {
    const canvas = plot.querySelector("canvas");
    const { width, height } = canvas;
    const pixels = canvas.getContext("2d").getImageData(0, 0, width, height).data;
    const middles = [];
    for (let x = Math.round(width * 0.3); x < width * 0.8; x++) {
        let weight = 0, sum = 0;
        for (let y = 0; y < height; y++) {
            const [red, , blue, alpha] = pixels.subarray(4 * (y * width + x));
            const ink = blue - red > 60 ? alpha : 0;
            weight += ink;
            sum += ink * y;
        }
        middles.push(sum / weight);
    }
    return middles;
}"""


@pytest.mark.browser
def test_a_slow_curve_is_no_stairs(page: Page, tmp_path: Path) -> None:
    """A rise of 40 pixels over some hundreds, drawn between whole pixels: to a fifth of one."""
    samples, mass = make_run(ticks=50, lanes=1)
    samples[:, :, CHANNELS.index("position_rad")] = np.linspace(0.0, 0.02, 50)[:, None]
    samples[:, :, CHANNELS.index("position_reference_rad")] = np.nan
    path = write_page(tmp_path, ("FL",), samples=samples, load_mass_kg=mass)
    open_file(page, path)
    middles = page.locator('[data-plot="position"]').evaluate(CURVE)
    across = np.arange(len(middles))
    assert np.ptp(middles) > 15
    line = np.polyval(np.polyfit(across, middles, 1), across)
    assert np.std(middles - line) < 0.1


@pytest.mark.browser
def test_the_run_tells_about_itself(page: Page, exported: Path) -> None:
    watch = open_file(page, exported)
    expect(page).to_have_title("A test run")
    expect(page.get_by_text("9.9.9").first).to_be_visible()
    page.get_by_role("button", name="Go to 2.00 s 3 kg on").click()
    assert page.evaluate("svsaReplay.time()") == pytest.approx(2.0)
    expect(page.get_by_role("button", name=re.compile("^Go to"))).to_have_count(2)
    row = page.get_by_role("row", name=re.compile("FL"))
    expect(row).to_contain_text("11.5")
    page.get_by_role("button", name="About this run").click()
    expect(page.get_by_role("dialog").get_by_text("inf", exact=True)).to_be_visible()
    watch.check(exported)


@pytest.mark.browser
def test_a_run_of_the_emulated_rig_is_marked(page: Page, tmp_path: Path) -> None:
    open_file(page, write_page(tmp_path, details={"plant": "emulated"}))
    expect(page.get_by_text("EMULATED", exact=True)).to_be_visible()


@pytest.mark.browser
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_takes_the_theme_of_the_system(page: Page, exported: Path, scheme: str) -> None:
    page.emulate_media(color_scheme=scheme)  # pyright: ignore[reportArgumentType]
    open_file(page, exported)
    background = page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert (sum(map(int, re.findall(r"\d+", background))) < 200) == (scheme == "dark")
    page.wait_for_function(
        """(dark) => document.querySelector("iframe").contentDocument.documentElement
            .dataset.mantineColorScheme === dark""",
        arg=scheme,
    )


@pytest.mark.browser
def test_hostile_words_are_only_words(page: Page, tmp_path: Path) -> None:
    evil = "</script><script>window.bad=1</script><img src=x onerror='window.bad=1'>\ud800"
    path = write_page(
        tmp_path,
        lanes=(evil, "<b>FL</b>", "😀" * 100, ""),
        title=evil,
        details={evil: evil, "commands": [{"tick": 10, "label": evil}, 7, {"tick": math.nan}]},
    )
    watch = open_file(page, path)
    assert page.evaluate("window.bad") is None
    watch.check(path)


@pytest.mark.browser
def test_a_run_of_one_tick_and_one_of_holes_still_open(
    context: BrowserContext, tmp_path: Path
) -> None:
    short, _ = make_run(ticks=1, lanes=1)
    holes, mass = make_run(lanes=1)
    holes[1000:2000] = np.nan
    for name, samples, load in (("short", short, None), ("holes", holes, mass)):
        (tmp_path / name).mkdir()
        path = write_page(tmp_path / name, ("FL",), samples=samples, load_mass_kg=load)
        page = context.new_page()
        watch = open_file(page, path)
        page.keyboard.press("End")
        watch.check(path)
        page.close()


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


def test_events_are_mass_changes_and_commands_and_one_fact_is_told_once() -> None:
    mass = np.array([0.0, 0.0, 3.0, 3.0, 0.0])
    commands = [
        {"tick": 102, "kind": "load", "argument": {"kind": "paper"}},
        [101, {"kind": "gains"}],
        {"tick": 103, "label": "my_mark"},
        {"tick": 3, "kind": "gains"},
        {"tick": 199, "kind": "gains"},
    ]
    assert list_events(mass, {"commands": commands}, 100) == [
        (1, "Gains changed"),
        (2, "3 kg on"),
        (3, "my mark"),
        (4, "3 kg off"),
    ]


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


def test_the_run_inside_the_page_is_strict_json(exported: Path) -> None:
    page = exported.read_text(encoding="utf-8")
    inner = page.split('id="run">', 1)[1].split("</script>", 1)[0]
    run = json.loads(inner, parse_constant=lambda word: pytest.fail(f"{word} in the JSON"))
    assert run["lanes"] == ["NDOBC", "FL"]
