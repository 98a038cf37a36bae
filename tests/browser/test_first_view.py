"""The first visit of a user: few controls, and a switch to all of them."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.measured_layout import FIND_PROBLEMS
from tests.browser.settled import get_box, resize, until
from tests.browser.test_accessibility import PHONE, WIDE, expect_no_violation
from tests.browser.test_page import come_back, go_to_page, wait_for_samples
from tests.browser.test_plot_choice import IS_DRAWN_WHOLE
from tests.browser.visited_layout import LEAST_PLOT_PX, SIZES, measure
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d", "still")]

MOST_BASIC = 29
LEAST_ALL = 80

# All visible elements of the window that take the pointer or the focus.
COUNT_CONTROLS = """() => {
    const controls = "a[href], button, input, select, textarea, summary, [tabindex='0']";
    return [...document.querySelectorAll(controls)].filter((one) => {
        const { left, right, top, bottom, width, height } = one.getBoundingClientRect();
        return one.checkVisibility({ visibilityProperty: true }) && !one.matches(".skip") &&
            width > 1 && height > 1 && right > 0 && bottom > 0 &&
            left < innerWidth && top < innerHeight;
    }).length;
}"""


def open_first(page: Page, lab: Lab) -> None:
    """As a user who has only finished the tour."""
    come_back(page, lab)
    page.evaluate("localStorage.removeItem('svsa.controls')")
    page.goto(lab.url)
    wait_for_samples(page)


def test_first_view_has_few_controls_and_remembers_the_switch_to_all(page: Page, lab: Lab) -> None:
    page.set_viewport_size({"width": 1440, "height": 900})
    lab.client.post(lab.session + "/start").raise_for_status()
    open_first(page, lab)
    switch = page.get_by_role("switch", name="All controls")
    expect(switch).to_have_attribute("aria-checked", "false")
    amplitude = page.get_by_role("spinbutton", name="Amplitude")
    expect(page.get_by_role("region", name="Position error plot")).to_be_visible()
    expect(amplitude).to_have_count(0)
    assert 0 < page.evaluate(COUNT_CONTROLS) <= MOST_BASIC
    switch.click()
    expect(amplitude).to_be_visible()
    page.wait_for_function(f"() => ({COUNT_CONTROLS})() >= {LEAST_ALL}")
    page.reload()
    expect(amplitude).to_be_visible()
    switch.click()
    page.reload()
    expect(page.get_by_role("button", name=re.compile("Hang 3 kg"))).to_be_visible()
    expect(amplitude).to_have_count(0)


# The button at a point of the window, without its own icon.
BUTTON_AT = """([x, y]) =>
    document.elementFromPoint(x, y)?.closest("button")?.innerText.trim().split(/\\s/)[0] ?? "" """


def test_second_press_at_the_switch_to_all_controls_presses_no_other_button(
    page: Page, lab: Lab
) -> None:
    """Reset or Record under the pointer would restart or record the run."""
    open_first(page, lab)
    switch = page.get_by_role("switch", name="All controls")
    for width, height in (*SIZES, (1600, 900)):
        resize(page, width, height)
        box = get_box(switch)
        switch.press("Enter")
        expect(page.get_by_role("spinbutton", name="Amplitude")).to_be_attached()
        center = [box["x"] + box["width"] / 2, box["y"] + box["height"] / 2]
        assert page.evaluate(BUTTON_AT, center) in ("", "All"), width
        if width > 1400:
            assert get_box(page.locator(".topbar"))["height"] < 60, "the top bar has two rows"
        switch.press("Enter")
        expect(page.get_by_role("spinbutton", name="Amplitude")).to_have_count(0)


def test_load_law_and_comparison_are_in_the_first_view(page: Page, lab: Lab) -> None:
    open_first(page, lab)
    for part in (
        page.get_by_role("button", name=re.compile("Hang 3 kg")),
        page.get_by_role("button", name="Control law: NDOBC"),
        page.get_by_role("switch", name="Compare with FL"),
    ):
        expect(part).to_be_in_viewport(ratio=1)
    page.get_by_role("switch", name="Compare with FL").press("Enter")
    table = page.get_by_role("table", name="Comparison of controllers")
    expect(table.get_by_role("row")).to_have_count(3)
    page.get_by_role("button", name=re.compile("Hang 3 kg")).press("Enter")
    expect(page.get_by_role("button", name=re.compile("^Remove 3 kg"))).to_be_visible()


def test_step_and_speed_are_shown_while_the_session_is_paused(page: Page, lab: Lab) -> None:
    open_first(page, lab)
    step, speed = page.get_by_role("button", name="Step"), page.get_by_label("Speed")
    expect(step).to_be_visible()
    expect(speed).to_be_visible()
    page.get_by_role("button", name="Run", exact=True).click()
    expect(step).to_have_count(0)
    expect(speed).to_have_count(0)
    page.get_by_role("button", name="Pause", exact=True).click()
    expect(step).to_be_visible()


def test_active_effects_and_loads_are_never_hidden(page: Page, lab: Lab) -> None:
    """They explain an error that the controller alone does not."""
    load = {"kind": "pulse", "torque_nm": [1.0, 0.0, 0.0], "start_s": 9.0, "duration_s": 1.0}
    lab.client.post(lab.session + "/loads", json=load).raise_for_status()
    lab.client.put(lab.session + "/effects", json={"delay_samples": 1}).raise_for_status()
    open_first(page, lab)
    expect(page.get_by_role("heading", name="Realism")).to_be_visible()
    expect(page.get_by_role("heading", name="Load", exact=True)).to_be_visible()


def test_identification_opens_from_all_controls(page: Page, lab: Lab) -> None:
    open_first(page, lab)
    page.get_by_role("switch", name="All controls").click()
    page.get_by_role("button", name="Identify …").click()
    panel = page.get_by_role("dialog", name="Identification")
    expect(panel.get_by_role("button", name="Excite and record")).to_be_enabled()
    page.keyboard.press("Escape")
    expect(panel).to_be_hidden()


def test_first_view_is_complete_at_each_size(page: Page, lab: Lab) -> None:
    open_first(page, lab)
    problems = measure(page, FIND_PROBLEMS, SIZES, LEAST_PLOT_PX["simulation"])
    assert not problems, "\n".join(problems)


def test_controller_uses_the_width_of_its_panel_on_a_tablet(page: Page, lab: Lab) -> None:
    page.set_viewport_size({"width": 820, "height": 1180})
    open_first(page, lab)
    panel, law = page.locator("#controls"), page.locator(".compare")
    until(page, lambda: get_box(law)["width"] > 0.7 * get_box(panel)["width"])


# Bars that stay at the top and the bottom of a phone, px.
BARS_PX = """() => [".topbar", ".load-place", ".statusbar"]
    .reduce((sum, one) => sum + document.querySelector(one).offsetHeight, 0)"""


def test_tabs_stay_and_bars_take_less_than_a_quarter_of_a_phone(page: Page, lab: Lab) -> None:
    open_first(page, lab)
    tabs = page.get_by_role("navigation", name="Pages")
    for is_full in (False, True):
        if is_full:
            page.get_by_role("switch", name="All controls").press("Enter")
            expect(page.get_by_role("switch", name="All controls", checked=True)).to_be_attached()
        for width, height in (*SIZES, (1121, 800)):
            resize(page, width, height)
            for name in ("Lab", "Runs", "Learn", "Grades", "Evaluation"):
                expect(tabs.get_by_role("link", name=name)).to_be_in_viewport(ratio=1)
        resize(page, *PHONE)
        page.wait_for_function(f"() => ({BARS_PX})() < innerHeight / 4")
    tabs.get_by_role("link", name="Runs").click()
    expect(page.get_by_role("main", name="Runs")).to_be_visible()
    until(page, lambda: get_box(page.locator(".topbar"))["height"] < 60)


def test_first_view_has_no_violation(page: Page, lab: Lab) -> None:
    open_first(page, lab)
    expect_no_violation(page, WIDE, PHONE)


def test_page_that_cannot_be_loaded_is_reported(page: Page, lab: Lab) -> None:
    """The pages of the evaluation are loaded when the first of them is opened."""
    open_first(page, lab)
    page.route("**/assets/otherpages-*.js", lambda route: route.abort())
    go_to_page(page, "Evaluation")
    expect(page.get_by_role("main")).to_have_text("Page not loaded. Reload the lab.")
    page.unroute("**/assets/otherpages-*.js")
    page.reload()
    expect(page.get_by_role("main", name="Ranking")).to_be_visible()


# The most frequent pixel color of the first plot's canvas.
COLOR = """() => {
    const canvas = document.querySelector(".plot canvas");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const counts = {};
    for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] < 255) continue;
        const color = data.slice(i, i + 3).join(" ");
        counts[color] = (counts[color] ?? 0) + 1;
    }
    return Object.entries(counts).sort(([, a], [, b]) => b - a)[0]?.[0] ?? "";
}"""


def test_plots_of_a_paused_session_take_the_colors_of_a_new_theme(page: Page, lab: Lab) -> None:
    colors = {}
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)  # pyright: ignore[reportArgumentType]
        open_first(page, lab)
        page.wait_for_function(f"() => ({COLOR})() !== ''")
        page.wait_for_function(IS_DRAWN_WHOLE)
        colors[scheme] = page.evaluate(COLOR)
    assert colors["light"] != colors["dark"]
    page.emulate_media(color_scheme="light")
    page.wait_for_function(f"() => ({COLOR})() === '{colors['light']}'")
