"""Status bar, quick stop and keyboard of a simulated session, with a real server."""

import re
from collections.abc import Iterator
from typing import Literal

import pytest
from playwright.sync_api import Page, Request, expect

from tests.browser.bench_fixture import HOMED, PatchedBench, describe_fault
from tests.browser.conftest import PATIENCE_MS
from tests.browser.test_page import go_to_page, open_page
from tests.exhaustive import exhaust
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


STOP = "document.querySelector('.stop-button')"
IS_LARGE = f"""([width, height]) => {{
    const box = {STOP}.getBoundingClientRect();
    return box.width >= width && box.height >= height;
}}"""
# It neither moves nor changes its color.
RESTS = f"""async () => {{
    const read = () => JSON.stringify({STOP}.getBoundingClientRect());
    const before = read();
    for (let i = 0; i < 10; i++) await new Promise(requestAnimationFrame);
    const isChanging = document.getAnimations().some((one) => one instanceof CSSTransition);
    return before === read() && !isChanging;
}}"""


def wait_for_status(page: Page, lab: Lab, status: str) -> None:
    for _ in range(PATIENCE_MS // 100):
        if lab.read()["status"] == status:
            return
        page.wait_for_timeout(100)
    raise AssertionError(f"the session is {lab.read()['status']}, not {status}")


def test_status_bar_is_visible_and_shows_what_runs(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    bar = page.get_by_role("region", name="Status", exact=True)
    expect(bar).to_be_in_viewport(ratio=1)
    for words in ("Running", "1000 Hz", "real time", "Recording", "Live"):
        expect(bar.get_by_text(words).first).to_be_visible()
    stop = bar.get_by_role("button", name="Quick stop")
    page.wait_for_function(IS_LARGE, arg=[120, 36])
    page.set_viewport_size({"width": 420, "height": 800})
    expect(stop).to_be_in_viewport(ratio=1)


@pytest.mark.smoke
def test_unconfirmed_stop_is_repeated_then_pauses_with_instructions(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    page.route("**/quick-stop", lambda route: route.abort())
    page.get_by_role("button", name="Quick stop").click()
    expect(page.get_by_role("alert").get_by_text("not confirmed")).to_be_visible()
    page.unroute("**/quick-stop")
    wait_for_status(page, lab, "paused")
    expect(page.get_by_role("alert").get_by_text("not confirmed")).to_have_count(0)
    expect(page.get_by_role("alert").get_by_text("Quick stop.")).to_be_visible()
    page.reload()
    expect(page.get_by_role("alert").get_by_text("press Run")).to_be_visible()
    page.get_by_role("button", name="Run", exact=True).press("Enter")
    expect(page.get_by_role("alert").get_by_text("Quick stop.")).to_have_count(0)


@pytest.mark.parametrize("plant", exhaust(["simulated", "bench"], ["simulated"]))
def test_fault_of_a_simulation_and_of_a_bench_has_advice(
    page: Page, request: pytest.FixtureRequest, lab: Lab, plant: str
) -> None:
    """Its message has further information, with the numbers."""
    code = "lever_end"
    if plant == "bench":
        page = request.getfixturevalue("bench_page")
        PatchedBench(page, status="fault", homing=HOMED, fault=describe_fault(code, "A test."))
    pull = {"kind": "constant", "torque_nm": [0.0, 0.0, 9.0]}
    lab.client.post(lab.session + "/loads", json=pull).raise_for_status()
    wait_for_status(page, lab, "fault")
    assert lab.read()["fault"]["code"] == code
    open_page(page, lab)
    page.get_by_text("Causes and remedies").press("Enter")
    expect(page.get_by_text("Try a stiffer setting")).to_be_visible()


@pytest.mark.parametrize("scheme", exhaust(["light", "dark"], ["dark"]))
def test_stop_does_not_look_like_an_emergency_stop(
    page: Page, bench_page: Page, lab: Lab, scheme: Literal["light", "dark"]
) -> None:
    """Only black, grey and white, with contrast; larger on a bench than in simulation."""
    areas = []
    PatchedBench(bench_page, status="run", homing=HOMED)
    for one, kind in ((page, "is-simulation"), (bench_page, "is-bench")):
        one.emulate_media(color_scheme=scheme)
        open_page(one, lab)
        expect(one.locator("html")).to_have_attribute("data-theme", scheme)
        stop = one.get_by_role("button", name="Quick stop")
        expect(stop).to_have_class(re.compile(kind))
        one.wait_for_function(RESTS)
        box = stop.bounding_box()
        assert box is not None
        areas.append(box["width"] * box["height"])
        ground, line_style = stop.evaluate(
            "one => [getComputedStyle(one).backgroundColor, getComputedStyle(one).color]"
        )
        for colour in (ground, line_style):
            red, green, blue = (int(part) for part in re.findall(r"\d+", colour)[:3])
            assert max(red, green, blue) - min(red, green, blue) < 30, colour
        assert abs(read_lightness(ground) - read_lightness(line_style)) > 150
    assert areas[1] > 1.4 * areas[0]


def read_lightness(colour: str) -> float:
    return sum(int(part) for part in re.findall(r"\d+", colour)[:3]) / 3


@pytest.mark.usefixtures("still")
def test_keys_command_the_page(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    page.keyboard.press("Space")
    expect(page.get_by_role("button", name="Pause", exact=True)).to_be_visible()
    wait_for_status(page, lab, "running")
    page.keyboard.press("Space")
    expect(page.get_by_role("button", name="Run", exact=True)).to_be_visible()
    wait_for_status(page, lab, "paused")
    page.keyboard.press("l")
    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    page.keyboard.press("c")
    expect(page.get_by_role("switch", name=re.compile("^Compare with"))).to_be_checked()
    page.keyboard.press("r")
    expect(page.get_by_role("button", name=re.compile("^Recording"))).to_be_visible()
    page.keyboard.press("r")
    expect(page.get_by_role("button", name="Record", exact=True)).to_be_visible()


@pytest.fixture
def commands(page: Page) -> Iterator[list[str]]:
    """The requests of the page to the session, except reading ones."""
    asked: list[str] = []

    def receive_request(request: Request) -> None:
        if request.method != "GET":
            asked.append(request.url.rpartition("/")[2])

    page.on("request", receive_request)
    yield asked
    page.remove_listener("request", receive_request)


def test_keys_in_a_text_field_are_text_and_single_keys_can_be_disabled(
    page: Page, lab: Lab, commands: list[str]
) -> None:
    open_page(page, lab)
    field = page.get_by_role("spinbutton", name=re.compile("Frequency")).first
    field.focus()
    for key in ("Space", "l", "c", "?"):
        page.keyboard.press(key)
    with page.expect_response("**/quick-stop"):
        page.keyboard.press("Shift+Escape")
    assert set(commands) == {"quick-stop"}, "repeated until it is confirmed"
    expect(page.get_by_role("dialog", name="Keyboard")).to_have_count(0)

    commands.clear()
    wait_for_status(page, lab, "paused")
    opener = page.get_by_role("button", name="Keyboard shortcuts")
    opener.focus()
    page.keyboard.press("?")
    sheet = page.get_by_role("dialog", name="Keyboard")
    expect(sheet).to_be_visible()
    expect(page.locator(".stop-button")).to_be_in_viewport(ratio=1)
    sheet.get_by_role("checkbox", name="Enable single-key shortcuts").uncheck()
    page.keyboard.press("Escape")
    expect(sheet).to_have_count(0)
    expect(opener).to_be_focused()
    page.keyboard.press("l")
    with page.expect_response("**/quick-stop"):
        page.keyboard.press("Shift+Escape")
    assert set(commands) == {"quick-stop"}, "repeated until it is confirmed"


@pytest.mark.usefixtures("still")
def test_only_a_page_that_shows_the_session_has_its_clock_and_stop(page: Page, lab: Lab) -> None:
    """The key works on every page; a simulation has its button only where it is shown."""
    open_page(page, lab)
    expect(page.get_by_role("timer")).to_be_visible()
    expect(page.get_by_role("button", name="Quick stop")).to_be_visible()
    for name in ("Runs", "Studies"):
        go_to_page(page, name)
        expect(page.get_by_role("timer")).to_have_count(0)
        expect(page.get_by_role("button", name="Quick stop")).to_have_count(0)
    lab.client.post(lab.session + "/start").raise_for_status()
    wait_for_status(page, lab, "running")
    with page.expect_response("**/quick-stop"):
        page.keyboard.press("Shift+Escape")
    wait_for_status(page, lab, "paused")
    go_to_page(page, "Lab")
    bar = page.get_by_role("region", name="Status", exact=True)
    expect(bar.get_by_role("button", name="Quick stop")).to_be_visible()


def test_bench_keeps_its_stop_on_every_page(bench_page: Page, lab: Lab) -> None:
    PatchedBench(bench_page, status="run", homing=HOMED)
    open_page(bench_page, lab)
    for name in ("Runs", "Studies"):
        go_to_page(bench_page, name)
        expect(bench_page.get_by_role("timer")).to_be_visible()
        expect(bench_page.get_by_role("button", name="Quick stop")).to_be_visible()
