"""The selection of plots, and the events displayed next to them, in a real browser."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_page import ONE_DEGREE, open_page, wait_for_samples
from tests.browser.test_plots import STREAMED, find_axis, find_plot
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d", "still")]

PICTURES = """() => [...document.querySelectorAll('[aria-label="Position plot"] canvas')]
    .map((canvas) => canvas.toDataURL())"""
IS_DRAWN_WHOLE = f"""async () => {{
    const before = ({PICTURES})();
    for (let i = 0; i < 30; i++) await new Promise(requestAnimationFrame);
    return ({PICTURES})().every((picture, index) => picture === before[index]);
}}"""
VELOCITIES = ("velocity_reference_rad_per_s", "velocity_rad_per_s")
SCROLLS_NOT = "() => document.documentElement.scrollHeight === window.innerHeight"


def test_plots_are_added_removed_stored_and_reset(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    assert not page.evaluate(STREAMED, "deflection_rad")
    page.get_by_role("button", name="Plots", exact=True).click()
    page.get_by_role("checkbox", name="Deflection").check()
    page.get_by_role("checkbox", name="Phase plane").check()
    page.get_by_role("checkbox", name="Stiffness", exact=True).uncheck()
    page.get_by_label("Another plot of").select_option(label="Lever ratio μ")
    page.keyboard.press("Escape")
    for name in ("Deflection", "Phase plane", "Lever ratio μ"):
        expect(find_plot(page, name)).to_be_visible()
    expect(find_plot(page, "Stiffness")).to_have_count(0)
    for channel in ("deflection_rad", "deflection_limit_rad", "lever_ratio", *VELOCITIES):
        page.wait_for_function(STREAMED, arg=channel)
    page.wait_for_function(f"channel => !({STREAMED})(channel)", arg="stiffness_nm_per_rad")

    page.reload()
    wait_for_samples(page)
    expect(find_plot(page, "Lever ratio μ")).to_be_visible()
    page.get_by_role("button", name="Lever ratio μ: curves, save, remove").click()
    page.get_by_role("button", name="Remove plot").click()
    expect(find_plot(page, "Lever ratio μ")).to_have_count(0)
    page.get_by_role("button", name="Plots", exact=True).click()
    page.get_by_role("button", name="Restore default plots").click()
    expect(find_plot(page, "Stiffness")).to_be_visible()
    expect(find_plot(page, "Deflection")).to_have_count(0)


def test_event_shows_its_effect_at_its_time(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    onset = lab.read()["loads"][0]["start_s"]
    lab.jump(2)
    wait_for_samples(page, onset + 1.99)
    mark = page.get_by_role("button", name=re.compile("^3 kg load on, "))
    mark.focus()
    numbers = page.get_by_role("table", name=re.compile("^Position error until now"))
    expect(numbers).to_be_visible()
    cells = numbers.get_by_role("cell").all_inner_texts()
    peak = lab.read()["lanes"][0]["since_load"]["peak_position_error_rad"] / ONE_DEGREE
    assert float(cells[0]) == pytest.approx(peak, rel=1e-3)
    assert 0.1 < float(cells[2]) < 0.5
    page.keyboard.press("Escape")
    expect(numbers).to_have_count(0)


@pytest.mark.exhaustive
def test_eight_plots_do_not_scroll_the_page(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    page.get_by_role("button", name="Plots", exact=True).click()
    for name in ("Stiffness error", "Deflection", "Phase plane"):
        page.get_by_role("checkbox", name=name).check()
    page.keyboard.press("Escape")
    expect(find_axis(page)).to_be_in_viewport(ratio=1)
    page.wait_for_function(SCROLLS_NOT)


@pytest.mark.exhaustive
def test_last_event_is_fixed_next_to_the_plots(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    page.keyboard.press("z")
    expect(page.get_by_text("No event yet")).to_be_visible()
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    onset = lab.read()["loads"][0]["start_s"]
    lab.jump(2)
    title = page.locator(".zoom-title")
    expect(title).to_have_text(re.compile(r"[\d.]+ s: 3 kg load on"))
    wait_for_samples(page, onset + 1.99)
    expect(find_plot(page, "Position").locator("canvas")).to_have_count(2)
    page.wait_for_function(IS_DRAWN_WHOLE)
    before = page.evaluate(PICTURES)
    lab.jump(1)
    page.wait_for_function(f"before => ({PICTURES})()[0] !== before", arg=before[0])
    page.wait_for_function(IS_DRAWN_WHOLE)
    assert page.evaluate(PICTURES)[1] == before[1]
    page.keyboard.press("z")
    expect(find_plot(page, "Position").locator("canvas")).to_have_count(1)
