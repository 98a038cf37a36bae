"""Without runs the page explains how to record one; then the first run is listed."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_page import go_to_page, open_page
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


def test_empty_list_has_instructions_and_then_the_first_run(page: Page, lab: Lab) -> None:
    lab.load_figure()
    open_page(page, lab)
    expect(page.get_by_role("button", name="Record", exact=True)).to_be_enabled()
    page.keyboard.press("o")
    expect(page.get_by_text("No recorded runs yet")).to_be_visible()
    # The first view of the lab has no such button.
    expect(page.get_by_text("Record (under All controls)")).to_be_visible()
    page.get_by_role("link", name="Lab", exact=True).click()
    page.get_by_role("button", name="Record", exact=True).click()
    page.get_by_role("button", name=re.compile("^Recording (?!0:00)")).click()
    note = page.get_by_role("status").filter(
        has_text="Saved: Fig. 4A motion · NDOBC · σ 15 · no load"
    )
    expect(note).to_be_visible()
    go_to_page(page, "Runs")
    row = page.get_by_role("table", name="Recorded runs").get_by_role("row").nth(1)
    expect(row.get_by_role("link", name="Fig. 4A motion · NDOBC · σ 15 · no load")).to_be_visible()
    page.set_viewport_size({"width": 1440, "height": 900})
    expect(row.get_by_role("img", name=re.compile("Position error of NDOBC"))).to_be_visible()
    row.get_by_role("button", name=re.compile("^Delete")).click()
    expect(page.get_by_text("No recorded runs yet")).to_be_visible()
