"""The page of a returning visitor on each kind of plant, and its problems at each size."""

from collections.abc import Iterator
from functools import partial
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from tests.browser.bench_fixture import HOMED, PatchedBench
from tests.browser.conftest import RETURNING
from tests.browser.settled import find_lasting, resize
from tests.browser.test_page import open_page
from tests.exhaustive import exhaust
from tests.lab import Lab

SIZES = ((390, 844), (820, 1180), (1280, 720), (1440, 900))
LEAST_PLOT_PX = {"simulation": 72, "running bench": 90, "bench to be homed": 90}
LEAST_MEASURED_PX = 60
PLANTS: dict[str, dict[str, Any] | None] = {
    "simulation": None,
    "running bench": {"status": "run", "homing": HOMED},
    "bench to be homed": {"status": "ready", "dead_man": True},
}


# Not named like its function, since a test imports both.
@pytest.fixture(name="visited", scope="module", params=exhaust(PLANTS, ["running bench"]))
def visit(request: pytest.FixtureRequest, browser: Browser, shared_lab: Lab) -> Iterator[Page]:
    """Open the page of a returning visitor, without the 3D view, on each kind of plant.

    It starts with a figure, because lanes and loads of another test module would take space on the
    page.
    """
    shared_lab.load_figure()
    context = browser.new_context()
    context.route("**/viser/**", lambda route: route.fulfill(body="<title>3D</title>"))
    context.add_init_script(RETURNING)
    page = context.new_page()
    bench = PLANTS[request.param]
    if bench is not None:
        PatchedBench(page, **bench)
    open_page(page, shared_lab)
    yield page
    context.close()


@pytest.fixture(name="least_plot_px")
def get_least_plot_px(visited: Page, request: pytest.FixtureRequest) -> int:
    """Return the minimum height of a plot of this plant's page."""
    return LEAST_PLOT_PX[request.node.callspec.params["visited"]]


def compare(page: Page, lab: Lab, is_on: bool, laws: tuple[str, ...] = ("fl",)) -> None:
    comparisons = [{"law": law} for law in laws] if is_on else []
    lab.client.put(lab.session + "/lanes", json={"comparisons": comparisons}).raise_for_status()
    rows = 1 + len(comparisons) if is_on else 0
    page.wait_for_function(
        f"() => document.querySelectorAll('.comparison tbody tr').length === {rows}"
    )


def measure(
    page: Page,
    find_problems: str,
    sizes: tuple[tuple[int, int], ...],
    least_plot_px: int | None = None,
) -> list[str]:
    """Return every lasting problem at every size, as a line."""
    lines = []
    for width, height in sizes:
        resize(page, width, height)
        found = find_lasting(page, partial(page.evaluate, find_problems, least_plot_px))
        lines += [f"{width}×{height}: {problem}" for problem in found]
    return lines
