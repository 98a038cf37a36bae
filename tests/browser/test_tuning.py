"""The panel *Tune*: a search is started, followed to its end and applied, by keyboard alone."""

import re
from functools import partial
from typing import Any

import httpx
import pytest
from playwright.sync_api import Locator, Page, Response, expect

from svsa.runs.definition.design_file import parse_design
from tests.browser.conftest import PATIENCE_MS
from tests.browser.settled import get_box, resize, until
from tests.browser.test_page import go_to_page, open_page
from tests.lab import Lab
from tests.waiting import PATIENCE_S

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

CANDIDATES = 12


def open_tuning(page: Page) -> Locator:
    go_to_page(page, "Tune …")
    panel = page.get_by_role("dialog", name="Tune a law")
    expect(panel).to_be_visible()
    return panel


def begins_tuning(response: Response) -> bool:
    return response.request.method == "POST" and response.url.endswith("/jobs")


def read(address: str) -> httpx.Response:
    return httpx.get(address, timeout=PATIENCE_S, trust_env=False).raise_for_status()


def tune(panel: Locator) -> dict[str, Any]:
    """Search FL + I from its present parameters to the end, and read the result.

    Until then, the panel may show an earlier result with the same text.
    """
    panel.get_by_label("Law").select_option("fl_integral")
    panel.get_by_label("Candidates", exact=True).fill(str(CANDIDATES))
    with panel.page.expect_response(begins_tuning) as begun:
        panel.get_by_role("button", name="Start").press("Enter")
    address = f"{begun.value.url}/{begun.value.json()['id']}"
    for _ in range(PATIENCE_MS // 200):
        found = read(address).json()
        if found["status"] == "done":
            break
        panel.page.wait_for_timeout(200)
    end = panel.get_by_text(f"FL + I: {CANDIDATES} of {CANDIDATES} candidates. Done.")
    expect(end).to_be_visible()
    return found["result"]


def test_law_is_tuned_and_the_best_result_is_applied_and_saved(page: Page, lab: Lab) -> None:
    lab.load_figure(law="fl_integral")
    lab.jump(1)
    open_page(page, lab)
    panel = open_tuning(page)
    panel.get_by_label("Candidates", exact=True).fill("0")
    panel.get_by_role("button", name="Start").press("Enter")
    expect(panel.get_by_role("alert")).to_contain_text("Candidates: 0 is out of range")
    found = tune(panel)
    present, best = found["present"], found["best"]
    assert best["cost"] < present["cost"]
    curve = panel.get_by_role("img", name=re.compile(f"^Best cost over {CANDIDATES} candidates"))
    expect(curve).to_be_visible()
    values = panel.get_by_role("table").first.get_by_role("row")
    expect(values).to_have_count(1 + len(found["axes"]))
    for row, tried in zip(values.all()[1:], best["values"], strict=True):
        assert float(row.get_by_role("cell").nth(1).inner_text()) == pytest.approx(tried, rel=1e-3)

    panel.get_by_role("button", name="Apply best").press("Enter")
    expect(panel.get_by_text("Applied to this session.")).to_be_visible()
    setting = found["best_setting"]["parameters"]
    assert lab.read()["configuration"]["parameters"]["fl_integral"] == setting
    address = panel.get_by_role("link", name="Save as file").get_attribute("href")
    assert address is not None
    saved = parse_design(read(address).text).parameters["fl_integral"]
    assert saved.model_dump(mode="json") == setting

    page.keyboard.press("Escape")
    expect(panel).to_be_hidden()
    expect(open_tuning(page).get_by_text(re.compile("Done"))).to_be_visible()


def test_panel_leaves_the_settings_and_the_transport_controls_accessible(
    page: Page, still_lab: Lab
) -> None:
    open_page(page, still_lab)
    panel = open_tuning(page)
    controls = page.get_by_role("region", name="Controls", exact=True)
    transport = page.get_by_role("button", name="Run", exact=True)

    def is_below_and_next_to(width: int) -> bool:
        box, run = get_box(panel), get_box(transport)
        right = box["x"] + box["width"]
        is_left = width < 1121 or right <= get_box(controls)["x"]
        return is_left and box["x"] >= 0 and right <= width and box["y"] >= run["y"] + run["height"]

    for width, height in ((1280, 720), (820, 1180), (390, 844)):
        resize(page, width, height)
        until(page, partial(is_below_and_next_to, width))
