"""A page that the browser translates shows the state of the lab, and has no error."""

import re
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from svsa_server.access.class_keys import ClassKeys
from tests.browser.test_class import find_control, join
from tests.browser.test_page import open_page, wait_for_samples
from tests.browser.test_tuning import open_tuning, tune
from tests.lab import Lab, run_lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("without_3d", "still")]

# As in-browser translators do, now and after every change: a text node becomes nested elements.
TRANSLATE = """(() => {
    const isSkipped = (node) => !node.data.trim() || !node.parentElement ||
        node.parentElement.closest("script, style, font, [translate=no], .notranslate");
    const translate = () => {
        const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
        const nodes = [];
        while (walker.nextNode()) nodes.push(walker.currentNode);
        for (const node of nodes.filter((node) => !isSkipped(node))) {
            const [outer, inner] = ["font", "font"].map((name) => document.createElement(name));
            inner.textContent = `\u00a7${node.data}`;
            outer.append(inner);
            node.parentNode.replaceChild(outer, node);
        }
    };
    translate();
    new MutationObserver(translate)
        .observe(document.body, { childList: true, characterData: true, subtree: true });
})()"""
# Translated texts that are not explanations.
WRONG = """[...document.querySelectorAll("font font")]
    .filter((font) => !font.closest("[translate=yes], .prose"))
    .map((font) => font.parentElement.parentElement.outerHTML.slice(0, 200))"""
PLACES = {
    "lab": "/",
    "runs": "/?runs=all",
    "studies": "/?studies=all",
    "falsifier": "/?falsifier=all",
    "ranking": "/?ranking=all",
    "leaderboard": "/?leaderboard=all",
    "course": "/?learn=all",
    "exercise": "/?learn=see",
    "actuators": "/?actuators=all",
    "grades": "/?grades=all",
}


@pytest.fixture
def translated(own_page: Page) -> Iterator[Page]:
    """A page without errors, also after the test."""
    errors: list[str] = []
    own_page.on("pageerror", lambda error: errors.append(str(error)))
    yield own_page
    assert errors == []


def test_state_is_that_of_the_lab_through_changes(translated: Page, lab: Lab) -> None:
    page, client, session = translated, lab.client, lab.session
    open_page(page, lab)
    page.evaluate(TRANSLATE)
    status = page.get_by_role("region", name="Status", exact=True)

    def is_recorded(is_on: bool) -> None:
        definition = status.locator("dt", has_text="Recording").locator("+ dd")
        (expect(definition).not_to_have_text if is_on else expect(definition).to_have_text)("off")

    def put(path: str, **body: object) -> None:
        client.put(session + path, json=body).raise_for_status()

    def post(path: str, **body: object) -> None:
        client.post(session + path, json=body).raise_for_status()

    position = {"kind": "constant", "position_rad": 0.5}
    button = page.get_by_role("button", name=re.compile("^(Hang|Remove) 3 kg"))
    title = page.get_by_role("button", name=re.compile("^Control law"))
    field = page.get_by_role("spinbutton", name="Position", exact=True)
    changes: list[tuple[Callable[[], object], Callable[[], object]]] = [
        (lambda: post("/start"), lambda: expect(status).to_contain_text("Running")),
        (lambda: post("/pause"), lambda: expect(status).to_contain_text("Paused")),
        (
            lambda: post("/loads", kind="paper"),
            lambda: expect(button).to_contain_text("Remove 3 kg"),
        ),
        (lambda: post("/recording", name="x"), lambda: is_recorded(True)),
        (lambda: client.delete(session + "/recording"), lambda: is_recorded(False)),
        (lambda: put("/law", law="fl"), lambda: expect(title).to_have_text("FL")),
        (
            lambda: put("/position", **position),
            lambda: expect(field).to_have_value("28.6479"),
        ),
        (
            lambda: put("/lanes", comparisons=[{"law": "ndobc"}]),
            lambda: expect(page.locator(".legend, .lane-name").first).to_be_attached(),
        ),
        (lambda: lab.jump(1), lambda: wait_for_samples(page, 1.9)),
        (lambda: lab.load_figure(law="ndobc"), lambda: expect(title).to_have_text("NDOBC")),
        (lambda: None, lambda: expect(button).to_contain_text("Hang 3 kg")),
        (
            lambda: page.get_by_role("button", name="Keyboard shortcuts").press("Enter"),
            lambda: None,
        ),
    ]
    for change, check in changes:
        change()
        check()
        assert page.evaluate(WRONG) == []
    expect(page.locator("font", has_text="\u00a7").first).to_be_attached()


@pytest.mark.parametrize("name", PLACES)
def test_only_explanations_are_translated(translated: Page, lab: Lab, name: str) -> None:
    page = translated
    page.goto(lab.url + PLACES[name])
    expect(page.locator("main").first).to_be_attached()
    page.evaluate(TRANSLATE)
    tabs = page.locator("nav.tabs")
    for tab in ("Learn", "Runs", "Lab"):
        assert page.evaluate(WRONG) == []
        tabs.get_by_role("link", name=tab, exact=True).press("Enter")
        expect(tabs.get_by_role("link", name=tab, exact=True).first).to_have_attribute(
            "aria-current", "page"
        )


def check_translated(page: Page) -> None:
    assert page.evaluate(WRONG) == []
    expect(page.locator("font", has_text="\u00a7").first).to_be_attached()


def change_session(page: Page, lab: Lab, request: dict[str, str]) -> None:
    """Change a private session through the API until it ends, in front of the page."""
    opened = lab.client.post("/api/v1/sessions", json=request).raise_for_status().json()
    session = f"/api/v1/sessions/{opened['session']}"
    page.goto(f"{lab.url}/?session={opened['session']}")
    status = page.get_by_role("region", name="Status", exact=True)
    expect(status).to_contain_text("Live")
    page.evaluate(TRANSLATE)
    for command, words in (("pause", "Paused"), ("start", "Running"), ("pause", "Paused")):
        lab.client.post(f"{session}/{command}").raise_for_status()
        expect(status).to_contain_text(words)
        check_translated(page)
    lab.client.delete(session).raise_for_status()
    banner = page.get_by_role("complementary", name="Private session")
    expect(banner).to_contain_text("has ended")


def follow_a_job(page: Page, lab: Lab) -> None:
    lab.load_figure(law="fl_integral")
    lab.jump(1)
    open_page(page, lab)
    panel = open_tuning(page)
    page.evaluate(TRANSLATE)
    check_translated(page)
    result = tune(panel)
    row = panel.get_by_role("table").first.get_by_role("row").nth(1)
    tried = float(row.get_by_role("cell").nth(1).inner_text())
    assert tried == pytest.approx(result["best"]["values"][0], rel=1e-3)


def join_a_class(page: Page, lab: Lab) -> None:
    with tempfile.TemporaryDirectory() as folder:
        _, secrets = ClassKeys.open(Path(folder))
        assert secrets is not None
        with run_lab("--class", data=folder) as classroom:
            page.goto(classroom.url)
            expect(page.get_by_label("Your name")).to_be_visible()
            page.evaluate(TRANSLATE)
            page.get_by_label("Your name").fill("Ada")
            page.get_by_label("Class code").fill("wrong")
            page.get_by_role("button", name="Join", exact=True).click()
            expect(page.get_by_role("alert")).to_be_visible()
            check_translated(page)
            join(page, "Ada", secrets.code)
            page.get_by_role("button", name="Request control").first.click()
            expect(find_control(page)).to_contain_text("You")
            check_translated(page)
            page.goto("about:blank")


SCENES: dict[str, Callable[[Page, Lab], None]] = {
    "private session": lambda page, lab: change_session(page, lab, {}),
    "arm": lambda page, lab: change_session(page, lab, {"from": "arm"}),
    "job": follow_a_job,
    "class": join_a_class,
}


@pytest.mark.exhaustive
@pytest.mark.parametrize("follow", SCENES.values(), ids=SCENES)
def test_other_states_are_true_after_a_translation(
    translated: Page, lab: Lab, follow: Callable[[Page, Lab], None]
) -> None:
    follow(translated, lab)
    assert translated.evaluate(WRONG) == []
