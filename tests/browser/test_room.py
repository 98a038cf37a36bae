"""Space at small sizes: plots under cursors, notes, numbers, chips."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.settled import get_box, resize
from tests.browser.test_page import go_to_page, open_page
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


def test_cursors_leave_every_plot_in_view_at_the_smallest_size(page: Page, still_lab: Lab) -> None:
    resize(page, 1280, 720)
    open_page(page, still_lab)
    page.get_by_role("button", name="Cursors").press("Enter")
    expect(page.get_by_role("region", name="Disturbance plot")).to_be_visible()
    expect(page.locator(".plots-below")).to_have_count(0)


def test_recording_is_shown_over_the_lab_and_on_no_other_page(page: Page, still_lab: Lab) -> None:
    """The layout does not move, and other pages do not show it."""
    open_page(page, still_lab)
    before = get_box(page.locator(".view"))
    page.get_by_role("button", name="Record", exact=True).press("Enter")
    page.get_by_role("button", name=re.compile("^Recording")).press("Enter")
    note = page.get_by_text("Saved:")
    expect(note).to_be_visible()
    assert get_box(page.locator(".view")) == before
    go_to_page(page, "Learn")
    expect(page.get_by_role("main", name="Learn")).to_be_visible()
    expect(note).to_be_hidden()


@pytest.mark.parametrize("value", ["379000", "12960000"])
def test_number_field_shows_its_complete_number(page: Page, still_lab: Lab, value: str) -> None:
    open_page(page, still_lab)
    page.get_by_text("Gains, coefficient by coefficient").click()
    box = page.get_by_role("spinbutton", name=re.compile("c₀ of q"))
    box.evaluate("(input, value) => { input.value = value; }", value)
    assert box.evaluate("input => input.scrollWidth <= input.clientWidth")
    unit = page.locator(".field", has=box).locator(".unit")
    right = get_box(unit)["x"] + get_box(unit)["width"]
    panel = get_box(page.locator("#controls"))
    assert right <= panel["x"] + panel["width"]


def test_every_chip_and_segment_is_at_least_24_px_large(page: Page, still_lab: Lab) -> None:
    open_page(page, still_lab)
    small = page.evaluate(
        """() => [...document.querySelectorAll(".chip, .choice label")]
        .filter((one) => one.checkVisibility())
        .map((one) => [one.innerText, one.getBoundingClientRect()])
        .filter(([, { width, height }]) => width < 24 || height < 24)
        .map(([text]) => text)"""
    )
    assert small == []
