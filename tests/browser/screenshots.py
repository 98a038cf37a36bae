"""Pictures of the page for the README: `make screenshots` starts a lab and takes them."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Literal

from PIL import Image
from playwright.sync_api import Browser, Page, expect, sync_playwright

from tests.browser.conftest import ARGUMENTS, RETURNING, find_chromium
from tests.lab import Lab, run_lab

FOLDER = Path(__file__).parents[2] / "frontend" / "screenshots"
COLORS = 256
SETTLE_MS = 3000


def compare(lab: Lab, seconds: float = 9.0) -> None:
    """FL and NDOBC, until this time of Figure 4A."""
    lab.load_figure()
    lab.client.put(lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]}).raise_for_status()
    lab.jump(seconds)
    lab.client.post(lab.session + "/start").raise_for_status()


def hang_load(page: Page, before_ms: int, after_ms: int) -> None:
    """Hang 3 kg and wait until the effect is visible."""
    page.wait_for_timeout(before_ms)
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    page.wait_for_timeout(after_ms)


def show_dashboard(page: Page, lab: Lab) -> None:
    """FL and NDOBC 4 s after the 3 kg load."""
    compare(lab)
    page.goto(lab.url)
    hang_load(page, 6000, 4000)


def show_cursors(page: Page, lab: Lab) -> None:
    """The same, measured between two cursors after the load."""
    compare(lab, 2.0)
    page.goto(lab.url)
    hang_load(page, 1000, 14000)
    page.get_by_role("button", name="Cursors").click()


def show_design(page: Page, lab: Lab) -> None:
    """Poles on the s-plane with their predicted effect."""
    compare(lab)
    page.goto(lab.url)
    page.get_by_role("button", name="Place poles").click()
    page.get_by_role("spinbutton", name=re.compile("^Position")).first.fill("45")
    page.keyboard.press("Enter")
    page.get_by_text("Predicted effect").wait_for()
    expect(page.get_by_text("Computing…")).to_have_count(0)


def show_overlay(page: Page, lab: Lab) -> None:
    """An overlay of two recorded runs, aligned at their load."""
    for stiffness in (15, 60):
        compare(lab, 3)
        reference = {"kind": "constant", "stiffness_nm_per_rad": stiffness}
        lab.client.put(lab.session + "/stiffness", json=reference).raise_for_status()
        lab.client.post(lab.session + "/pause").raise_for_status()
        name = {"name": f"{stiffness} N·m/rad"}
        lab.client.post(lab.session + "/recording", json=name).raise_for_status()
        lab.jump(3)
        lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
        lab.jump(4)
        lab.client.delete(lab.session + "/recording").raise_for_status()
    page.goto(lab.url + "/?runs=all")
    choices = page.get_by_role("checkbox", name=re.compile("^Choose"))
    choices.nth(1).wait_for()
    for choice in choices.all():
        choice.check()
    page.get_by_role("button", name=re.compile("^Overlay")).click()


def show_ranking(page: Page, lab: Lab) -> None:
    """The table of laws."""
    page.goto(lab.url + "/?ranking=all")
    page.get_by_role("heading", name="Position error against stiffness error").wait_for()


def take(
    browser: Browser,
    lab: Lab,
    name: str,
    show: Callable[[Page, Lab], None],
    schemes: tuple[Literal["light", "dark"], ...] = ("light",),
) -> None:
    """Take a picture in each color scheme, small enough for version control."""
    for scheme in schemes:
        context = browser.new_context(viewport={"width": 1280, "height": 720}, color_scheme=scheme)
        page = context.new_page()
        page.add_init_script(RETURNING)
        show(page, lab)
        page.wait_for_timeout(SETTLE_MS)
        path = FOLDER / f"{name}-{scheme}.png"
        page.screenshot(path=path)
        context.close()
        Image.open(path).convert("RGB").quantize(COLORS).save(path, optimize=True)


def take_screenshots() -> None:
    """Take every picture of the README."""
    FOLDER.mkdir(exist_ok=True)
    with run_lab() as lab, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=find_chromium(), args=ARGUMENTS)
        take(browser, lab, "dashboard", show_dashboard, ("light", "dark"))
        take(browser, lab, "cursors", show_cursors)
        take(browser, lab, "design", show_design)
        take(browser, lab, "overlay", show_overlay)
        take(browser, lab, "ranking", show_ranking)
        browser.close()


if __name__ == "__main__":
    take_screenshots()
