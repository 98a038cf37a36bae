"""The steps of the tutorial *First hour in the browser*, docs/tutorials/browser.md."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_page import come_back, go_to_page, wait_for_samples
from tests.docs.pages import ROOT
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d", "still")]

TUTORIAL = (ROOT / "docs/tutorials/browser.md").read_text(encoding="utf-8")
NAMED = ("Hang 3 kg", "Compare with FL", "Last event", "Record", "Runs")
"""The controls named in the tutorial; each is pressed below."""


def test_browser_tutorial_can_be_followed(page: Page, lab: Lab) -> None:
    for name in NAMED:
        assert f"*{name}*" in TUTORIAL
    lab.load_figure("4a", "ndobc", load=False)
    lab.client.post(lab.session + "/start").raise_for_status()
    come_back(page, lab)
    page.goto(lab.url)
    wait_for_samples(page)
    for plot in ("Position", "Stiffness", "Position error", "Disturbance"):
        expect(page.get_by_role("region", name=f"{plot} plot", exact=True)).to_be_visible()
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    page.get_by_role("switch", name="Compare with FL").press("Enter")
    expect(page.get_by_role("switch", name="Compare with FL")).to_be_checked()
    page.get_by_role("button", name="Last event").click()
    expect(page.get_by_role("heading", name="Realism")).to_be_visible()
    page.get_by_role("button", name="Record", exact=True).click()
    page.get_by_role("button", name=re.compile("^Recording")).click()
    expect(page.get_by_role("button", name="Record", exact=True)).to_be_visible()
    go_to_page(page, "Runs")
    expect(page.get_by_role("table", name="Recorded runs")).to_be_visible()
