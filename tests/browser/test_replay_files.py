"""Exported runs of every kind, each opened from its own file in a real browser."""

from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from svsa.runs.timeline.events import Event
from tests.browser.test_replay import expect_theme, open_file
from tests.scene.replay_page import CHANNELS, make_run, write_page

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page")]

CURVE = """plot => {
    const canvas = plot.querySelector("canvas");
    const { width, height } = canvas;
    const pixels = canvas.getContext("2d").getImageData(0, 0, width, height).data;
    const middles = [];
    for (let x = Math.round(width * 0.3); x < width * 0.8; x++) {
        let weight = 0, sum = 0;
        for (let y = 0; y < height; y++) {
            const [red, , blue, alpha] = pixels.subarray(4 * (y * width + x));
            const color = blue - red > 60 ? alpha : 0;
            weight += color;
            sum += color * y;
        }
        middles.push(sum / weight);
    }
    return middles;
}"""


IS_DRAWN = f"""() => ({CURVE})(document.querySelector('[data-plot="position"]'))
    .every(Number.isFinite)"""


@pytest.mark.exhaustive
def test_slow_curve_is_smooth(page: Page, tmp_path: Path) -> None:
    """A rise of 40 pixels over some hundreds is drawn with an accuracy of a fifth of a pixel."""
    samples, mass = make_run(ticks=50, lanes=1)
    samples[:, :, CHANNELS.index("position_rad")] = np.linspace(0.0, 0.02, 50)[:, None]
    samples[:, :, CHANNELS.index("position_reference_rad")] = np.nan
    path = write_page(tmp_path, ("FL",), samples=samples, load_mass_kg=mass)
    open_file(page, path)
    plot = page.locator('[data-plot="position"]')
    page.wait_for_function(IS_DRAWN)
    middles = plot.evaluate(CURVE)
    across = np.arange(len(middles))
    assert np.ptp(middles) > 15
    line = np.polyval(np.polyfit(across, middles, 1), across)
    assert np.std(middles - line) < 0.1


@pytest.mark.exhaustive
def test_run_of_the_emulated_rig_is_marked(page: Page, tmp_path: Path) -> None:
    open_file(page, write_page(tmp_path, plant="emulated"))
    expect(page.get_by_text("EMULATED", exact=True)).to_be_visible()


@pytest.mark.exhaustive
def test_replay_uses_the_light_theme_of_the_system(page: Page, tmp_path: Path) -> None:
    open_file(page, write_page(tmp_path))
    expect_theme(page, "light")


def test_html_in_names_is_escaped(page: Page, tmp_path: Path) -> None:
    evil = "</script><script>window.bad=1</script><img src=x onerror='window.bad=1'>\ud800"
    path = write_page(
        tmp_path,
        lanes=(evil, "<b>FL</b>", "😀" * 100, ""),
        title=evil,
        details={evil: evil},
        events=[Event(10, 0.01, "load_on", evil)],
    )
    watch = open_file(page, path)
    assert page.evaluate("window.bad") is None
    watch.check(path)


@pytest.mark.exhaustive
def test_runs_of_one_tick_and_with_gaps_still_open(page: Page, tmp_path: Path) -> None:
    short, _ = make_run(ticks=1, lanes=1)
    holes, mass = make_run(lanes=1)
    holes[1000:2000] = np.nan
    for name, samples, load in (("short", short, None), ("holes", holes, mass)):
        (tmp_path / name).mkdir()
        path = write_page(tmp_path / name, ("FL",), samples=samples, load_mass_kg=load)
        watch = open_file(page, path)
        page.keyboard.press("End")
        watch.check(path)
