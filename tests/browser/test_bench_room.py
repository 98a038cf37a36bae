"""A bench's messages and details leave space for the work: nothing of it is covered or cut."""

import re
from functools import partial

import pytest
from playwright.sync_api import Page, expect

from tests.browser.bench_fixture import FAULT, HOMED, PatchedBench
from tests.browser.bench_page import (
    find_bench,
    find_details,
    get_page,  # noqa: F401
    opened_once,  # noqa: F401
    switch_off,  # noqa: F401
)
from tests.browser.settled import find_lasting, get_box, resize, until
from tests.exhaustive import exhaust

pytestmark = pytest.mark.browser


@pytest.mark.parametrize("has_hold", [False, True], ids=["no switch", "dead-man's switch"])
def test_fault_and_opened_details_leave_space_for_the_actuator(
    page: Page, patched: PatchedBench, has_hold: bool
) -> None:
    problems = [f"Motor {motor} does not say that it is supervised." for motor in (1, 2)]
    patched.become(status="fault", fault=FAULT, problems=problems, dead_man=has_hold)
    expect(page.get_by_role("alert").filter(has_text="Quick stop.")).to_be_visible()
    find_details(page).click()
    expect(find_bench(page).get_by_text(problems[0])).to_be_visible()
    clear = find_bench(page).get_by_role("button", name="Clear fault")
    for height in (720, 900):
        resize(page, 1280, height)
        until(page, lambda: get_box(page.locator(".view"))["height"] > 150)
        calibration = page.get_by_role("region", name="Calibration")
        calibration.scroll_into_view_if_needed()
        expect(calibration).to_be_in_viewport()
        expect(clear).to_be_in_viewport(ratio=1)


def test_fault_is_visible_on_a_phone_with_the_details_opened(
    page: Page, patched: PatchedBench
) -> None:
    resize(page, 390, 844)
    patched.become(status="fault", fault=FAULT, problems=["Motor 1 says nothing."], dead_man=True)
    find_details(page).click()
    expect(find_bench(page).get_by_text("Motor 1 says nothing.")).to_be_visible()
    page.evaluate("scrollTo(0, 0)")
    reported = page.get_by_role("alert").filter(has_text="Quick stop.").get_by_text("Quick stop.")
    hang = page.get_by_role("button", name="Hang 3 kg")

    def is_above_the_load() -> bool:
        words = get_box(reported)
        return words["y"] + words["height"] < get_box(hang)["y"]

    until(page, is_above_the_load)


def test_view_and_plots_are_visible_without_scrolling_on_a_running_bench(
    page: Page, patched: PatchedBench
) -> None:
    """If not every plot fits, the visible ones are complete, and the number of others is shown."""
    patched.become(status="run", homing=HOMED)
    parts = [
        find_bench(page),
        page.get_by_role("button", name="Quick stop"),
        page.get_by_role("button", name=re.compile("Hang 3 kg")),
        page.locator("iframe"),
    ]
    last = {1280: "Stiffness", 1440: "Disturbance"}
    below = page.get_by_role("button", name=re.compile("below"))
    for (width, height), rest in {(1280, 720): 1, (1440, 900): 0}.items():
        page.set_viewport_size({"width": width, "height": height})
        plot = page.get_by_role("region", name=f"{last[width]} plot", exact=True)
        for part in [*parts, plot]:
            expect(part).to_be_in_viewport(ratio=1)
        expect(below).to_have_count(rest)


FIND_CUT = """cards => cards.filter(one => one.scrollWidth > one.clientWidth + 1)
    .map(one => `${one.ariaLabel}: ${one.scrollWidth} px in ${one.clientWidth}`)"""


@pytest.mark.parametrize("size", exhaust([(390, 844), (820, 1180), (1280, 720)], [(390, 844)]))
def test_nothing_of_a_bench_is_covered_or_cut(
    page: Page, patched: PatchedBench, size: tuple[int, int]
) -> None:
    page.set_viewport_size({"width": size[0], "height": size[1]})
    patched.become(status="ramp", emulated=False, homing=HOMED, ages_s=[1000, 1000, 0.001])
    expect(find_bench(page).get_by_text("Ramping down")).to_be_visible()
    bar = page.get_by_role("region", name="Status", exact=True)
    control = bar.get_by_role("button", name="Take control")
    stop = bar.get_by_role("button", name="Quick stop")

    def is_before_the_stop() -> bool:
        box = get_box(control)
        return box["x"] + box["width"] < get_box(stop)["x"]

    until(page, is_before_the_stop)
    find_details(page).click()
    cards = page.locator(".bench-card")
    expect(cards.first).to_be_visible()
    assert find_lasting(page, partial(cards.evaluate_all, FIND_CUT)) == []
