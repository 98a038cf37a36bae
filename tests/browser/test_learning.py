"""Learning aids: the tour, the equations, and the check of the paper's claims."""

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.test_page import go_to_page, open_page
from tests.exhaustive import exhaust
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d", "still")]

LOADED = """family => [...document.fonts]
    .some((font) => font.family === family && font.status === "loaded")"""


def open_learn(page: Page) -> Locator:
    go_to_page(page, "Learn")
    panel = page.get_by_role("main", name="Learn")
    # The exercises move all that is below them.
    to_exercise = panel.get_by_role("link", name=re.compile("^(Start|Continue|Review)"))
    expect(to_exercise.first).to_be_visible()
    return panel


def list_sessions(lab: Lab) -> list[str]:
    return [state["session"] for state in lab.client.get("/api/v1/sessions").json()]


def test_tour_is_offered_once_usable_by_keyboard_and_repeatable(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    tour = page.get_by_role("region", name="Tour of the lab")
    expect(tour.get_by_role("heading")).to_have_text("Welcome to the lab")
    tour.get_by_role("button", name="Take the tour").press("Enter")
    titles = ["The actuator", "The plots", "The 3 kg load", "FL or NDOBC", "All controls"]
    for title in titles:
        expect(tour.get_by_role("heading")).to_have_text(title)
        # Symbols that open equations are hidden until the last step explains the switch to them.
        expect(tour.get_by_text("equation")).to_have_count(1 if title == titles[-1] else 0)
        page.keyboard.press("ArrowRight")
    expect(tour).to_be_hidden()
    page.keyboard.press("Tab")
    expect(page.get_by_role("button", name=re.compile("3 kg"))).to_be_focused()
    page.reload()
    expect(page.get_by_role("button", name=re.compile("Hang 3 kg"))).to_be_visible()
    expect(tour).to_be_hidden()
    panel = open_learn(page)
    panel.get_by_role("button", name="Take the tour").click()
    expect(panel).to_be_hidden()
    expect(tour.get_by_role("heading")).to_have_text("The actuator")
    page.keyboard.press("Escape")
    expect(tour).to_be_hidden()


# Distance between the upper edges of the two zoom buttons, px.
ZOOM_STEP = """() => {
    const [above, below] = [...document.querySelectorAll(".plot-tools [aria-label^=Zoom]")]
        .map((one) => one.getBoundingClientRect().top);
    return below - above;
}"""


def test_zoom_buttons_stay_together_in_an_exercise(page: Page, lab: Lab) -> None:
    lanes = {"comparisons": [{"law": "fl"}]}
    lab.client.put(lab.session + "/lanes", json=lanes).raise_for_status()
    page.goto(f"{lab.url}/?learn=feedback-linearization")
    expect(page.get_by_role("table", name="Comparison of controllers")).to_be_visible()
    expect(page.get_by_role("button", name="Zoom in")).to_be_visible()
    assert page.evaluate(ZOOM_STEP) == 0
    lab.client.put(lab.session + "/lanes", json={"comparisons": []}).raise_for_status()


def test_tour_restores_load_and_lanes(page: Page, lab: Lab) -> None:
    """Of a session with a load and a comparison lane: the tour removes both, then restores them."""
    lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
    comparisons = {"comparisons": [{"law": "pd"}]}
    lab.client.put(lab.session + "/lanes", json=comparisons).raise_for_status()
    page.goto(lab.url)
    tour = page.get_by_role("region", name="Tour of the lab")
    tour.get_by_role("button", name="Take the tour").press("Enter")
    page.get_by_role("button", name=re.compile("Remove 3 kg")).press("Enter")
    page.get_by_role("switch", name=re.compile("^Compare")).press("Enter")
    expect(page.get_by_role("button", name=re.compile("Hang 3 kg"))).to_be_visible()
    expect(page.get_by_role("switch", name=re.compile("^Compare"))).not_to_be_checked()

    tour.get_by_role("button", name="Skip").press("Enter")

    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    expect(page.get_by_role("switch", name=re.compile("^Compare"))).to_be_checked()
    state = lab.read()
    assert [lane["law"] for lane in state["lanes"]] == [state["configuration"]["law"], "pd"]
    assert [row["load"]["kind"] for row in state["loads"]] == ["paper"]
    lab.client.put(lab.session + "/lanes", json={"comparisons": []}).raise_for_status()
    lab.client.delete(lab.session + "/loads").raise_for_status()


@pytest.mark.exhaustive
def test_tour_is_skipped(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    tour = page.get_by_role("region", name="Tour of the lab")
    tour.get_by_role("button", name="Skip").click()
    expect(tour).to_be_hidden()


def test_equation_opens_from_its_symbol_with_the_error_of_the_paper(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    name = "Equation of the control laws"
    page.get_by_role("button", name=name).click()
    card = page.get_by_role("dialog", name=name)
    expect(card.locator("math").first).to_be_attached()
    expect(card).to_contain_text("Eq 24")
    expect(card.get_by_text("as published").first).to_be_visible()
    page.wait_for_function(LOADED, arg="KaTeX_Math")
    page.keyboard.press("Escape")
    expect(card).to_be_hidden()
    for topic in ("position", "stiffness", "the torques"):
        expect(page.get_by_role("button", name=f"Equation of {topic}").first).to_be_visible()


@pytest.mark.parametrize("figure", exhaust(["4A", "4B", "5"], ["4A"]))
def test_figure_runs_separately_and_is_compared_with_the_claim(
    page: Page, lab: Lab, figure: str
) -> None:
    before = lab.read()["run_number"]
    sessions = list_sessions(lab)
    open_page(page, lab)
    panel = open_learn(page)
    panel.get_by_role("button", name=f"Check Fig. {figure}").click()
    result = panel.get_by_role("status", name=re.compile(f"Fig. {figure}"))
    expect(result.get_by_text("The claim holds.")).to_be_visible()
    expect(result).to_contain_text("Error under the load")
    steady = result.get_by_role("row", name=re.compile("rms 8–20 s"))
    expect(steady.get_by_role("cell")).to_have_text([re.compile(r"\d"), re.compile(r"\d")])
    fl, ndobc = (float(cell) for cell in steady.get_by_role("cell").all_inner_texts())
    assert 11.0 < fl < 12.5
    assert ndobc == pytest.approx(0.0013, abs=0.0002)
    assert lab.read()["run_number"] == before
    assert list_sessions(lab) == sessions
