"""The page at every size of screen: nothing covers, cuts or runs out of anything."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from tests.browser.bench_fixture import HOMED, PatchedBench
from tests.browser.measured_layout import FIND_POPUP_PROBLEMS, FIND_PROBLEMS
from tests.browser.test_page import open_page
from tests.lab import Lab

pytestmark = pytest.mark.browser

SIZES = ((390, 844), (820, 1180), (1280, 720), (1440, 900))
LEAST_PLOT_PX = 72
PLANTS: dict[str, dict[str, Any] | None] = {
    "simulation": None,
    "running bench": {"status": "run", "homing": HOMED},
    "bench to be homed": {"status": "ready", "dead_man": True},
}


@pytest.fixture(scope="module", params=list(PLANTS))
def visited(request: pytest.FixtureRequest, browser: Browser, shared_lab: Lab) -> Iterator[Page]:
    """The page of a returning visitor, without the 3D view, on each kind of plant."""
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


def compare(page: Page, lab: Lab, is_on: bool) -> None:
    rivals = [{"law": "fl"}] if is_on else []
    lab.client.put(lab.session + "/lanes", json={"rivals": rivals}).raise_for_status()
    page.wait_for_function(
        f"() => !!document.querySelector('.comparison') === {str(is_on).lower()}"
    )


def measure(
    page: Page,
    find_problems: str,
    least_plot_px: int | None = None,
    sizes: tuple[tuple[int, int], ...] = SIZES,
) -> list[str]:
    """Every problem at every size, as a line."""
    lines = []
    for width, height in sizes:
        page.set_viewport_size({"width": width, "height": height})
        found = page.evaluate(find_problems, least_plot_px)
        lines += [f"{width}×{height}: {problem}" for problem in found]
    return lines


@pytest.mark.parametrize("is_compared", [False, True], ids=["one lane", "compared"])
def test_nothing_is_covered_cut_or_out_of_its_panel(
    visited: Page, lab: Lab, is_compared: bool
) -> None:
    compare(visited, lab, is_compared)
    problems = measure(visited, FIND_PROBLEMS, LEAST_PLOT_PX)
    compare(visited, lab, is_on=False)
    assert not problems, "\n".join(problems)


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_what_opens_stays_on_the_screen(visited: Page) -> None:
    problems = measure(visited, FIND_POPUP_PROBLEMS, sizes=(SIZES[0], SIZES[2]))
    assert not problems, "\n".join(problems)
