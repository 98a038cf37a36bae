"""WCAG 2.2 AA by axe-core: every screen, light and dark, wide and narrow, without a violation."""

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.bench_fixture import PatchedBench
from tests.browser.settled import find_lasting
from tests.browser.test_page import (
    choose,
    come_back,
    open_page,
    unfold,
    wait_for_samples,
)
from tests.browser.test_replay import open_file
from tests.browser.test_tuning import open_tuning, tune
from tests.lab import Lab
from tests.scene.replay_page import write_page

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

WEB = Path(__file__).parents[2] / "frontend" / "web"
AXE = WEB / "node_modules" / "axe-core" / "axe.min.js"
COLOURS = ["color-contrast", "link-in-text-block"]
TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
WIDE, TABLET, PHONE = (1280, 720), (820, 1180), (390, 844)
# No control of an opened group is cut by the end of its panel, which axe would take for a control
# that is too small.
# In a scrolling list, axe counts the scrolled-away space of a target as available; at this height
# everything is in view.
HIGH = (1280, 1100)
# The inside of the 3D view is viser's page; the frame itself is checked.
FIND_VIOLATIONS = """async (rules) => {
    const options = { runOnly: rules, iframes: false, resultTypes: ["violations"] };
    const { violations } = await window.axe.run(document, options);
    return violations.flatMap(({ id, nodes }) =>
        nodes.map(({ target, failureSummary }) => `${id} ${target.join(" ")}: ${failureSummary}`));
}"""
IS_STILL = "() => !document.getAnimations().some((one) => one instanceof CSSTransition)"


@pytest.fixture(scope="module")
def recorded(lab_without_runs: Lab) -> Lab:
    """A lab with two runs, and FL and NDOBC under the load."""
    lab = lab_without_runs
    lab.client.put(lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]}).raise_for_status()
    lab.load_figure()
    for name in ("One", "Another"):
        lab.client.post(lab.session + "/pause").raise_for_status()
        lab.client.post(lab.session + "/recording", json={"name": name}).raise_for_status()
        lab.jump(1)
        lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
        lab.jump(2)
        lab.client.delete(lab.session + "/recording").raise_for_status()
    runs = lab.client.get("/api/v1/runs").json()["runs"]
    tags = {"tags": ["stiff"], "notes": "With 3 kg."}
    lab.client.patch(f"/api/v1/runs/{runs[0]['id']}", json=tags).raise_for_status()
    return lab


def expect_no_violation(page: Page, *sizes: tuple[int, int]) -> None:
    """Check with axe at each size, and in dark by its color rules, since the page is otherwise
    equal.
    """
    found: list[str] = []
    page.evaluate(AXE.read_text(encoding="utf-8"))
    for width, height in sizes:
        page.set_viewport_size({"width": width, "height": height})
        for scheme, rules in (("light", TAGS), ("dark", COLOURS)):
            page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
            expect(page.locator("html")).to_have_attribute("data-theme", scheme)
            page.wait_for_function(IS_STILL)
            texts = find_lasting(page, partial(page.evaluate, FIND_VIOLATIONS, rules))
            found += [f"{width} px, {scheme}: {text}" for text in texts]
    assert not found, "\n".join(found)


def open_lab(page: Page, lab: Lab) -> None:
    come_back(page, lab)
    open_page(page, lab)


def open_button(name: str) -> Callable[[Page, Lab], None]:
    def press(page: Page, lab: Lab) -> None:
        open_lab(page, lab)
        page.get_by_role("button", name=name, exact=True).click()

    return press


def open_learn(page: Page, lab: Lab) -> None:
    page.goto(f"{lab.url}/?learn=all")
    expect(
        page.get_by_role("link", name=re.compile("Start.*From simulation to bench"))
    ).to_be_visible()


def open_exercise(page: Page, lab: Lab) -> None:
    come_back(page, lab)
    page.goto(f"{lab.url}/?learn=feedback-linearization/predict-error")
    expect(page.locator("math").first).to_be_attached()
    wait_for_samples(page)


def open_equation(page: Page, lab: Lab) -> None:
    open_button("Equation of the control laws, u")(page, lab)
    expect(page.locator("math").first).to_be_attached()


def open_laws(page: Page, lab: Lab) -> None:
    comparisons = {"comparisons": [{"law": "fl_integral"}]}
    lab.client.put(lab.session + "/lanes", json=comparisons).raise_for_status()
    open_lab(page, lab)
    page.get_by_role("button", name=re.compile("^Settings of FL")).press("Enter")
    page.get_by_role("button", name=re.compile("^Control law: ")).press("Enter")


def open_realism(page: Page, lab: Lab) -> None:
    open_lab(page, lab)
    group = page.get_by_role("region", name="Realism", exact=True)
    choose(group.get_by_role("radio", name="Full"))
    unfold(group)
    expect(group.get_by_role("table")).to_be_visible()


def open_event(page: Page, lab: Lab) -> None:
    open_lab(page, lab)
    page.get_by_role("button", name=re.compile("3 kg load on")).first.focus()


def open_calls(page: Page, lab: Lab) -> None:
    open_button("Calls as code")(page, lab)
    page.keyboard.press("l")
    expect(page.get_by_text("httpx.").first).to_be_visible()


def open_list(page: Page, lab: Lab) -> None:
    page.goto(lab.url + "/?runs=all")
    expect(page.get_by_role("rowheader").first).to_be_visible()


def open_run(page: Page, lab: Lab) -> None:
    open_list(page, lab)
    page.get_by_role("link", name="One", exact=True).click()
    expect(page.get_by_role("button", name=re.compile("^Branch"))).to_be_visible()


def open_overlay(page: Page, lab: Lab) -> None:
    open_list(page, lab)
    choices = page.get_by_role("checkbox", name=re.compile("^Choose"))
    expect(choices).to_have_count(2)
    for choice in choices.all():
        choice.check()
    page.get_by_role("button", name="Overlay 2 runs").click()
    expect(
        page.get_by_role("table", name="Metrics of each run in the window named")
    ).to_be_visible()
    expect(page.get_by_role("table", name="Settings that differ")).to_be_visible()
    page.get_by_role("button", name="Compare").click()
    verdict = page.get_by_role("region", name="Verdict")
    expect(verdict.get_by_role("status")).to_contain_text(re.compile("tolerance"))
    expect(verdict.get_by_role("cell", name=re.compile("^(within|outside)$"))).to_have_count(2)


def open_trash(page: Page, lab: Lab) -> None:
    open_list(page, lab)
    page.get_by_role("button", name="Trash").click()


def open_ranking(page: Page, lab: Lab) -> None:
    page.goto(lab.url + "/?ranking=all")
    page.get_by_text("What each column shows").click()
    expect(
        page.get_by_role("heading", name="Position error against stiffness error")
    ).to_be_visible()


def open_menu(page: Page, lab: Lab) -> None:
    open_button("Menu")(page, lab)
    expect(page.get_by_role("link", name=re.compile("^Guide"))).to_be_visible()


def open_tuned(page: Page, lab: Lab) -> None:
    open_lab(page, lab)
    tune(open_tuning(page))


def open_private(page: Page, lab: Lab) -> None:
    name = lab.client.post("/api/v1/sessions", json={}).json()["session"]
    come_back(page, lab)
    page.goto(f"{lab.url}/?session={name}")
    expect(page.get_by_text("Private session.")).to_be_visible()
    wait_for_samples(page)


EXHAUSTIVE = pytest.mark.exhaustive


@pytest.mark.parametrize(
    ("show", "sizes"),
    [
        pytest.param(open_lab, (WIDE, PHONE), id="lab"),
        pytest.param(open_lab, (TABLET,), id="lab on a tablet", marks=EXHAUSTIVE),
        pytest.param(open_page, (WIDE, PHONE), id="tour", marks=EXHAUSTIVE),
        pytest.param(open_button("Keyboard shortcuts"), (WIDE, PHONE), id="keys", marks=EXHAUSTIVE),
        pytest.param(open_learn, (WIDE, PHONE), id="learn", marks=EXHAUSTIVE),
        pytest.param(open_exercise, (HIGH, PHONE), id="exercise", marks=EXHAUSTIVE),
        pytest.param(open_menu, (WIDE, PHONE), id="menu", marks=EXHAUSTIVE),
        pytest.param(open_equation, (WIDE,), id="equation", marks=EXHAUSTIVE),
        pytest.param(open_button("Place poles"), (WIDE, PHONE), id="design", marks=EXHAUSTIVE),
        pytest.param(open_button("Plots"), (WIDE,), id="plots", marks=EXHAUSTIVE),
        pytest.param(open_button("Cursors"), (WIDE,), id="cursors", marks=EXHAUSTIVE),
        pytest.param(open_laws, (WIDE, PHONE), id="laws", marks=EXHAUSTIVE),
        pytest.param(open_realism, (HIGH, PHONE), id="realism", marks=EXHAUSTIVE),
        pytest.param(open_event, (WIDE,), id="event", marks=EXHAUSTIVE),
        pytest.param(open_calls, (HIGH, PHONE), id="calls", marks=EXHAUSTIVE),
        pytest.param(open_list, (WIDE, PHONE), id="runs", marks=EXHAUSTIVE),
        pytest.param(open_run, (WIDE, PHONE), id="run", marks=EXHAUSTIVE),
        pytest.param(open_overlay, (WIDE, PHONE), id="overlay", marks=EXHAUSTIVE),
        pytest.param(open_trash, (WIDE,), id="trash", marks=EXHAUSTIVE),
        pytest.param(open_ranking, (WIDE, PHONE), id="ranking", marks=EXHAUSTIVE),
        pytest.param(open_tuned, (HIGH, PHONE), id="tuning", marks=EXHAUSTIVE),
        pytest.param(open_private, (WIDE,), id="private", marks=EXHAUSTIVE),
    ],
)
@pytest.mark.smoke
def test_screen_has_no_violation(
    page: Page,
    recorded: Lab,
    show: Callable[[Page, Lab], None],
    sizes: tuple[tuple[int, int], ...],
) -> None:
    show(page, recorded)
    expect_no_violation(page, *sizes)


def test_keyboard_skips_to_the_plots_and_to_the_controls(page: Page, recorded: Lab) -> None:
    open_lab(page, recorded)
    page.keyboard.press("Tab")
    expect(page.get_by_role("link", name="Skip to the plots")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.get_by_role("region", name="Plots", exact=True)).to_be_focused()
    page.keyboard.press("Tab")
    expect(page.get_by_role("button", name="Pause plots")).to_be_focused()
    page.get_by_role("link", name="Skip to the controls").focus()
    page.keyboard.press("Enter")
    expect(page.get_by_role("region", name="Controls", exact=True)).to_be_focused()


@pytest.mark.exhaustive
@pytest.mark.parametrize("status", ["off", "run"])
def test_bench_has_no_violation(bench_page: Page, still_lab: Lab, status: str) -> None:
    PatchedBench(bench_page, status=status, dead_man=True)
    open_lab(bench_page, still_lab)
    expect_no_violation(bench_page, WIDE, PHONE)


@pytest.mark.exhaustive
def test_page_without_connection_has_no_violation(own_page: Page, still_lab: Lab) -> None:
    own_page.route_web_socket(re.compile("/stream"), lambda silent: None)
    own_page.goto(still_lab.url)
    expect(own_page.get_by_text("Waiting for the lab")).to_be_visible()
    expect_no_violation(own_page, WIDE, PHONE)


@pytest.mark.exhaustive
def test_exported_run_has_no_violation(page: Page, tmp_path: Path) -> None:
    open_file(page, write_page(tmp_path))
    expect_no_violation(page, WIDE, PHONE)
