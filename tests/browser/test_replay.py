"""An exported run in a real browser: opened from a file, without a network."""

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.conftest import PATIENCE_MS
from tests.scene.replay_page import write_page

pytestmark = pytest.mark.browser


# Half the angle of the link in the 3D view, as its sine.
LINK_IN_3D = """() => document.querySelector("iframe").contentWindow
    .__viserMutable.nodePoseData["/a/l"].wxyz[3]"""
LOAD_IN_3D = """() => document.querySelector("iframe").contentWindow
    .__viserSceneTree.getState()["/a/w"].visibility"""
NOW_LINES = """() => [...document.querySelectorAll(".now")]
    .map((line) => Number.parseFloat(line.style.translate) / line.parentElement.clientWidth)"""


# The values next to the plot of the position, in degrees.
READ = """angles => {
    const shown = [...document.querySelectorAll('[data-plot="position"] output')];
    return shown.length === angles.length && shown.every(({ textContent }, index) =>
        Math.abs(Number(textContent.replace("−", "-")) - angles[index]) <= 0.1);
}"""
# It may end in the meantime, if it plays: there is nothing to stop then.
STOP = """() => {
    const button = document.querySelector(".play");
    if (button.innerText === "Pause") button.click();
}"""


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_page(tmp_path_factory.mktemp("replay"))


class Watch:
    """The requests and console errors of a page."""

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
    """Open the file without network and wait for the 3D view."""
    page.context.set_offline(True)
    watch = Watch(page)
    page.goto(path.as_uri())
    expect(page.locator(".view.is-shown")).to_be_attached()
    return watch


class Opened(NamedTuple):
    """An exported run in a page, and its requests since it was opened."""

    page: Page
    watch: Watch


@pytest.fixture(scope="module")
def opened_once(browser: Browser, exported: Path) -> Iterator[Opened]:
    context = browser.new_context(viewport={"width": 1280, "height": 720}, color_scheme="dark")
    page = context.new_page()
    yield Opened(page, open_file(page, exported))
    context.close()


@pytest.fixture
def opened(opened_once: Opened) -> Opened:
    """The shared page of tests that change its view only, reset to its initial view."""
    page = opened_once.page
    page.keyboard.press("Escape")
    whole = page.get_by_role("button", name="Whole run")
    page.evaluate(STOP)
    expect(page.get_by_role("button", name="Play")).to_be_visible()
    if whole.is_enabled():
        whole.press("Enter")
    page.get_by_role("slider", name="Time").fill("0")
    wait_for_link(page, 0.0)
    return opened_once


def wait_for_link(page: Page, angle_rad: float) -> None:
    page.wait_for_function(f"Math.abs(({LINK_IN_3D})() - {math.sin(angle_rad / 2)}) < 5e-4")


def wait_for_lines(page: Page, share: float, tolerance: float) -> None:
    """Wait until the time line is at this place, 0 to 1, in each of the five plots."""
    page.wait_for_function(
        f"""([share, tolerance]) => {{
            const lines = ({NOW_LINES})();
            return lines.length === 5 && lines.every((x) => Math.abs(x - share) <= tolerance);
        }}""",
        arg=[share, tolerance],
    )


def expect_theme(page: Page, scheme: str) -> None:
    """The theme of the page and of its 3D view."""
    background = page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert (sum(map(int, re.findall(r"\d+", background))) < 200) == (scheme == "dark")
    page.wait_for_function(
        """(dark) => document.querySelector("iframe").contentDocument.documentElement
            .dataset.mantineColorScheme === dark""",
        arg=scheme,
    )


def test_replay_uses_the_dark_theme_of_the_system(opened: Opened) -> None:
    expect_theme(opened.page, "dark")


def test_one_slider_moves_the_3d_view_and_the_plots_together(
    opened: Opened, exported: Path
) -> None:
    page, watch = opened
    scrubber = page.get_by_role("slider", name="Time")
    for time_s, lag in ((1.0, 0.0), (3.0, 0.2), (0.5, 0.0)):
        scrubber.fill(str(time_s))
        expect(page.get_by_role("status", name="Time")).to_have_text(f"{time_s:.2f} s")
        wait_for_lines(page, time_s / 3.999, 2e-3)
        reference = 0.5 * math.sin(2 * math.pi * 0.25 * time_s)
        wait_for_link(page, reference)
        angles = [math.degrees(angle) for angle in (reference, reference - lag, reference)]
        page.wait_for_function(READ, arg=angles)
        page.wait_for_function(f"shown => ({LOAD_IN_3D})() === shown", arg=time_s >= 2.0)
    watch.check(exported)


def take_still(page: Page) -> bytes:
    """Return the 3D picture once it is at rest; it is drawn at least twice a second."""
    view, before = page.locator("iframe"), b""
    for _ in range(PATIENCE_MS // 600):
        now = view.screenshot()
        if now == before:
            return now
        before = now
        page.wait_for_timeout(600)
    raise AssertionError("the picture in 3D never stands still")


def wait_for_another_picture(page: Page, before: bytes) -> None:
    for _ in range(PATIENCE_MS // 600):
        if page.locator("iframe").screenshot() != before:
            return
        page.wait_for_timeout(600)
    raise AssertionError("the picture in 3D stays as it was")


def test_picture_in_3d_changes_with_the_time(opened: Opened, exported: Path) -> None:
    page, watch = opened
    wait_for_link(page, 0.0)
    before = take_still(page)
    page.get_by_role("slider", name="Time").fill("3")
    wait_for_link(page, -0.5)
    wait_for_another_picture(page, before)
    watch.check(exported)


def test_replay_plays_pauses_and_obeys_keys_also_inside_the_3d_view(
    opened: Opened, exported: Path
) -> None:
    page, watch = opened
    read = "svsaReplay.time()"
    # Of the run of 4 s, enough is left when a slow machine presses the next key.
    page.get_by_label("Speed").select_option("0.25")
    page.get_by_role("button", name="Play").click()
    page.wait_for_function(f"{read} > 0.3")
    page.keyboard.press("Space")
    expect(page.get_by_role("button", name="Play")).to_be_visible()
    page.keyboard.press("Home")
    page.wait_for_function(f"{read} === 0")
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
    page.wait_for_function(f"{read} > 0.1")
    watch.check(exported)


def test_click_sets_the_time_and_drag_zooms(opened: Opened) -> None:
    page, _ = opened
    over = page.locator(".u-over").first
    box = over.bounding_box()
    assert box is not None
    over.click(position={"x": box["width"] / 2, "y": box["height"] / 2})
    page.wait_for_function("Math.abs(svsaReplay.time() - 2) < 0.02")
    whole = page.get_by_role("button", name="Whole run")
    expect(whole).to_be_disabled()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] * 0.4, middle)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.6, middle, steps=4)
    page.mouse.up()
    expect(whole).to_be_enabled()
    wait_for_lines(page, 0.5, 0.05)
    whole.click()
    expect(whole).to_be_disabled()


def test_run_describes_itself(opened: Opened, exported: Path) -> None:
    page, watch = opened
    expect(page).to_have_title("A test run")
    expect(page.get_by_text("9.9.9").first).to_be_visible()
    page.get_by_role("button", name="Go to 2.00 s 3 kg load on").click()
    page.wait_for_function("Math.abs(svsaReplay.time() - 2) < 1e-6")
    expect(page.get_by_role("button", name=re.compile("^Go to"))).to_have_count(2)
    row = page.get_by_role("row", name=re.compile("FL"))
    expect(row).to_contain_text("11.5")
    page.get_by_role("button", name="About this run").click()
    expect(page.get_by_role("dialog").get_by_text("inf", exact=True)).to_be_visible()
    watch.check(exported)


def test_translators_leave_the_3d_view_and_its_labels(opened: Opened) -> None:
    view = opened.page.locator("iframe")
    assert view.evaluate("view => view.contentDocument.documentElement.translate") is False
    labels = opened.page.locator("span[data-text]")
    expect(labels.first).to_be_attached()
    assert labels.evaluate_all("labels => labels.filter((label) => label.translate)") == []
