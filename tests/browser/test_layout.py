"""The page at every screen size: no element is covered, cut or outside of its panel."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.measured_layout import FIND_PROBLEMS
from tests.browser.settled import get_box, resize, until
from tests.browser.visited_layout import (
    SIZES,
    compare,
    get_least_plot_px,  # noqa: F401
    measure,
    visit,  # noqa: F401
)
from tests.lab import Lab

pytestmark = pytest.mark.browser


@pytest.mark.exhaustive
@pytest.mark.parametrize("sizes", [SIZES[::2], SIZES[1::2]])
@pytest.mark.parametrize("is_compared", [False, True], ids=["one lane", "compared"])
def test_nothing_is_covered_cut_or_out_of_its_panel(
    visited: Page,
    still_lab: Lab,
    least_plot_px: int,
    is_compared: bool,
    sizes: tuple[tuple[int, int], ...],
) -> None:
    compare(visited, still_lab, is_compared)
    problems = measure(visited, FIND_PROBLEMS, sizes, least_plot_px)
    compare(visited, still_lab, is_on=False)
    assert not problems, "\n".join(problems)


# Rows of buttons, counted by their middles.
COUNT_ROWS = """() => {
    const middles = [...document.querySelectorAll(".topbar :is(button, select)")]
        .map((one) => one.getBoundingClientRect()).filter(({ width }) => width > 1)
        .map(({ top, bottom }) => Math.round((top + bottom) / 20));
    return new Set(middles).size;
}"""


def test_top_bar_has_few_rows_also_during_a_recording(visited: Page, still_lab: Lab) -> None:
    recording = still_lab.session + "/recording"
    record = visited.get_by_role("button", name=re.compile("^Record"))
    expect(record).to_have_text("Record")
    most = {390: 3, 820: 2, 1280: 1, 1440: 1}
    for is_on in (False, True):
        if is_on:
            still_lab.client.post(recording, json={"name": ""}).raise_for_status()
            expect(record).to_have_text(re.compile("^Recording"))
        for width, height in SIZES:
            resize(visited, width, height)
            has_few = f"() => ({COUNT_ROWS})() <= {most[width]}"
            visited.wait_for_function(has_few)
            # Other tests of this page have scrolled the bar of a phone.
            visited.locator(".topbar-controls").evaluate("(bar) => bar.scrollTo(0, 0)")
            expect(record).to_be_in_viewport(ratio=1)
    still_lab.client.delete(recording).raise_for_status()
    expect(record).to_have_text("Record")


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_four_controllers_and_the_last_event_are_readable_on_a_phone(
    visited: Page, still_lab: Lab
) -> None:
    resize(visited, 390, 844)
    zoom = visited.get_by_role("button", name="Last event")
    zoom.click()
    compare(visited, still_lab, True, ("prescribed_performance", "super_twisting", "fl_integral"))
    title = visited.locator(".zoom-title")
    expect(title).to_contain_text("added")

    def are_read_whole() -> bool:
        table, plots = (get_box(visited.locator(one)) for one in (".comparison", ".plots"))
        reported, box = get_box(title.locator("span")), get_box(title)
        is_within = box["y"] <= reported["y"] <= box["y"] + box["height"] - reported["height"] + 1
        return is_within and table["width"] <= plots["width"] + 1

    until(visited, are_read_whole)
    compare(visited, still_lab, is_on=False)
    zoom.click()


# The names of a bench and its twin, and the longest values of their table.
NAME_LIKE_A_BENCH = """() => {
    const rows = document.querySelectorAll(".comparison tbody tr");
    rows.forEach((row, index) => {
        row.querySelector(".legend-name").textContent = ["Bench NDOBC-W", "Twin NDOBC-W"][index];
        ["−0.012", "✓ 0.012", "✓ 0.012"].forEach((value, at) => {
            row.querySelectorAll("td")[at].textContent = value;
        });
    });
}"""


@pytest.mark.parametrize("visited", ["running bench"], indirect=True)
def test_table_of_a_bench_takes_no_space_from_its_plots(visited: Page, still_lab: Lab) -> None:
    resize(visited, 1280, 720)
    alone = get_box(visited.locator(".plots"))["width"]
    compare(visited, still_lab, is_on=True)
    table, view, plots = (visited.locator(one) for one in (".comparison", ".view", ".plots"))
    tools = visited.get_by_role("toolbar", name="Plot tools")

    def has_its_room() -> bool:
        visited.evaluate(NAME_LIKE_A_BENCH)
        is_narrow = get_box(table)["width"] <= get_box(view)["width"] + 1
        is_one_row = get_box(tools)["height"] < 40
        return is_narrow and is_one_row and abs(get_box(plots)["width"] - alone) <= 1

    until(visited, has_its_room)
    compare(visited, still_lab, is_on=False)
