"""The page Actuators: select one, read its datasheet, open and control a session of it."""

import os
import re
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.actuators.own_actuator import install_own_actuator
from tests.browser.test_page import choose, go_to_page, open_page
from tests.docs.pages import ROOT
from tests.lab import Lab, run_lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


def remove_and_add_load(page: Page) -> None:
    """First wait for the load of the experiment at 5 s."""
    page.get_by_role("button", name=re.compile("Remove load")).click()
    page.get_by_role("button", name=re.compile("Add load")).click()
    expect(page.get_by_role("button", name=re.compile("Remove load"))).to_be_visible()


def test_actuator_is_selected_measured_and_opened_in_a_session(page: Page, still_lab: Lab) -> None:
    open_page(page, still_lab)
    go_to_page(page, "Actuators")
    choose(page.get_by_role("radio", name="qbmove"))
    page.wait_for_url(re.compile(r"actuators=qbmove"))
    card = page.get_by_role("region", name="qbmove", exact=True)
    expect(card).to_contain_text("Stiffness 0.2 to 15 N·m/rad")
    expect(card).to_contain_text("public Gazebo models of the ViActors project")
    sheet = page.get_by_role("region", name="Datasheet", exact=True).first
    expect(sheet.get_by_role("row", name=re.compile("Stiffness range, unloaded"))).to_contain_text(
        "0.2 to 15 N·m/rad"
    )
    expect(sheet.get_by_role("img", name="Torque over deflection: 5 curves")).to_be_visible()
    expect(sheet.get_by_role("img", name="Torque–speed workspace: 1 curve")).to_be_visible()
    for kind, begins in (("PDF", b"%PDF"), ("JSON", b"{")):
        address = sheet.get_by_role("link", name=kind).get_attribute("href")
        assert page.request.get(address).body().startswith(begins)
    card.get_by_role("button", name="Open session").click()
    page.wait_for_url(re.compile(r"\?session="))
    expect(page.get_by_text("Private session: qbmove.")).to_be_visible()
    expect(page.get_by_role("heading", level=1)).to_contain_text("qbmove")
    remove_and_add_load(page)
    page.get_by_role("switch", name=re.compile("All")).click()
    expect(page.get_by_role("button", name="Fig. 4A")).to_have_count(0)
    expect(page.get_by_role("alert")).to_have_text([])


def test_published_figures_fit_into_the_width_of_a_phone(page: Page, still_lab: Lab) -> None:
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(f"{still_lab.url}/?actuators=qbmove")
    figures = page.get_by_role("list", name="Published figures")
    expect(figures.get_by_role("listitem")).to_have_count(2)
    expect(figures).to_contain_text("simulated 12 N·m, published 12 N·m, deviation +0.0 %")
    widths = figures.evaluate("list => [list.scrollWidth, list.clientWidth, innerWidth]")
    assert widths[0] <= widths[1] < widths[2]
    assert page.evaluate("document.documentElement.scrollWidth") == 390


def test_own_actuator_tutorial_ends_with_ndobc_on_the_page(page: Page, tmp_path: Path) -> None:
    """The steps of the last section, with the package of the tutorial installed."""
    places = os.pathsep.join([str(install_own_actuator(tmp_path)), str(ROOT)])
    with run_lab(within=("env", f"PYTHONPATH={places}")) as lab:
        open_page(page, lab)
        go_to_page(page, "Actuators")
        choose(page.get_by_role("radio", name="Cubic spring"))
        card = page.get_by_role("region", name="Cubic spring", exact=True)
        sheet = page.get_by_role("region", name="Datasheet", exact=True).first
        expect(sheet).to_contain_text("No published figures")
        card.get_by_role("button", name="Open session").click()
        page.wait_for_url(re.compile(r"\?session="))
        expect(page.get_by_text("Private session: Cubic spring.")).to_be_visible()
        remove_and_add_load(page)
        name = re.search(r"session=([\w-]+)", page.url)
        assert name is not None
        session = lab.client.get(f"/api/v1/sessions/{name[1]}").json()
        assert session["configuration"]["law"] == "ndobc"
        assert session["configuration"]["actuator"]["mechanism"] == "cubic"
        assert session["fault"] is None
