"""The page on a bench, which `bench_fixture` puts between the page and a simulating lab."""

import re
from collections.abc import Iterator
from functools import partial

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.bench_fixture import BENCH, FAULT, HOMED, PatchedBench
from tests.browser.settled import find_lasting, get_box, resize, until
from tests.browser.test_page import open_page
from tests.exhaustive import exhaust
from tests.lab import Lab

pytestmark = pytest.mark.browser

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


@pytest.fixture
def patched(opened_once: PatchedBench, browser_context_args: dict, still_lab: Lab) -> PatchedBench:
    """A bench that is off, in the one page of these tests."""
    patched, page = opened_once, opened_once.page
    page.set_viewport_size(browser_context_args["viewport"])
    # Nothing of a bench that runs opens the details by itself: if they are open, somebody did it.
    patched.become(status="run", homing=HOMED)
    expect_stage(page, "Run")
    if find_details(page).get_attribute("aria-expanded") == "true":
        page.reload()
        expect_stage(page, "Run")
    patched.become()
    expect_stage(page, "Off")
    return patched


@pytest.fixture
def page(patched: PatchedBench) -> Page:
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


@pytest.mark.usefixtures("without_3d")
def test_a_simulation_shows_no_bench_and_no_mark(kept_page: Page, still_lab: Lab) -> None:
    open_page(kept_page, still_lab)
    expect(find_bench(kept_page)).to_have_count(0)
    expect(kept_page.get_by_text(re.compile("EMULATED|REAL BENCH"))).to_have_count(0)
    expect(kept_page).to_have_title("SVSA Lab")


MARKS = {True: "EMULATED", False: "REAL BENCH", None: "BENCH"}


@pytest.mark.parametrize("emulated", exhaust(MARKS, [False]))
def test_the_mark_is_in_band_view_status_bar_and_tab(
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


def test_what_a_bench_refuses_is_not_offered(page: Page) -> None:
    for name in ("Reset", "Step", "Pause"):
        expect(page.get_by_role("button", name=name, exact=True)).to_have_count(0)
    expect(page.get_by_role("combobox", name="Speed")).to_have_count(0)


@pytest.mark.smoke
def test_from_off_over_the_marks_to_a_run_and_its_stop(page: Page, patched: PatchedBench) -> None:
    bench = find_bench(page)
    expect_stage(page, "Off")
    expect_enabled(page, "Arm")
    bench.get_by_role("button", name="Arm").click()
    expect_stage(page, "Ready")
    expect_enabled(page)

    confirm = bench.get_by_role("button", name="Motor 1 stands at its mark")
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
def test_a_quick_stop_is_latched_until_the_fault_is_cleared(
    page: Page, patched: PatchedBench
) -> None:
    patched.become(status="run", homing=HOMED)
    expect_stage(page, "Run")
    page.keyboard.press("Shift+Escape")
    banner = page.get_by_role("alert").filter(has_text="Quick stop.")
    expect(banner).to_contain_text("stay so until somebody clears the fault")
    expect(page.get_by_role("list", name="To go on")).to_be_visible()
    expect_enabled(page, "Clear fault")
    page.reload()
    expect(banner).to_be_visible()
    find_bench(page).get_by_role("button", name="Clear fault").click()
    expect(banner).to_have_count(0)
    expect_enabled(page, "Arm")
    assert patched.commands == ["quick-stop", "bench/clear"]


@pytest.mark.parametrize("has_hold", [False, True], ids=["no switch", "dead-man's switch"])
def test_a_fault_and_opened_details_leave_room_for_the_actuator(
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


def test_a_fault_is_told_on_a_phone_with_the_details_opened(
    page: Page, patched: PatchedBench
) -> None:
    resize(page, 390, 844)
    patched.become(status="fault", fault=FAULT, problems=["Motor 1 says nothing."], dead_man=True)
    find_details(page).click()
    expect(find_bench(page).get_by_text("Motor 1 says nothing.")).to_be_visible()
    page.evaluate("scrollTo(0, 0)")
    told = page.get_by_role("alert").filter(has_text="Quick stop.").get_by_text("Quick stop.")
    hang = page.get_by_role("button", name="Hang 3 kg")

    def is_above_the_load() -> bool:
        words = get_box(told)
        return words["y"] + words["height"] < get_box(hang)["y"]

    until(page, is_above_the_load)


def test_why_it_does_not_arm_is_told_and_everything_else_is_in_the_details(
    page: Page, patched: PatchedBench
) -> None:
    patched.become(problems=["Calibration is 190 days old: at most 180."])
    expect_enabled(page)
    problems = page.get_by_role("region", name="Why it does not arm")
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


def test_the_status_bar_tells_the_lateness_of_a_bench(page: Page, patched: PatchedBench) -> None:
    bar = page.get_by_role("region", name="Status", exact=True)
    expect(bar.get_by_text("late 24 µs / 71 µs · 3 ticks skipped")).to_be_visible()
    patched.change(loop=BENCH["loop"] | {"alive": False, "state": "gone"})
    expect(bar.get_by_text("gone")).to_be_visible()


def test_on_a_real_bench_the_load_button_only_marks(
    page: Page, patched: PatchedBench, still_lab: Lab
) -> None:
    patched.become(emulated=False, status="run", homing=HOMED)
    page.get_by_role("button", name=re.compile("I hung 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("I took 3 kg off"))).to_be_visible()
    assert still_lab.read()["loads"][0]["load"]["kind"] == "mass"


def test_the_work_is_seen_without_scrolling_on_a_running_bench(
    page: Page, patched: PatchedBench
) -> None:
    """Where not every plot has room, those that have are whole, and it is said how many follow."""
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


def test_what_takes_no_command_yet_offers_none(page: Page, patched: PatchedBench) -> None:
    starting = BENCH["loop"] | {"alive": False, "state": "starting", "step": "opening the bus"}
    patched.become(emulated=None, loop=starting | {"starting_s": 2.0})
    bar = page.get_by_role("region", name="Status", exact=True)
    expect(bar.get_by_text("Starting")).to_be_visible()
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


def test_of_a_bench_that_was_never_opened_nobody_asks_who_stopped_it(
    page: Page, patched: PatchedBench
) -> None:
    lost = BENCH["loop"] | {"alive": False, "state": "gone", "silent_s": 3.0}
    patched.become(status="fault", current_a=None, loop=lost)
    find_details(page).click()
    loop = page.get_by_role("region", name="Control loop")
    expect(loop.get_by_text("Nobody is known to have stopped")).to_be_visible()
    unheard = {"ticks": 0, "silent_s": None, "state": "not_opened"}
    patched.change(loop=lost | unheard, ages_s=[1000, 1000, 1000])
    expect(loop.get_by_text("Nobody is known to have stopped")).to_have_count(0)
    expect(loop.get_by_role("heading")).to_contain_text("not opened")
    drives = page.get_by_role("region", name="Drives and encoders")
    expect(drives.get_by_text(re.compile("\\d A$"))).to_have_count(0)
    expect(page.get_by_text("The bench is not open.")).to_be_visible()


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


@pytest.mark.usefixtures("without_3d")
def test_without_a_connection_a_fault_is_the_last_that_is_known(
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


def test_a_fault_is_cleared_by_who_is_in_control(
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
