"""The page with a bench, which `bench_fixture` inserts between the page and a simulating lab."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.bench_fixture import HOMED, PatchedBench
from tests.browser.test_page import open_page
from tests.lab import Lab

BUTTONS = ("Arm", "Run", "Stop", "Clear fault")


@pytest.fixture(scope="module")
def opened_once(
    browser: Browser, browser_context_args: dict, shared_lab: Lab
) -> Iterator[PatchedBench]:
    shared_lab.load_figure()
    context = browser.new_context(**browser_context_args)
    context.route("**/viser/**", lambda route: route.fulfill(body="<title>3D</title>"))
    patched = PatchedBench(context.new_page())
    open_page(patched.page, shared_lab)
    yield patched
    context.close()


# Not named like its function, since a test imports both.
@pytest.fixture(name="patched")
def switch_off(
    opened_once: PatchedBench, browser_context_args: dict, still_lab: Lab
) -> PatchedBench:
    """Switch off the bench in the shared page of these tests."""
    patched, page = opened_once, opened_once.page
    page.set_viewport_size(browser_context_args["viewport"])
    # A running bench never opens the details automatically: only a click does.
    patched.become(status="run", homing=HOMED)
    expect_stage(page, "Run")
    if find_details(page).get_attribute("aria-expanded") == "true":
        page.reload()
        expect_stage(page, "Run")
    patched.become()
    expect_stage(page, "Off")
    return patched


@pytest.fixture(name="page")
def get_page(patched: PatchedBench) -> Page:
    return patched.page


def find_details(page: Page) -> Locator:
    return page.get_by_role("button", name="Details")


def find_bench(page: Page) -> Locator:
    return page.get_by_role("region", name="Bench", exact=True)


def expect_enabled(page: Page, *names: str) -> None:
    for name in BUTTONS:
        button = find_bench(page).get_by_role("button", name=name, exact=True)
        expect(button).to_be_enabled(enabled=name in names)


def expect_stage(page: Page, stage: str) -> None:
    line = page.get_by_role("list", name="State of the bench")
    expect(line.locator("[aria-current=step]")).to_contain_text(stage)
