"""Gains: poles placed on the page, predicted before they are applied, and undone."""

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.settled import get_box, until
from tests.browser.test_page import come_back, open_page
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


@pytest.fixture
def panel(page: Page, still_lab: Lab) -> Locator:
    """The panel with all its predictions: afterwards nothing in it moves."""
    come_back(page, still_lab)
    open_page(page, still_lab)
    page.get_by_role("button", name="Place poles").click()
    panel = page.get_by_role("dialog", name="Design")
    expect(panel.get_by_role("status", name="Verdict: Usable")).to_be_visible()
    stable = panel.get_by_role("row", name=re.compile("^M × 0.23 – 3.84"))
    expect(stable).to_be_visible()
    after_load = panel.get_by_role("img", name=re.compile("error after the 3 kg.* 4.14°"))
    expect(after_load).to_be_visible()
    return panel


def drag(page: Page, pole: Locator, dx: float, dy: float) -> None:
    pole.hover()
    box = get_box(pole)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + dx, y + dy, steps=4)
    page.mouse.up()


def real_parts(lab: Lab, group: str = "position") -> list[float]:
    gains = lab.read()["configuration"]["gains"]
    return [root["re"] for root in gains[f"{group}_roots_rad_per_s"]]


def test_undo_restores_load_and_law(page: Page, still_lab: Lab) -> None:
    come_back(page, still_lab)
    open_page(page, still_lab)
    undo = page.locator("#controls").get_by_role("button", name=re.compile("^Undo"))
    law = still_lab.read()["configuration"]["law"]
    page.get_by_role("button", name="Hang 3 kg").click()
    until(page, lambda: len(still_lab.read()["loads"]) == 1)
    undo.click()
    until(page, lambda: still_lab.read()["loads"] == [])
    expect(undo).to_be_disabled()
    other = {"law": "ndobc" if law == "fl" else "fl"}
    still_lab.client.put(still_lab.session + "/law", json=other).raise_for_status()
    expect(undo).to_be_enabled()
    undo.click()
    until(page, lambda: still_lab.read()["configuration"]["law"] == law)


def test_pole_is_dragged_predicted_applied_and_undone_step_by_step(
    page: Page, still_lab: Lab, panel: Locator
) -> None:
    expect(panel.get_by_role("button", name="Apply")).to_be_disabled()
    drag(page, panel.get_by_role("slider", name="Position pole 4 of 4"), 20, 0)
    expect(panel.get_by_role("row", name=re.compile("FL steady-state error"))).not_to_contain_text(
        "12.1°12.1°"
    )
    assert real_parts(still_lab) == pytest.approx([-60.0] * 4, abs=0.1)
    panel.get_by_role("button", name="Apply").click()
    expect(panel.get_by_role("button", name="Undo, 1 step kept")).to_be_visible()
    assert max(real_parts(still_lab)) == pytest.approx(-41.4, abs=2.0)
    expect(panel.get_by_role("button", name="Apply")).to_be_disabled()
    panel.get_by_role("spinbutton", name="Stiffness bandwidth").fill("30")
    panel.get_by_role("button", name="Apply").click()
    panel.get_by_role("button", name="Undo, 2 steps kept").click()
    expect(panel.get_by_role("button", name="Undo, 1 step kept")).to_be_visible()
    assert real_parts(still_lab, "stiffness") == pytest.approx([-40, -40])
    panel.get_by_role("button", name="Undo, 1 step kept").click()
    expect(panel.get_by_role("button", name="Undo", exact=True)).to_be_disabled()
    assert real_parts(still_lab) == pytest.approx([-60.0] * 4, abs=0.1)


def test_unstable_poles_have_a_reason_and_cannot_be_applied(page: Page, panel: Locator) -> None:
    drag(page, panel.get_by_role("slider", name="Position pole 4 of 4"), 100, -60)
    verdict = panel.get_by_role("status", name="Verdict: Unsuitable")
    expect(verdict).to_contain_text("right of the imaginary axis")
    expect(panel.get_by_role("button", name="Apply")).to_be_disabled()
    panel.get_by_role("button", name="Discard").click()
    expect(panel.get_by_role("status", name="Verdict: Usable")).to_be_visible()


@pytest.mark.exhaustive
def test_map_is_completed(panel: Locator) -> None:
    panel.get_by_role("button", name="Compute map").click()
    reported = panel.get_by_text("21.3 % of 961 initial states converge, on the rig")
    expect(reported).to_be_visible()


@pytest.mark.exhaustive
def test_too_fast_poles_are_predicted_to_end_in_a_fault(panel: Locator) -> None:
    panel.get_by_role("spinbutton", name="Position bandwidth").fill("90")
    expect(panel.get_by_role("status", name="Verdict: Unsuitable")).to_contain_text("fault")
    expect(panel.get_by_role("row", name=re.compile("Peak u₁"))).to_contain_text("beyond the limit")


@pytest.mark.exhaustive
def test_pole_pair_is_moved_with_the_keyboard(panel: Locator) -> None:
    pole = panel.get_by_role("slider", name="Position pole 1 of 4")
    pole.focus()
    pole.press("Shift+ArrowLeft")
    expect(pole).to_have_attribute("aria-valuetext", "−70 rad/s")
    pole.press("Shift+ArrowUp")
    expect(pole).to_have_attribute("aria-valuetext", "−70 + 10j rad/s")
    partners = panel.get_by_role("slider", name=re.compile("Position pole"))
    values = [partners.nth(i).get_attribute("aria-valuetext") for i in range(4)]
    assert values.count("−70 − 10j rad/s") == 1
    pole.press("Escape")
    expect(panel).to_be_hidden()


@pytest.mark.exhaustive
def test_observer_is_set_next_to_the_poles(still_lab: Lab, panel: Locator) -> None:
    panel.get_by_role("spinbutton", name="Observer bandwidth").fill("40")
    panel.get_by_role("button", name=re.compile("^Apply")).click()
    expect(panel.get_by_role("button", name="Undo, 1 step kept")).to_be_visible()
    assert still_lab.read()["configuration"]["observer"]["bandwidth_rad_per_s"] == [40, 40, 40]


@pytest.mark.exhaustive
def test_panel_fits_the_screen(page: Page, panel: Locator) -> None:
    def is_within() -> bool:
        box = get_box(panel)
        return box["x"] >= 0 and box["y"] + box["height"] <= 720

    until(page, is_within)
    page.wait_for_function("document.documentElement.scrollHeight <= innerHeight")
    panel.evaluate("panel => panel.scrollTo(0, panel.scrollHeight)")
    panel.get_by_role("button", name="Close").click()
    expect(panel).to_be_hidden()


@pytest.mark.exhaustive
@pytest.mark.parametrize("width", [390, 820, 1280])
def test_opened_panel_leaves_the_transport_controls_accessible(
    page: Page, still_lab: Lab, width: int
) -> None:
    page.set_viewport_size({"width": width, "height": 844})
    open_page(page, still_lab)
    page.keyboard.press("?")
    keys = page.get_by_role("dialog", name="Keyboard")

    def is_below_the_transport() -> bool:
        transport = get_box(page.get_by_role("button", name="Run", exact=True))
        return transport["y"] + transport["height"] <= get_box(keys)["y"]

    until(page, is_below_the_transport)


def test_unstable_design_faults_in_a_private_simulation(
    page: Page, still_lab: Lab, panel: Locator
) -> None:
    panel.get_by_role("spinbutton", name="Observer bandwidth β").fill("900")
    panel.get_by_role("spinbutton", name="Position bandwidth").fill("190")
    expect(panel.get_by_text(re.compile("^The run ends in a fault"))).to_be_visible()
    unstable = panel.get_by_text("On the rig this loop is unstable")
    expect(unstable).to_be_visible()
    after_load, under_sine = (
        panel.get_by_role("img", name=re.compile(name))
        for name in ("^Position error after the 3 kg", "^Error for a sine")
    )
    until(page, lambda: abs(get_box(after_load)["y"] - get_box(under_sine)["y"]) <= 2)
    panel.get_by_role("button", name="Run the failure in simulation").click()
    page.wait_for_url(re.compile(r"session=private-"))
    expect(page.get_by_text("Private session.")).to_be_visible()
    assert real_parts(still_lab) == pytest.approx([-60.0] * 4, abs=0.1)
