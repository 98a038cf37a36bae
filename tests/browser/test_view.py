"""The 3D view on the page: cameras, pushing the link, low graphics, other lanes as outlines."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_page import open_page
from tests.browser.test_safety import wait_for_status
from tests.lab import Lab

pytestmark = pytest.mark.browser

LONG_MS = 60_000
CAMERA = """() => {
    const viser = document.querySelector("iframe").contentWindow.__viserMutable;
    const { x, y, z } = viser?.camera?.position ?? {};
    return [x, y, z];
}"""
IS_READY = "() => !!document.querySelector('iframe')?.contentWindow?.__viserMutable?.camera"


def open_view(page: Page, lab: Lab) -> None:
    lab.load_figure()
    page.add_init_script("localStorage.setItem('svsa.tour', 'done')")
    page.goto(lab.url)
    page.wait_for_function(IS_READY, timeout=LONG_MS)
    page.wait_for_timeout(500)


def test_the_camera_goes_to_a_preset_of_this_page_only(page: Page, lab: Lab) -> None:
    open_view(page, lab)
    page.get_by_role("button", name="Camera: Side").click()
    page.wait_for_function(f"() => ({CAMERA})()[0] < -11", timeout=LONG_MS)
    page.get_by_role("button", name="Camera: Front").click()
    page.wait_for_function(f"() => ({CAMERA})()[2] < -8", timeout=LONG_MS)


def wait_for_pushes(page: Page, lab: Lab, ended: int) -> list[str]:
    """What the session says of pushes when so many of them have ended."""
    labels: list[str] = []
    for _ in range(LONG_MS // 100):
        labels = [event["label"] for event in lab.read()["events"]]
        if labels.count("Push off") >= ended:
            break
        page.wait_for_timeout(100)
    return [label for label in labels if label.startswith("Push")]


def test_the_link_is_pushed_with_the_mouse_and_by_keys(page: Page, lab: Lab) -> None:
    open_view(page, lab)
    page.get_by_role("button", name="Camera: Front").click()
    page.wait_for_timeout(800)
    page.get_by_role("button", name="Push").click()
    layer = page.get_by_role("button", name=re.compile("Drag to push"))
    box = layer.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] * 0.7
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 110, y - 60, steps=4)
    page.wait_for_timeout(600)
    page.mouse.up()
    assert wait_for_pushes(page, lab, 1) == ["Push on", "Push off"]
    assert not [load for load in lab.read()["loads"] if load["active"]]
    layer.press("ArrowRight", delay=700)
    assert wait_for_pushes(page, lab, 2) == 2 * ["Push on", "Push off"]
    layer.press("Escape")
    expect(layer).to_be_hidden()


def test_low_graphics_are_remembered(page: Page, lab: Lab) -> None:
    open_view(page, lab)
    switch = page.get_by_role("button", name="Low graphics")
    full = page.frame_locator("iframe").locator("canvas").first.bounding_box()
    switch.click()
    expect(switch).to_have_attribute("aria-pressed", "true")
    page.wait_for_timeout(500)
    pixels = "() => document.querySelector('iframe').contentWindow.innerWidth"
    assert full is not None
    assert page.evaluate(pixels) < 0.7 * full["width"]
    page.reload()
    expect(switch).to_have_attribute("aria-pressed", "true")


def test_shift_escape_stops_from_a_text_field_and_from_the_3d_view(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    field = page.get_by_role("spinbutton", name=re.compile("Frequency")).first
    field.fill("0.3")
    field.press("Shift+Escape")
    wait_for_status(page, lab, "paused")
    lab.client.post(lab.session + "/start").raise_for_status()
    view = page.frame_locator("iframe").locator("body")
    view.evaluate("body => { body.tabIndex = 0; body.focus(); }")
    page.keyboard.press("Shift+Escape")
    wait_for_status(page, lab, "paused")


def test_names_of_the_parts_are_shown_in_the_window_that_asks(page: Page, lab: Lab) -> None:
    open_view(page, lab)
    seen = """name => document.querySelector("iframe").contentWindow
        .__viserMutable && document.querySelector("iframe").contentWindow
        .__viserSceneTree.getState()[name].visibility"""
    names = page.get_by_role("button", name="Names of the parts")
    assert page.evaluate(seen, "/a/c/p/n4") is False
    page.keyboard.press("n")
    expect(names).to_have_attribute("aria-pressed", "true")
    page.wait_for_function(f"() => ({seen})('/a/c/p/n4')", timeout=LONG_MS)
    names.click()
    page.wait_for_function(f"() => !({seen})('/a/c/p/n4')", timeout=LONG_MS)
