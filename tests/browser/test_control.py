"""Two pages on one lab: the holder of control; and the dead-man's switch of an emulator."""

import re
import time
from collections.abc import Iterator

import pytest
from playwright.sync_api import BrowserContext, Locator, Page, expect

from tests.browser.test_page import go_to_page, open_page
from tests.hardware.live_bench import start_live_emulator, write_bench
from tests.lab import Lab, run_lab
from tests.server.sessions.bench_lab import BenchLab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("without_3d")]

CONTROL_S = "60"
"""A lease outlives the calls of its holder for longer than a test of a slow machine needs them."""
ATTEMPTS = 3


@pytest.fixture
def two_pages(context: BrowserContext, still_lab: Lab) -> tuple[Page, Page]:
    """Two tabs of one browser, without a holder of control."""
    wait_for_holder(still_lab, None)
    pages = context.new_page(), context.new_page()
    for page in pages:
        open_page(page, still_lab)
    return pages


def wait_for_holder(lab: Lab, name: str | None) -> None:
    for _ in range(600):
        if lab.read()["control"]["holder"] == name:
            return
        time.sleep(0.1)
    raise AssertionError(f"{lab.read()['control']} is not {name}")


def find_control(page: Page) -> Locator:
    return page.get_by_role("region", name="Status", exact=True).locator(".is-control")


def take(page: Page, name: str) -> None:
    find_control(page).get_by_role("button", name="Take control").click()
    question = page.get_by_role("form", name="Control")
    expect(question.get_by_label("Your name")).to_have_value(re.compile("^Page [A-Z]{3}$"))
    question.get_by_label("Your name").fill(name)
    question.get_by_role("button", name="Take control").click()
    expect(find_control(page)).to_contain_text("You")


def test_second_page_watches_pauses_and_takes_over_control(
    two_pages: tuple[Page, Page], still_lab: Lab
) -> None:
    ada, other = two_pages
    for page in two_pages:
        expect(find_control(page)).to_contain_text("Everyone")
        expect(find_control(page)).to_contain_text("2 watching")
    take(ada, "Ada")
    expect(find_control(other)).to_contain_text("Ada")
    banner = other.get_by_role("status").filter(has_text="Ada is in control.")
    expect(banner).to_be_visible()
    expect(other.get_by_role("button", name="Fig. 4B")).to_be_disabled()
    expect(other.get_by_role("button", name=re.compile("Hang 3 kg"))).to_be_disabled()
    expect(other.get_by_role("button", name="Quick stop")).to_be_enabled()

    other.keyboard.press("l")
    expect(other.get_by_text("Ada is in control of session lab: ask Ada")).to_be_visible()
    assert still_lab.read()["loads"] == []
    expect(other.get_by_role("button", name="Run", exact=True)).to_be_disabled()
    ada.get_by_role("button", name="Run", exact=True).click()
    other.get_by_role("button", name="Pause", exact=True).click()
    expect(ada.get_by_role("button", name="Run", exact=True)).to_be_enabled()
    expect(other.get_by_role("button", name="Run", exact=True)).to_be_disabled()

    banner.get_by_role("button", name="Take over").click()
    question = other.get_by_role("form", name="Control")
    expect(question).to_contain_text("Take control from Ada?")
    question.get_by_role("button", name="Cancel").click()
    expect(find_control(other)).to_contain_text("Ada")
    find_control(other).get_by_role("button", name="Take over").click()
    question.get_by_label("Your name").fill("Bob")
    question.get_by_role("button", name="Take control").click()
    expect(find_control(other)).to_contain_text("You")
    expect(find_control(ada)).to_contain_text("Bob")
    expect(ada.get_by_role("button", name="Fig. 4B")).to_be_disabled()

    find_control(other).get_by_role("button", name="Release control").click()
    for page in two_pages:
        expect(find_control(page)).to_contain_text("Everyone")
        expect(page.get_by_role("button", name="Fig. 4B")).to_be_enabled()

    find_control(ada).get_by_role("button", name="Take control").click()
    expect(find_control(ada), "her name is asked once").to_contain_text("You")
    expect(find_control(other)).to_contain_text("Ada")
    find_control(ada).get_by_role("button", name="Release control").click()
    expect(find_control(other)).to_contain_text("Everyone")


@pytest.mark.exhaustive
def test_reload_keeps_control_and_closing_the_page_releases_it(
    two_pages: tuple[Page, Page], still_lab: Lab
) -> None:
    ada, other = two_pages
    take(ada, "Ada")
    ada.reload()
    expect(find_control(ada)).to_contain_text("You")
    expect(find_control(other)).to_contain_text("Ada")
    ada.close()
    expect(find_control(other)).to_contain_text("1 watching")
    expect(find_control(other)).to_contain_text("Everyone")
    wait_for_holder(still_lab, None)


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Iterator[BenchLab]:
    """The emulator with a dead-man's switch."""
    with start_live_emulator() as emulator:
        path = write_bench(
            tmp_path_factory.mktemp("bench"), emulator, dead_man=True, operator_s=1.0
        )
        with run_lab("--bench", str(path), control_s=CONTROL_S) as lab:
            yield BenchLab(lab, emulator)


def open_bench(context: BrowserContext, bench: BenchLab) -> Page:
    """Open the page at the list of runs, which leaves a slow machine time for the loop."""
    page = context.new_page()
    page.goto(bench.lab.url)
    bench.make_ready()
    go_to_page(page, "Runs")
    expect(page.get_by_text("No recorded runs yet")).to_be_visible()
    return page


def hold_through(page: Page, bench: BenchLab) -> bool:
    """Run with D held, then with the pointer; return whether it ran until then.

    If the page is so busy that it sends nothing for a whole second, the run ends, as intended.
    """
    row = page.get_by_role("region", name="Dead-man's switch")
    button = row.get_by_role("button", name="Hold to run")
    page.keyboard.down("d")
    expect(button).to_have_attribute("aria-pressed", "true")
    expect(row).to_contain_text("Held")
    find_run(page).click()
    if not runs_on(page, bench):
        return False
    button.hover()
    page.mouse.down()
    page.keyboard.up("d")
    return runs_on(page, bench)


def runs_on(page: Page, bench: BenchLab) -> bool:
    """Whether it runs for the next second and a half."""
    for _ in range(30):
        page.wait_for_timeout(50)
        if bench.status != "run":
            assert bench.read()["fault"] is None, bench.describe()
            page.keyboard.up("d")
            page.mouse.up()
            bench.make_ready()
            return False
    return True


def find_run(page: Page) -> Locator:
    bench = page.get_by_role("region", name="Bench", exact=True)
    return bench.get_by_role("button", name="Run", exact=True)


@pytest.mark.wall_clock
def test_bench_runs_only_while_the_switch_is_held(context: BrowserContext, bench: BenchLab) -> None:
    page = open_bench(context, bench)
    row = page.get_by_role("region", name="Dead-man's switch")
    button = row.get_by_role("button", name="Hold to run")
    expect(row).to_contain_text("Not held")
    expect(find_run(page)).to_be_disabled()

    assert any(hold_through(page, bench) for _ in range(ATTEMPTS))
    expect(row).to_contain_text("Running. If you release it")
    page.mouse.up()
    expect(row).to_contain_text("Not held")
    bench.wait_for("ready")
    assert bench.is_at_zero()
    assert bench.read()["fault"] is None
    expect(row).to_contain_text("Released")

    button.focus()
    page.keyboard.down("Enter")
    expect(row).to_contain_text("Now press Run")
    page.evaluate("window.dispatchEvent(new Event('blur'))")
    expect(row).to_contain_text("Not held")
    page.keyboard.up("Enter")


@pytest.mark.exhaustive
@pytest.mark.wall_clock
def test_only_the_switch_of_the_holder_counts(context: BrowserContext, bench: BenchLab) -> None:
    page = open_bench(context, bench)
    client = {"SVSA-Client": "another client"}
    bench.lab.client.put(
        bench.lab.session + "/control", json={"by": "Ada"}, headers=client
    ).raise_for_status()
    row = page.get_by_role("region", name="Dead-man's switch")
    expect(row).to_contain_text("only Ada can hold the switch")
    expect(row.get_by_role("button", name="Hold to run")).to_be_disabled()
    page.keyboard.down("d")
    expect(row).to_contain_text("Not held")
    page.keyboard.up("d")
    page.evaluate(
        """url => {
            const socket = new WebSocket(url);
            socket.onopen = () => setInterval(() => socket.send("held"), 20);
        }""",
        bench.lab.stream_url,
    )
    page.wait_for_timeout(500)
    refused = bench.lab.client.post(bench.lab.session + "/start", headers=client)
    assert "dead-man" in refused.json()["detail"]
    bench.lab.client.delete(bench.lab.session + "/control", headers=client).raise_for_status()
    bench.ask("/start")
    bench.wait_for("run")
