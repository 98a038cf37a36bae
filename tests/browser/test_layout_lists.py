"""Plots and controls without space are listed at the edge, and visible ones are complete."""

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.settled import get_box, resize, until
from tests.browser.visited_layout import (
    LEAST_MEASURED_PX,
    get_least_plot_px,  # noqa: F401
    visit,  # noqa: F401
)
from tests.lab import Lab

pytestmark = pytest.mark.browser

# The list computes the height of its plots after each change of its own height.
WHOLE_PLOTS = """() => {
    const foot = document.querySelector(".plots-foot").getBoundingClientRect().top;
    return [...document.querySelectorAll(".plots-stage > .plot")]
        .map((one) => one.getBoundingClientRect())
        .every(({ top, bottom }) => top >= foot - 1 || bottom <= foot + 2);
}"""


def test_low_list_of_plots_shows_complete_ones_and_counts_those_below(visited: Page) -> None:
    resize(visited, 1280, 600)
    visited.locator(".plots-scroll").evaluate("list => list.scrollTo(0, 0)")
    visited.get_by_role("button", name="Cursors").click()
    expect(visited.get_by_role("button", name="Cursors")).to_have_attribute("aria-pressed", "true")
    plots = visited.locator(".plots-stage > .plot")

    def count_seen() -> int:
        foot = get_box(visited.locator(".plots-foot"))["y"]
        return sum(get_box(one)["y"] < foot - 1 for one in plots.all())

    def find_below() -> Locator:
        many = plots.count() - count_seen()
        return visited.get_by_role("button", name=re.compile(f"^{many} more plots? below"))

    def are_whole_and_named() -> bool:
        canvases = visited.locator(".plots-stage .plot-canvas").all()
        is_high = all(get_box(one)["height"] >= LEAST_MEASURED_PX for one in canvases)
        return is_high and visited.evaluate(WHOLE_PLOTS) and find_below().is_visible()

    until(visited, are_whole_and_named)
    last = plots.nth(count_seen())
    find_below().press("Enter")
    until(visited, lambda: get_box(last)["y"] < 500)
    visited.get_by_role("button", name="Cursors").click()


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_cursors_leave_all_plots_in_view(visited: Page) -> None:
    resize(visited, 1280, 720)
    cursors = visited.get_by_role("button", name="Cursors")
    cursors.click()
    below = visited.get_by_role("button", name=re.compile("more plots? below"))
    until(visited, lambda: visited.evaluate(WHOLE_PLOTS) and below.count() == 0)
    cursors.click()


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_legend_of_many_controllers_has_one_row_and_plots_stay_complete(
    visited: Page, still_lab: Lab
) -> None:
    """Successive controllers, each with its entry in every legend."""
    resize(visited, 1280, 900)
    still_lab.jump(1)
    for bandwidth in (40, 50, 70, 80):
        channels = [float(bandwidth)] * 3
        path = still_lab.session + "/observer"
        request = {"bandwidth_rad_per_s": channels}
        still_lab.client.put(path, json=request).raise_for_status()
        still_lab.jump(1)
    entries = visited.locator(".plot").first.locator(".legend-entry")
    expect(entries).to_have_count(6)
    visited.locator(".plots-scroll").evaluate("part => part.scrollTo({ top: 0 })")

    def are_whole_below_one_row() -> bool:
        is_low = get_box(visited.locator(".plot-head").first)["height"] <= 40
        return is_low and bool(visited.evaluate(WHOLE_PLOTS))

    until(visited, are_whole_below_one_row)


# A notice of an earlier recording is shown for 20 s.
DISMISS_NOTICES = """() => {
    for (const one of document.querySelectorAll(".banner.is-news button.quiet")) one.click();
}"""


@pytest.mark.parametrize("visited", ["running bench", "bench to be homed"], indirect=True)
def test_opened_details_of_a_bench_leave_space_for_the_actuator_and_two_plots(
    visited: Page, least_plot_px: int
) -> None:
    resize(visited, 1280, 720)
    details = visited.locator(".details-button")
    if details.get_attribute("aria-expanded") == "false":
        details.click()
    expect(visited.locator(".bench-details")).to_be_visible()

    def leave_room() -> bool:
        visited.evaluate(DISMISS_NOTICES)
        foot = get_box(visited.locator(".plots-foot"))["y"]
        plots = [get_box(one) for one in visited.locator(".plots-stage > .plot").all()]
        whole = [one for one in plots if one["y"] + one["height"] <= foot + 2]
        is_high = get_box(visited.locator(".plot-canvas").first)["height"] >= least_plot_px
        return is_high and len(whole) >= 2 and get_box(visited.locator(".view"))["height"] > 160

    until(visited, leave_room)


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_rejection_at_the_edge_of_the_panel_is_scrolled_into_view(
    visited: Page, still_lab: Lab
) -> None:
    resize(visited, 1280, 720)
    still_lab.client.post(still_lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
    # No click: once the end of the panel is in view no group is named below it, and all moves.
    visited.get_by_role("spinbutton", name="Bandwidth β").fill("-1")
    visited.get_by_role("spinbutton", name="Bandwidth β").press("Enter")
    refused = visited.get_by_text("Bandwidth β: −1 rad/s is out of range")
    expect(refused).to_be_in_viewport(ratio=1)
    groups = visited.get_by_role("region", name="Controls", exact=True).locator(".groups")

    def is_above_the_edge() -> bool:
        edge, box = get_box(groups), get_box(refused)
        return box["y"] + box["height"] <= edge["y"] + edge["height"]

    until(visited, is_above_the_edge)


def test_every_group_of_controls_is_visible_or_named_at_the_edge(visited: Page) -> None:
    resize(visited, 1280, 720)
    visited.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = true")
    panel = visited.get_by_role("region", name="Controls", exact=True)
    panel.locator(".groups").evaluate("list => list.scrollTo(0, 0)")
    below = visited.get_by_role("navigation", name="Controls below")
    titles = panel.get_by_role("heading", level=2)
    links = panel.get_by_role("navigation").get_by_role("link")

    def are_named() -> bool:
        edge = get_box(below)["y"]
        hidden = [one.inner_text() for one in titles.all() if get_box(one)["y"] + 10 > edge]
        return hidden != [] and links.all_inner_texts() == hidden

    until(visited, are_named)
    links.last.click()
    expect(titles.last).to_be_in_viewport()
    expect(titles.last).to_be_focused()
