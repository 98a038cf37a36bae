"""The page at every size of screen: nothing covers, cuts or runs out of anything."""

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, FloatRect, Locator, Page, expect

from tests.browser.bench_fixture import HOMED, PatchedBench
from tests.browser.measured_layout import FIND_POPUP_PROBLEMS, FIND_PROBLEMS
from tests.browser.test_page import open_page
from tests.exhaustive import exhaust
from tests.lab import Lab

pytestmark = pytest.mark.browser

SIZES = ((390, 844), (820, 1180), (1280, 720), (1440, 900))
LEAST_PLOT_PX = {"simulation": 72, "running bench": 90, "bench to be homed": 90}
LEAST_MEASURED_PX = 60
LOOKS, BETWEEN_LOOKS_MS = 5, 300
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


def get_box(one: Locator) -> FloatRect:
    box = one.bounding_box()
    assert box is not None
    return box


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
    least_plot_px: int | None = None,
    sizes: tuple[tuple[int, int], ...] = SIZES,
) -> list[str]:
    """Every problem at every size that is one for good, as a line.

    The page finds its place anew at each size: what is looked at before that is looked at again.
    """
    lines = []
    for width, height in sizes:
        page.set_viewport_size({"width": width, "height": height})
        for _ in range(LOOKS):
            found = page.evaluate(find_problems, least_plot_px)
            if not found:
                break
            page.wait_for_timeout(BETWEEN_LOOKS_MS)
        lines += [f"{width}×{height}: {problem}" for problem in found]
    return lines


@pytest.mark.parametrize("is_compared", [False, True], ids=["one lane", "compared"])
def test_nothing_is_covered_cut_or_out_of_its_panel(
    visited: Page, lab: Lab, least_plot_px: int, is_compared: bool
) -> None:
    compare(visited, lab, is_compared)
    problems = measure(visited, FIND_PROBLEMS, least_plot_px)
    compare(visited, lab, is_on=False)
    assert not problems, "\n".join(problems)


# Rows of buttons, counted by their middles.
COUNT_ROWS = """() => {
    const middles = [...document.querySelectorAll(".topbar :is(button, select)")]
        .map((one) => one.getBoundingClientRect()).filter(({ width }) => width > 1)
        .map(({ top, bottom }) => Math.round((top + bottom) / 20));
    return new Set(middles).size;
}"""


def test_the_top_bar_has_few_rows_and_no_more_while_it_records(visited: Page, lab: Lab) -> None:
    recording = lab.session + "/recording"
    record = visited.get_by_role("button", name=re.compile("^Record"))
    expect(record).to_have_text("Record")
    rows = {}
    for is_on in (False, True):
        if is_on:
            lab.client.post(recording, json={"name": ""}).raise_for_status()
            expect(record).to_have_text(re.compile("^Recording"))
        for width, height in SIZES:
            visited.set_viewport_size({"width": width, "height": height})
            rows[width, is_on] = visited.evaluate(COUNT_ROWS)
            expect(record).to_be_in_viewport(ratio=1)
    lab.client.delete(recording).raise_for_status()
    expect(record).to_have_text("Record")
    most = {390: 3, 820: 2, 1280: 1, 1440: 1}
    assert not {key: count for key, count in rows.items() if count > most[key[0]]}


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_four_controllers_and_the_last_event_are_read_whole_on_a_phone(
    visited: Page, lab: Lab
) -> None:
    visited.set_viewport_size({"width": 390, "height": 844})
    zoom = visited.get_by_role("button", name="Last event")
    zoom.click()
    compare(visited, lab, True, ("prescribed_performance", "super_twisting", "fl_integral"))
    table, plots = (get_box(visited.locator(one)) for one in (".comparison", ".plots"))
    title = visited.locator(".zoom-title")
    expect(title).to_contain_text("beside")
    told, box = get_box(title.locator("span")), get_box(title)
    compare(visited, lab, is_on=False)
    zoom.click()
    assert table["width"] <= plots["width"] + 1
    assert box["y"] <= told["y"]
    assert told["y"] + told["height"] <= box["y"] + box["height"] + 1


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
def test_the_table_of_a_bench_takes_no_room_from_its_plots(visited: Page, lab: Lab) -> None:
    visited.set_viewport_size({"width": 1280, "height": 720})
    alone = get_box(visited.locator(".plots"))["width"]
    compare(visited, lab, is_on=True)
    visited.evaluate(NAME_LIKE_A_BENCH)
    beside = get_box(visited.locator(".plots"))["width"]
    table, view = (get_box(visited.locator(one)) for one in (".comparison", ".view"))
    tools = get_box(visited.get_by_role("toolbar", name="Plot tools"))["height"]
    compare(visited, lab, is_on=False)
    assert beside == pytest.approx(alone, abs=1)
    assert table["width"] <= view["width"] + 1
    assert tools < 40, "one row"


def test_a_low_list_of_plots_shows_whole_ones_and_says_how_many_are_below(visited: Page) -> None:
    visited.set_viewport_size({"width": 1280, "height": 720})
    visited.locator(".plots-scroll").evaluate("list => list.scrollTo(0, 0)")
    visited.get_by_role("button", name="Cursors").click()
    expect(visited.get_by_role("button", name="Cursors")).to_have_attribute("aria-pressed", "true")
    visited.wait_for_function(WHOLE_PLOTS)
    heights = [
        box["height"] for box in map(get_box, visited.locator(".plots-stage .plot-canvas").all())
    ]
    foot = get_box(visited.locator(".plots-foot"))["y"]
    seen = [
        one for one in visited.locator(".plots-stage > .plot").all() if get_box(one)["y"] < foot - 1
    ]
    many = len(heights) - len(seen)
    below = visited.get_by_role("button", name=re.compile(f"^{many} more plots? below"))
    expect(below).to_be_visible()
    below.press("Enter")
    last = visited.locator(".plots-stage > .plot").nth(len(seen))
    visited.wait_for_function(
        "one => one.getBoundingClientRect().top < 500", arg=last.element_handle()
    )
    visited.get_by_role("button", name="Cursors").click()
    assert min(heights) >= LEAST_MEASURED_PX


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_a_list_of_plots_shows_whole_ones_where_legends_have_two_rows(
    visited: Page, lab: Lab
) -> None:
    """Controllers that followed one another, each with its entry in every legend."""
    visited.set_viewport_size({"width": 1280, "height": 900})
    lab.jump(1)
    for bandwidth in (40, 50, 70, 80):
        channels = [float(bandwidth)] * 3
        path = lab.session + "/observer"
        request = {"bandwidth_rad_per_s": channels}
        lab.client.put(path, json=request).raise_for_status()
        lab.jump(1)
    entries = visited.locator(".plot").first.locator(".legend-entry")
    expect(entries).to_have_count(6)
    visited.locator(".plots-scroll").evaluate("part => part.scrollTo({ top: 0 })")
    visited.wait_for_function(WHOLE_PLOTS)
    foot = get_box(visited.locator(".plots-foot"))["y"]
    plots = [get_box(one) for one in visited.locator(".plots-stage > .plot").all()]
    seen = [one for one in plots if one["y"] < foot - 1]
    assert get_box(visited.locator(".plot-head").first)["height"] > 40
    assert len(seen) < len(plots)
    expect(visited.get_by_role("button", name=re.compile("more plots? below"))).to_be_visible()


@pytest.mark.parametrize("visited", ["running bench", "bench to be homed"], indirect=True)
def test_opened_details_of_a_bench_leave_room_for_the_actuator_and_two_plots(
    visited: Page, least_plot_px: int
) -> None:
    visited.set_viewport_size({"width": 1280, "height": 720})
    details = visited.locator(".details-button")
    if details.get_attribute("aria-expanded") == "false":
        details.click()
    expect(visited.locator(".bench-details")).to_be_visible()
    for saved in visited.locator(".banner.is-news button.quiet:visible").all():
        saved.click()  # what a recording of before has left says so for 20 s
    visited.wait_for_function(WHOLE_PLOTS)
    assert get_box(visited.locator(".view"))["height"] > 160
    foot = get_box(visited.locator(".plots-foot"))["y"]
    plots = [get_box(one) for one in visited.locator(".plots-stage > .plot").all()]
    whole = [one for one in plots if one["y"] + one["height"] <= foot + 2]
    assert len(whole) >= 2
    assert get_box(visited.locator(".plot-canvas").first)["height"] >= least_plot_px


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_what_is_refused_at_the_edge_of_the_panel_is_brought_into_sight(
    visited: Page, lab: Lab
) -> None:
    visited.set_viewport_size({"width": 1280, "height": 720})
    lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
    visited.get_by_role("button", name="Excite and record").click()
    refused = visited.get_by_text("take every load off first")
    expect(refused).to_be_in_viewport(ratio=1)
    edge = get_box(visited.get_by_role("group", name="Controls", exact=True).locator(".groups"))
    box = get_box(refused)
    assert box["y"] + box["height"] <= edge["y"] + edge["height"]


def test_every_group_of_controls_is_in_sight_or_named_at_the_edge(visited: Page) -> None:
    visited.set_viewport_size({"width": 1280, "height": 720})
    visited.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = true")
    panel = visited.get_by_role("group", name="Controls", exact=True)
    panel.locator(".groups").evaluate("list => list.scrollTo(0, 0)")
    edge = get_box(visited.get_by_role("navigation", name="Controls below"))["y"]
    titles = panel.get_by_role("heading", level=2).all()
    hidden = [one.inner_text() for one in titles if get_box(one)["y"] + 10 > edge]
    links = panel.get_by_role("navigation").get_by_role("link")
    assert hidden
    expect(links).to_have_text(hidden)
    links.last.click()
    expect(titles[-1]).to_be_in_viewport()
    expect(titles[-1]).to_be_focused()


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_what_opens_stays_on_the_screen(visited: Page) -> None:
    problems = measure(visited, FIND_POPUP_PROBLEMS, sizes=(SIZES[0], SIZES[2]))
    assert not problems, "\n".join(problems)


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_what_is_open_follows_its_button_where_the_window_changes(visited: Page) -> None:
    visited.set_viewport_size({"width": 1440, "height": 900})
    visited.get_by_role("button", name="Plots", exact=True).click()
    opened = visited.locator(".popup:popover-open")
    expect(opened).to_be_in_viewport(ratio=1)
    visited.set_viewport_size({"width": 1280, "height": 720})
    expect(opened).to_be_in_viewport(ratio=1)
    visited.keyboard.press("Escape")
