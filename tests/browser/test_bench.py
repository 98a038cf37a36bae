"""The controls of a bench, and the display of its state and its faults."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.bench_fixture import BENCH, HOMED, PatchedBench
from tests.browser.bench_page import (
    expect_enabled,
    expect_stage,
    find_bench,
    find_details,
    get_page,  # noqa: F401
    opened_once,  # noqa: F401
    switch_off,  # noqa: F401
)
from tests.browser.test_page import open_page
from tests.exhaustive import exhaust
from tests.lab import Lab

pytestmark = pytest.mark.browser


@pytest.mark.usefixtures("without_3d")
def test_simulation_shows_no_bench_and_no_mark(kept_page: Page, still_lab: Lab) -> None:
    open_page(kept_page, still_lab)
    expect(find_bench(kept_page)).to_have_count(0)
    expect(kept_page.get_by_text(re.compile("EMULATED|REAL BENCH"))).to_have_count(0)
    expect(kept_page).to_have_title("SVSA Lab")


MARKS = {True: "EMULATED", False: "REAL BENCH", None: "BENCH"}


@pytest.mark.parametrize("emulated", exhaust(MARKS, [False]))
def test_mark_is_in_banner_view_status_bar_and_tab(
    page: Page, patched: PatchedBench, emulated: bool | None
) -> None:
    name = MARKS[emulated]
    patched.become(emulated=emulated)
    expect(page).to_have_title(re.compile(f"^{name}"))
    expect(page.get_by_text(name, exact=True)).to_have_count(3)
    for mark in page.get_by_text(name, exact=True).all():
        expect(mark).to_be_in_viewport(ratio=1)
    icon = page.locator('link[rel="icon"]')
    expect(icon).not_to_have_attribute("href", "./icon.svg")


def test_unavailable_bench_actions_are_disabled(page: Page) -> None:
    for name in ("Reset", "Step", "Pause"):
        expect(page.get_by_role("button", name=name, exact=True)).to_have_count(0)
    expect(page.get_by_role("combobox", name="Speed")).to_have_count(0)


@pytest.mark.smoke
def test_bench_goes_from_off_over_the_marks_to_a_run_and_its_stop(
    page: Page, patched: PatchedBench
) -> None:
    bench = find_bench(page)
    expect_stage(page, "Off")
    expect_enabled(page, "Arm")
    bench.get_by_role("button", name="Arm").click()
    expect_stage(page, "Ready")
    expect_enabled(page)

    confirm = bench.get_by_role("button", name="Motor 1 is at its mark")
    expect(confirm).to_be_disabled()
    expect(bench.get_by_text(BENCH["homing"]["instruction"])).to_be_visible()
    bench.get_by_label("Your name").fill("Grace")
    confirm.click()
    expect_enabled(page, "Run")
    assert ("bench/home", {"step": "motor1", "by": "Grace"}) in patched.calls

    bench.get_by_role("button", name="Run", exact=True).click()
    expect_stage(page, "Run")
    expect_enabled(page, "Stop")
    bench.get_by_role("button", name="Stop", exact=True).click()
    expect_enabled(page, "Run")
    patched.change(status="ramp")
    expect(bench.get_by_text("Ramping down")).to_be_visible()
    expect_enabled(page)


def test_space_stops_a_bench_and_never_starts_it(page: Page, patched: PatchedBench) -> None:
    patched.become(status="run", homing=HOMED)
    expect_stage(page, "Run")
    page.keyboard.press("Space")
    expect_stage(page, "Ready")
    page.keyboard.press("Space")
    page.keyboard.press("Shift+Escape")
    expect(page.get_by_role("alert").filter(has_text="Quick stop.")).to_be_visible()
    assert patched.commands == ["pause", "quick-stop"]


@pytest.mark.smoke
def test_quick_stop_is_latched_until_the_fault_is_cleared(
    page: Page, patched: PatchedBench
) -> None:
    patched.become(status="run", homing=HOMED)
    expect_stage(page, "Run")
    page.keyboard.press("Shift+Escape")
    banner = page.get_by_role("alert").filter(has_text="Quick stop.")
    expect(banner).to_contain_text("until the fault is cleared")
    expect(page.get_by_role("list", name="To continue")).to_be_visible()
    expect_enabled(page, "Clear fault")
    page.reload()
    expect(banner).to_be_visible()
    find_bench(page).get_by_role("button", name="Clear fault").click()
    expect(banner).to_have_count(0)
    expect_enabled(page, "Arm")
    assert patched.commands == ["quick-stop", "bench/clear"]


def test_problem_that_prevents_arming_is_shown_and_the_rest_is_in_the_details(
    page: Page, patched: PatchedBench
) -> None:
    patched.become(problems=["Calibration is 190 days old: at most 180."])
    expect_enabled(page)
    problems = page.get_by_role("region", name="Arming is blocked by")
    expect(problems.get_by_text("at most 180")).to_be_visible()
    expect(page.get_by_role("region", name="Calibration")).to_contain_text("Ada Lovelace")
    loop = page.get_by_role("region", name="Control loop")
    expect(loop.get_by_role("img")).to_have_accessible_name(re.compile("99 % up to 71 µs"))
    expect(loop.get_by_text("memory locked")).to_be_visible()
    patched.change(ages_s=[0.0012, 0.008, 0.03], supervised=False)
    drives = page.get_by_role("region", name="Drives and encoders")
    expect(drives.get_by_role("row", name=re.compile("Motor 2"))).to_contain_text("stale")
    expect(drives.get_by_role("row", name=re.compile("Deflection"))).to_contain_text("lost")
    expect(drives.get_by_text("no heartbeat")).to_be_visible()


def test_status_bar_shows_the_lateness_of_a_bench(page: Page, patched: PatchedBench) -> None:
    bar = page.get_by_role("region", name="Status", exact=True)
    expect(bar.get_by_text("late 24 µs / 71 µs · 3 skipped in this run")).to_be_visible()
    patched.change(loop=BENCH["loop"] | {"alive": False, "state": "gone"})
    expect(bar.get_by_text("ended")).to_be_visible()


def test_load_button_only_marks_the_load_on_a_real_bench(
    page: Page, patched: PatchedBench, still_lab: Lab
) -> None:
    patched.become(emulated=False, status="run", homing=HOMED)
    page.get_by_role("button", name=re.compile("I hung 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("I removed 3 kg"))).to_be_visible()
    assert still_lab.read()["loads"][0]["load"]["kind"] == "mass"


def test_bench_that_takes_no_command_offers_none(page: Page, patched: PatchedBench) -> None:
    starting = BENCH["loop"] | {"alive": False, "state": "starting", "step": "opening the bus"}
    patched.become(emulated=None, loop=starting | {"starting_s": 2.0})
    bar = page.get_by_role("region", name="Status", exact=True)
    expect(bar.locator(".pill")).to_contain_text("Starting")
    expect(
        page.get_by_role("list", name="State of the bench").locator("[aria-current]")
    ).to_have_count(0)
    for name in ("Fig. 4A", "Record"):
        expect(page.get_by_role("button", name=name, exact=True)).to_be_disabled()
    load = page.get_by_role("button", name=re.compile("3 kg"))
    expect(load).to_be_disabled()
    patched.change(loop=BENCH["loop"], emulated=True)
    expect(load).to_be_enabled()
    expect(page.get_by_role("button", name="Fig. 4A", exact=True)).to_be_enabled()


def test_bench_that_was_never_opened_reports_no_stop_of_the_drives(
    page: Page, patched: PatchedBench
) -> None:
    lost = BENCH["loop"] | {"alive": False, "state": "gone", "silent_s": 3.0}
    patched.become(status="fault", current_a=None, loop=lost)
    find_details(page).click()
    loop = page.get_by_role("region", name="Control loop")
    expect(loop.get_by_text("No confirmation that the drives stopped")).to_be_visible()
    unheard = {"ticks": 0, "silent_s": None, "state": "not_opened"}
    patched.change(loop=lost | unheard, ages_s=[1000, 1000, 1000])
    expect(loop.get_by_text("No confirmation that the drives stopped")).to_have_count(0)
    expect(loop.get_by_role("heading")).to_contain_text("not opened")
    drives = page.get_by_role("region", name="Drives and encoders")
    expect(drives.get_by_text(re.compile("\\d A$"))).to_have_count(0)
    expect(page.get_by_text("The bench is not open.")).to_be_visible()


@pytest.mark.usefixtures("without_3d")
def test_fault_without_a_connection_is_marked_as_the_last_known(
    bench_page: Page, still_lab: Lab
) -> None:
    page = bench_page
    patched = PatchedBench(page, status="run", homing=HOMED)
    open_page(page, still_lab)
    page.keyboard.press("Shift+Escape")
    banner = page.get_by_role("alert").filter(has_text="Quick stop.")
    expect(banner).to_contain_text("Both drives are without current")
    patched.drop()
    expect(banner).to_contain_text("Last known: Quick stop.")
    expect(banner).not_to_contain_text("Both drives are without current")


def test_fault_is_cleared_by_the_holder_of_control(
    page: Page, patched: PatchedBench, still_lab: Lab
) -> None:
    lab = still_lab
    patched.become(status="fault", homing=HOMED)
    clears = page.get_by_role("button", name="Clear fault", exact=True)
    expect(clears).to_have_count(2)
    for clear in clears.all():
        expect(clear).to_be_enabled()
    ada = {"SVSA-Client": "another page"}
    lab.client.put(lab.session + "/control", json={"by": "Ada"}, headers=ada).raise_for_status()
    try:
        for clear in clears.all():
            expect(clear).to_be_disabled()
    finally:
        lab.client.delete(lab.session + "/control", headers=ada).raise_for_status()
