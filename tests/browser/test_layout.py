"""The page at every size of screen: nothing covers, cuts or runs out of anything."""

import re
from collections.abc import Iterator
from functools import partial
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.bench_fixture import HOMED, PatchedBench
from tests.browser.measured_layout import FIND_POPUP_PROBLEMS, FIND_PROBLEMS
from tests.browser.settled import find_lasting, get_box, resize, until
from tests.browser.test_page import open_page
from tests.exhaustive import exhaust
from tests.lab import Lab

pytestmark = pytest.mark.browser

SIZES = ((390, 844), (820, 1180), (1280, 720), (1440, 900))
LEAST_PLOT_PX = {"simulation": 72, "running bench": 90, "bench to be homed": 90}
LEAST_MEASURED_PX = 60
PLANTS: dict[str, dict[str, Any] | None] = {
    "simulation": None,
    "running bench": {"status": "run", "homing": HOMED},
    "bench to be homed": {"status": "ready", "dead_man": True},
}


@pytest.fixture(scope="module", params=exhaust(PLANTS, ["running bench"]))
def visited(request: pytest.FixtureRequest, browser: Browser, shared_lab: Lab) -> Iterator[Page]:
    """The page of a returning visitor, without the 3D view, on each kind of plant.

    From a figure on: lanes and loads that another module has left take room.
    """
    shared_lab.load_figure()
    context = browser.new_context()
    context.route("**/viser/**", lambda route: route.fulfill(body="<title>3D</title>"))
    context.add_init_script("localStorage.setItem('svsa.tour', 'done')")
    page = context.new_page()
    bench = PLANTS[request.param]
    if bench is not None:
        PatchedBench(page, **bench)
    open_page(page, shared_lab)
    yield page
    context.close()


@pytest.fixture
def least_plot_px(visited: Page, request: pytest.FixtureRequest) -> int:
    """How high a plot of this plant's page is at least."""
    return LEAST_PLOT_PX[request.node.callspec.params["visited"]]


# The list finds how high its plots are after each change of its own height.
WHOLE_PLOTS = """() => {
    const foot = document.querySelector(".plots-foot").getBoundingClientRect().top;
    return [...document.querySelectorAll(".plots-stage > .plot")]
        .map((one) => one.getBoundingClientRect())
        .every(({ top, bottom }) => top >= foot - 1 || bottom <= foot + 2);
}"""


def compare(page: Page, lab: Lab, is_on: bool, laws: tuple[str, ...] = ("fl",)) -> None:
    rivals = [{"law": law} for law in laws] if is_on else []
    lab.client.put(lab.session + "/lanes", json={"rivals": rivals}).raise_for_status()
    rows = 1 + len(rivals) if is_on else 0
    page.wait_for_function(
        f"() => document.querySelectorAll('.comparison tbody tr').length === {rows}"
    )


def measure(
    page: Page,
    find_problems: str,
    sizes: tuple[tuple[int, int], ...],
    least_plot_px: int | None = None,
) -> list[str]:
    """Every problem at every size that is one for good, as a line."""
    lines = []
    for width, height in sizes:
        resize(page, width, height)
        found = find_lasting(page, partial(page.evaluate, find_problems, least_plot_px))
        lines += [f"{width}×{height}: {problem}" for problem in found]
    return lines


@pytest.mark.smoke
@pytest.mark.parametrize("sizes", exhaust([SIZES[::2], SIZES[1::2]], [SIZES[::2]]))
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


def test_the_top_bar_has_few_rows_and_no_more_while_it_records(
    visited: Page, still_lab: Lab
) -> None:
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
            expect(record).to_be_in_viewport(ratio=1)
    still_lab.client.delete(recording).raise_for_status()
    expect(record).to_have_text("Record")


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_four_controllers_and_the_last_event_are_read_whole_on_a_phone(
    visited: Page, still_lab: Lab
) -> None:
    resize(visited, 390, 844)
    zoom = visited.get_by_role("button", name="Last event")
    zoom.click()
    compare(visited, still_lab, True, ("prescribed_performance", "super_twisting", "fl_integral"))
    title = visited.locator(".zoom-title")
    expect(title).to_contain_text("beside")

    def are_read_whole() -> bool:
        table, plots = (get_box(visited.locator(one)) for one in (".comparison", ".plots"))
        told, box = get_box(title.locator("span")), get_box(title)
        is_within = box["y"] <= told["y"] <= box["y"] + box["height"] - told["height"] + 1
        return is_within and table["width"] <= plots["width"] + 1

    until(visited, are_read_whole)
    compare(visited, still_lab, is_on=False)
    zoom.click()


# What a bench and its twin are called, and the longest values of their table.
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
def test_the_table_of_a_bench_takes_no_room_from_its_plots(visited: Page, still_lab: Lab) -> None:
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


def test_a_low_list_of_plots_shows_whole_ones_and_says_how_many_are_below(visited: Page) -> None:
    resize(visited, 1280, 720)
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

    def are_whole_and_told() -> bool:
        canvases = visited.locator(".plots-stage .plot-canvas").all()
        is_high = all(get_box(one)["height"] >= LEAST_MEASURED_PX for one in canvases)
        return is_high and visited.evaluate(WHOLE_PLOTS) and find_below().is_visible()

    until(visited, are_whole_and_told)
    last = plots.nth(count_seen())
    find_below().press("Enter")
    until(visited, lambda: get_box(last)["y"] < 500)
    visited.get_by_role("button", name="Cursors").click()


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_a_list_of_plots_shows_whole_ones_where_legends_have_two_rows(
    visited: Page, still_lab: Lab
) -> None:
    """Controllers that followed one another, each with its entry in every legend."""
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

    def are_whole_below_two_rows() -> bool:
        foot = get_box(visited.locator(".plots-foot"))["y"]
        last = get_box(visited.locator(".plots-stage > .plot").last)["y"]
        is_high = get_box(visited.locator(".plot-head").first)["height"] > 40
        return is_high and last >= foot - 1 and visited.evaluate(WHOLE_PLOTS)

    until(visited, are_whole_below_two_rows)
    expect(visited.get_by_role("button", name=re.compile("more plots? below"))).to_be_visible()


# What a recording of before has left says so for 20 s.
DISMISS_NEWS = """() => {
    for (const one of document.querySelectorAll(".banner.is-news button.quiet")) one.click();
}"""


@pytest.mark.parametrize("visited", ["running bench", "bench to be homed"], indirect=True)
def test_opened_details_of_a_bench_leave_room_for_the_actuator_and_two_plots(
    visited: Page, least_plot_px: int
) -> None:
    resize(visited, 1280, 720)
    details = visited.locator(".details-button")
    if details.get_attribute("aria-expanded") == "false":
        details.click()
    expect(visited.locator(".bench-details")).to_be_visible()

    def leave_room() -> bool:
        visited.evaluate(DISMISS_NEWS)
        foot = get_box(visited.locator(".plots-foot"))["y"]
        plots = [get_box(one) for one in visited.locator(".plots-stage > .plot").all()]
        whole = [one for one in plots if one["y"] + one["height"] <= foot + 2]
        is_high = get_box(visited.locator(".plot-canvas").first)["height"] >= least_plot_px
        return is_high and len(whole) >= 2 and get_box(visited.locator(".view"))["height"] > 160

    until(visited, leave_room)


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_what_is_refused_at_the_edge_of_the_panel_is_brought_into_sight(
    visited: Page, still_lab: Lab
) -> None:
    resize(visited, 1280, 720)
    still_lab.client.post(still_lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
    visited.get_by_role("button", name="Excite and record").click()
    refused = visited.get_by_text("take every load off first")
    expect(refused).to_be_in_viewport(ratio=1)
    groups = visited.get_by_role("group", name="Controls", exact=True).locator(".groups")

    def is_above_the_edge() -> bool:
        edge, box = get_box(groups), get_box(refused)
        return box["y"] + box["height"] <= edge["y"] + edge["height"]

    until(visited, is_above_the_edge)


def test_every_group_of_controls_is_in_sight_or_named_at_the_edge(visited: Page) -> None:
    resize(visited, 1280, 720)
    visited.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = true")
    panel = visited.get_by_role("group", name="Controls", exact=True)
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


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_what_opens_stays_on_the_screen(visited: Page) -> None:
    problems = measure(visited, FIND_POPUP_PROBLEMS, SIZES[::2])
    assert not problems, "\n".join(problems)


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_what_is_open_follows_its_button_where_the_window_changes(visited: Page) -> None:
    resize(visited, 1440, 900)
    visited.get_by_role("button", name="Plots", exact=True).click()
    opened = visited.locator(".popup:popover-open")
    expect(opened).to_be_in_viewport(ratio=1)
    resize(visited, 1280, 720)
    expect(opened).to_be_in_viewport(ratio=1)
    visited.keyboard.press("Escape")
