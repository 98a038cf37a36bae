"""The page in a real browser with a real server, by role and label."""

import math
import re

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.conftest import PATIENCE_MS, RETURNING
from tests.browser.settled import until
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page")]

"""A worker starts, with a lower priority than all other work."""
ONE_DEGREE = 0.01745
KNOWN_LAW = re.compile("^Control law: [A-Z]")

# The newest position errors in the page's plots since a session time, in rad.
LARGEST_ERROR = """([since]) => {
    const { time, value } = window.svsa.series("position_error_rad");
    return Math.max(0, ...value.filter((_, i) => time[i] >= since).map(Math.abs));
}"""
# Of the documentation, which shows the white of the browser where it has no color.
IS_SO_BRIGHT = """brightness => {
    const colour = getComputedStyle(document.querySelector(".swagger-ui")).backgroundColor;
    const shown = colour === "rgba(0, 0, 0, 0)" ? [255] : colour.match(/\\d+/g).slice(0, 3);
    return shown.every((part) => Math.abs(Number(part) - brightness) <= 10);
}"""
LAST_TIME = """() => {
    const page = window.svsa;
    if (!page || !page.channels().includes("position_error_rad")) return 0;
    const { time } = page.series("position_error_rad");
    return time.length ? time[time.length - 1] : 0;
}"""


def open_page(page: Page, lab: Lab) -> None:
    """Open with all controls, and wait for the initial requests: afterwards nothing moves."""
    page.goto(lab.url)
    wait_for_samples(page)
    show_all_controls(page)
    expect(page.get_by_role("button", name=KNOWN_LAW)).to_be_attached()


def show_all_controls(page: Page) -> None:
    """Leave the basic view, which a bench and an exercise do not have."""
    expect(page.locator("main.lab")).to_be_attached()  # drawn together with the switch
    basic = page.get_by_role("switch", name="All controls", checked=False)
    if basic.count() > 0:
        basic.press("Enter")
        expect(page.get_by_role("switch", name="All controls", checked=True)).to_be_visible()
        # Space on the switch would turn it off again.
        page.evaluate("document.activeElement.blur()")


EVALUATIONS = ("Ranking", "Leaderboard", "Studies", "Falsifier")


def go_to_page(page: Page, name: str) -> None:
    """Open by a tab; *Tune …* by the menu."""
    tabs = page.locator("nav.tabs")
    expect(tabs.first).to_be_visible()
    if name in EVALUATIONS:
        tabs.get_by_role("link", name="Evaluation").press("Enter")
        expect(tabs.get_by_role("link", name=name, exact=True)).to_be_visible()
    tab = tabs.get_by_role("link", name=name, exact=True)
    if tab.is_visible():
        tab.press("Enter")
        expect(tab.first).to_have_attribute("aria-current", "page")
        return
    page.get_by_role("button", name="Menu", exact=True).press("Enter")
    menu = page.get_by_role("navigation", name="Menu")
    menu.locator("a, button").filter(has=page.get_by_text(name, exact=True)).press("Enter")
    expect(menu).to_be_hidden()


def choose_law(page: Page, title: str) -> None:
    """Select another law as a user does."""
    page.get_by_role("button", name=KNOWN_LAW).press("Enter")
    laws = page.get_by_role("dialog", name=re.compile("^Control law: "))
    laws.get_by_role("searchbox").fill(title)
    laws.get_by_role("searchbox").press("Enter")
    expect(page.get_by_role("button", name=f"Control law: {title}", exact=True)).to_be_visible()
    expect(laws).to_be_hidden()


def unfold(part: Locator) -> None:
    """Open all folds in a part, by key, since elements may move during a click."""
    for more in part.locator("summary").all():
        more.press("Enter")
    expect(part.locator("details:not([open])")).to_have_count(0)


def choose(one: Locator) -> None:
    """Select a radio button or a checkbox by key, for the same reason.

    The page shows the choice at once, before the server has answered.
    """
    one.press("Space")
    expect(one).to_be_checked()


def come_back(page: Page, lab: Lab) -> None:
    """As a returning user: without the tour, with all controls."""
    page.goto(lab.url + "/icon.svg")
    page.evaluate(RETURNING)


def wait_for_samples(page: Page, after_s: float = 0.0, before_s: float = math.inf) -> None:
    """Wait until the newest sample on the page is between two session times."""
    for _ in range(PATIENCE_MS // 100):
        if after_s < page.evaluate(LAST_TIME) < before_s:
            return
        page.wait_for_timeout(100)
    raise AssertionError(f"no sample after {after_s} s came to the page")


@pytest.mark.smoke
@pytest.mark.usefixtures("without_3d", "still")
def test_load_button_causes_an_error_from_which_ndobc_recovers(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    lab.jump(1)
    wait_for_samples(page, 1.9)
    assert page.evaluate(LARGEST_ERROR, [1.0]) < 0.1 * ONE_DEGREE
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    onset = lab.read()["loads"][0]["start_s"]
    lab.jump(3)
    wait_for_samples(page, onset + 2.5)
    assert page.evaluate(LARGEST_ERROR, [onset]) > 2 * ONE_DEGREE
    assert page.evaluate(LARGEST_ERROR, [onset + 1.5]) < 0.1 * ONE_DEGREE


# Frames per second that the page requests.
FRAMES = """() => new Promise((resolve) => {
    const began = performance.now();
    let frames = 0;
    const request = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (callback) => { frames++; return request(callback); };
    setTimeout(() => resolve(1000 * frames / (performance.now() - began)), 2000);
})"""


@pytest.mark.usefixtures("without_3d", "still")
def test_page_of_a_paused_session_draws_with_the_messages_about_it_only(
    own_page: Page, lab: Lab
) -> None:
    open_page(own_page, lab)
    wait_for_samples(own_page)
    assert own_page.evaluate(FRAMES) <= 15  # at most 5 messages per second


@pytest.mark.usefixtures("without_3d", "still")
def test_load_button_brings_a_scheduled_load_forward(page: Page, lab: Lab) -> None:
    lab.client.delete(lab.session + "/loads").raise_for_status()
    lab.client.post(lab.session + "/loads", json={"kind": "paper", "start_s": 5.0})
    open_page(page, lab)
    expect(page.get_by_role("button", name=re.compile("Hang 3 kg"))).to_contain_text("5 s")
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    until(page, lambda: [load["start_s"] for load in lab.read()["loads"]] == [1.0])
    lab.jump(1)
    assert lab.read()["load_window"]["start_s"] == 1.0


@pytest.mark.usefixtures("without_3d", "still")
def test_load_button_plots_and_view_are_visible_together_and_the_controller_is_switched(
    page: Page, lab: Lab
) -> None:
    """Without scrolling."""
    open_page(page, lab)
    parts = [
        page.get_by_role("button", name=re.compile("Hang 3 kg")),
        page.get_by_role("heading", name=re.compile("^Position")).first,
        page.locator("canvas").first,
        page.locator("iframe"),
    ]
    for part in parts:
        expect(part).to_be_in_viewport(ratio=1)
    with page.expect_response("**/law"):
        choose_law(page, "FL")
    assert lab.read()["configuration"]["law"] == "fl"


@pytest.mark.smoke
@pytest.mark.usefixtures("without_3d", "still")
def test_rejected_value_is_explained_at_its_field_until_escape(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    before = lab.read()["configuration"]["position"]
    field = page.get_by_role("spinbutton", name=re.compile("Frequency")).first
    field.fill("99")
    field.press("Enter")
    expect(page.get_by_text("Frequency: 99 Hz is out of range (from 0 to 5 Hz)")).to_be_visible()
    expect(field).to_have_value("99")
    expect(field).to_have_attribute("aria-invalid", "true")
    field.press("Escape")
    expect(field).to_have_value("0.2")
    expect(field).to_have_attribute("aria-invalid", "false")
    assert lab.read()["configuration"]["position"] == before


@pytest.mark.usefixtures("without_3d", "still")
def test_new_run_does_not_start_with_values_of_the_previous_one(page: Page, lab: Lab) -> None:
    """Before its first sample there are none: neither clock nor error are of another run."""
    lab.jump(1)
    open_page(page, lab)
    clock = page.get_by_role("region", name="Status", exact=True).locator(".clock")
    expect(clock).to_contain_text(re.compile(r"0:01\.9|0:02"))  # 1.999 s is the last of 2000
    lab.client.post(lab.session + "/reset").raise_for_status()
    assert lab.read()["status"] == "paused"
    expect(clock).to_contain_text("0:00.0")


@pytest.mark.exhaustive
@pytest.mark.usefixtures("without_3d")
def test_documentation_has_the_theme_of_the_page(page: Page, lab: Lab) -> None:
    for scheme, brightness in (("light", 255), ("dark", 30)):
        page.emulate_media(color_scheme=scheme)  # pyright: ignore[reportArgumentType]
        page.goto(lab.url + "/docs")
        part = page.locator(".swagger-ui").first
        expect(part).to_contain_text("/api/v1/health")
        page.wait_for_function(IS_SO_BRIGHT, arg=brightness)
