"""The page Actuators: one is chosen, its datasheet read, a session of it opened and controlled."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_page import go_to_page, open_page
from tests.lab import Lab

LONG_MS = 60_000

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


def test_an_actuator_is_chosen_measured_and_opened_in_a_session(page: Page, still_lab: Lab) -> None:
    open_page(page, still_lab)
    go_to_page(page, "Actuators")
    page.get_by_role("radio", name="qbmove").check(force=True)
    page.wait_for_url(re.compile(r"actuators=qbmove"))
    card = page.get_by_role("region", name="qbmove", exact=True)
    expect(card).to_contain_text("Stiffness 0.2 to 15 N·m/rad")
    expect(card).to_contain_text("public Gazebo models of the ViActors project")
    sheet = page.get_by_role("region", name="Datasheet", exact=True).first
    expect(sheet.get_by_role("row", name=re.compile("Stiffness range, unloaded"))).to_contain_text(
        "0.2 to 15 N·m/rad", timeout=LONG_MS
    )
    expect(sheet.get_by_role("img", name="Torque over deflection: 5 curves")).to_be_visible()
    for kind, begins in (("PDF", b"%PDF"), ("JSON", b"{")):
        address = sheet.get_by_role("link", name=kind).get_attribute("href")
        assert page.request.get(address).body().startswith(begins)
    card.get_by_role("button", name="Open session").click()
    page.wait_for_url(re.compile(r"\?session="), timeout=LONG_MS)
    expect(page.get_by_text("Private session: qbmove.")).to_be_visible(timeout=LONG_MS)
    expect(page.get_by_role("heading", level=1)).to_contain_text("qbmove")
    page.get_by_role("button", name=re.compile("Add load")).click()
    expect(page.get_by_role("button", name=re.compile("Remove load"))).to_be_visible()
    page.get_by_role("switch", name=re.compile("All")).click()
    expect(page.get_by_role("button", name="Fig. 4A")).to_have_count(0)
    expect(page.get_by_role("alert")).to_have_count(0)
