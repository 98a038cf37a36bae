"""A page that the browser translates shows the state of the lab, and has no error."""

import re
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_page import open_page, wait_for_samples
from tests.lab import Lab

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
