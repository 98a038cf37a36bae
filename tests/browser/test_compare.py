"""Two laws in parallel on the page, and the record button, with a real server."""

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.settled import get_box, until
from tests.browser.test_page import (
    LAST_TIME,
    ONE_DEGREE,
    choose_law,
    open_page,
    wait_for_samples,
)
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

# The smallest and the largest position error of a lane from a session time on, in rad.
ERRORS = """([lane, since]) => {
    const { time, value } = window.svsa.series("position_error_rad", lane);
    const sizes = value.filter((_, i) => time[i] >= since).map(Math.abs);
    return [Math.min(...sizes), Math.max(...sizes)];
}"""
HAS_LANE_2 = """() => {
    try {
        return window.svsa.series("position_error_rad", 2).value.some(Number.isFinite);
    } catch {
        return false;
    }
}"""


def find_switch(page: Page) -> Locator:
    return page.get_by_role("switch", name=re.compile("^Compare with"))


def test_fl_added_to_ndobc_keeps_the_error_that_ndobc_removes(page: Page, still_lab: Lab) -> None:
    open_page(page, still_lab)
    switch = find_switch(page)
    expect(switch).to_have_accessible_name("Compare with FL")
    switch.click()
    expect(switch).to_be_checked()
    still_lab.jump(1)
    page.wait_for_function(HAS_LANE_2)
    table = page.get_by_role("table", name=re.compile("Comparison of controllers"))
    expect(table.get_by_role("rowheader")).to_have_text(["NDOBC", "FL"])

    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    onset = still_lab.read()["loads"][0]["start_s"]
    still_lab.jump(3)
    wait_for_samples(page, onset + 2.5)
    steady = onset + 1.5
    assert page.evaluate(ERRORS, [1, steady])[1] < 0.1 * ONE_DEGREE
    assert page.evaluate(ERRORS, [2, steady])[0] > 8 * ONE_DEGREE
    expect(table.get_by_role("row", name=re.compile("NDOBC")).get_by_text("best")).to_have_count(3)
    for plot in ("Position", "Position error", "Stiffness", "Torque"):
        legend = page.get_by_role("region", name=f"{plot} plot", exact=True)
        expect(legend.get_by_role("button", name=re.compile("^FL"))).to_be_visible()
    disturbance = page.get_by_role("region", name="Disturbance plot", exact=True)
    expect(disturbance).to_contain_text("unused by FL")

    switch.click()
    expect(switch).not_to_be_checked()
    expect(table).to_have_count(0)
    assert still_lab.read()["configuration"]["comparisons"] == []
    before = page.evaluate(LAST_TIME)
    still_lab.jump(1)
    wait_for_samples(page, before)
    assert not page.evaluate(HAS_LANE_2)


@pytest.mark.exhaustive
def test_all_main_elements_are_visible_while_comparing(page: Page, still_lab: Lab) -> None:
    open_page(page, still_lab)
    find_switch(page).click()
    parts = [
        page.get_by_role("button", name=re.compile("Hang 3 kg")),
        page.get_by_role("table", name=re.compile("Comparison of controllers")),
        page.get_by_role("region", name="Position plot", exact=True),
        find_switch(page),
        page.locator("iframe"),
    ]
    for part in parts:
        expect(part).to_be_in_viewport(ratio=1)


@pytest.mark.exhaustive
def test_law_and_comparison_are_exchanged(page: Page, still_lab: Lab) -> None:
    open_page(page, still_lab)
    find_switch(page).click()
    expect(find_switch(page)).to_be_checked()
    choose_law(page, "FL")
    expect(find_switch(page)).to_have_accessible_name("Compare with NDOBC")
    assert [lane["law"] for lane in still_lab.read()["lanes"]] == ["fl", "ndobc"]


def test_same_law_twice_is_distinguished_by_its_parameters(page: Page, still_lab: Lab) -> None:
    """Selected, set, reset and removed by key; the actuator of the lane does not move."""
    open_page(page, still_lab)
    page.get_by_role("button", name="Add", exact=True).press("Enter")
    laws = page.get_by_role("dialog", name="Add", exact=True)
    expect(laws.get_by_role("searchbox")).to_be_focused()
    page.keyboard.press("ArrowDown")
    expect(laws.get_by_role("button", name=re.compile("^NDOBC "))).to_be_focused()
    page.keyboard.press("Enter")
    lanes = page.get_by_role("list", name="Compared with")
    settings = lanes.get_by_role("button", name="Settings of NDOBC (2)", exact=True)
    settings.press("Enter")
    expect(settings).to_have_attribute("aria-expanded", "true")
    field = lanes.get_by_role("spinbutton", name=re.compile("^ωq"))
    field.fill("40")
    field.press("Enter")
    expect(lanes.get_by_role("button", name="Remove NDOBC ωq 40", exact=True)).to_be_visible()
    legend = page.get_by_role("region", name="Position error plot", exact=True)
    expect(legend.get_by_role("button", name=re.compile("^NDOBC ωq 40"))).to_be_visible()
    still_lab.jump(1)  # the samples with these parameters, to be distinguished
    ids = [lane["id"] for lane in still_lab.read()["lanes"]]

    field.fill("9000")
    field.press("Enter")
    expect(lanes.get_by_role("alert")).to_contain_text("1000 rad/s")
    page.get_by_role("button", name=re.compile("^Undo")).press("Enter")
    remove = lanes.get_by_role("button", name="Remove NDOBC ωq 60 (2)", exact=True)
    expect(remove).to_be_visible()
    assert [lane["id"] for lane in still_lab.read()["lanes"]] == ids
    remove.press("Enter")
    expect(lanes).to_have_count(0)
    assert still_lab.read()["configuration"]["comparisons"] == []


def test_recording_is_started_displayed_and_ended(page: Page, still_lab: Lab) -> None:
    open_page(page, still_lab)
    before = get_box(page.locator(".lab"))
    page.get_by_role("button", name="Record", exact=True).click()
    recording = page.get_by_role("button", name=re.compile("^Recording"))
    expect(recording).to_be_visible()
    still_lab.jump(1)
    expect(recording).to_have_accessible_name(re.compile("^Recording 0:01"))
    assert still_lab.read()["recording"]["state"] == "recording"
    expect(find_switch(page)).to_be_disabled()
    expect(find_switch(page)).to_have_attribute("title", re.compile("stop it first"))
    recording.click()
    expect(page.get_by_role("button", name="Record", exact=True)).to_be_visible()
    expect(find_switch(page)).to_be_enabled()
    note = page.get_by_role("status").filter(has_text=re.compile("^Saved:"))
    expect(note).to_be_visible()
    assert get_box(page.locator(".lab")) == before, "the note moved the work"
    assert still_lab.read()["recording"] is None


CUT_NAMES = """(plot) => [...document.querySelectorAll(`${plot} .legend-name`)]
    .filter((one) => one.scrollWidth > one.clientWidth).map((one) => one.textContent)"""


def test_legend_cuts_the_reference_before_the_laws(page: Page, still_lab: Lab) -> None:
    """A bandwidth at the end of a name distinguishes two curves; FL and θ₁ are never cut."""
    page.set_viewport_size({"width": 1440, "height": 900})
    still_lab.client.put(still_lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]})
    open_page(page, still_lab)
    for bandwidth in (60, 81):
        observer = {"bandwidth_rad_per_s": [float(bandwidth)] * 3}
        still_lab.client.put(still_lab.session + "/observer", json=observer).raise_for_status()
        still_lab.jump(1)
    legend = page.get_by_role("region", name="Position plot", exact=True)
    expect(legend.get_by_role("button", name=re.compile("^NDOBC β 60"))).to_be_visible()
    # The names are narrower until the values of the last step are shown next to them.
    until(page, lambda: page.evaluate(CUT_NAMES, "[data-plot='position']") == ["reference"])
    page.set_viewport_size({"width": 1280, "height": 720})
    assert not {"FL", "true"} & set(page.evaluate(CUT_NAMES, ""))
