"""The page Studies: display, selection in the plots, and a row opened, by keyboard alone; axe."""

import json
import math
import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Page, Route, expect

from svsa.evaluation.studies.execution import run_study
from svsa.evaluation.studies.store import keep_study
from tests.browser.settled import get_box, until
from tests.browser.test_accessibility import PHONE, TABLET, WIDE, expect_no_violation
from tests.evaluation.studies.studies import VARIED, build_study
from tests.exhaustive import exhaust
from tests.lab import Lab, run_lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

SIZES = ((WIDE,), (WIDE, TABLET, PHONE))


@pytest.fixture(scope="module")
def studied(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    """A lab with a study of 80 runs of 1.2 s, and one of 64 sampled for sensitivity."""
    data = tmp_path_factory.mktemp("data")
    decided = build_study(vary=VARIED[:2], laws=("ndobc",), runs=16, sampling="sensitivity")
    for name, study in (("short", build_study()), ("decided", decided)):
        assert run_study(keep_study(name, study, data / "studies"), workers=0)
    with run_lab(data=str(data)) as lab:
        yield lab


@pytest.mark.parametrize("sizes", exhaust(SIZES, SIZES[:1]))
def test_study_is_selected_from_and_opens_a_run(
    page: Page, studied: Lab, sizes: tuple[tuple[int, int], ...]
) -> None:
    page.goto(studied.url + "/?studies=all")
    page.get_by_role("link", name=re.compile("^short")).press("Enter")
    law = page.get_by_role("row", name=re.compile("^NDOBC"))
    expect(law).to_contain_text(re.compile(r"40.*%"))
    expect_no_violation(page, *sizes)

    plane = page.get_by_role("region", name="First plane")
    plane.get_by_label("Across from").fill("1")
    plane.get_by_label("Across from").press("Enter")
    expect(page.get_by_text(re.compile(r"^\d+ of 80 runs in the brush"))).to_be_visible()
    page.wait_for_url(re.compile("brush=s"))
    address = page.url
    plane.get_by_role("application").press("ArrowRight")
    expect(page.get_by_role("columnheader", name=re.compile("^Run "))).to_have_count(1)
    plane.get_by_role("application").press("ArrowRight")
    expect(page.get_by_role("button", name="Overlay both runs")).to_be_visible()
    expect_no_violation(page, WIDE)
    page.get_by_role("button", name="Open in 3D").last.press("Enter")
    page.wait_for_url(re.compile(r"run="))
    expect(page.get_by_role("heading", name=re.compile("^Study short, row "))).to_be_visible()

    page.goto(address)
    expect(page.get_by_text(re.compile(r"^\d+ of 80 runs in the brush"))).to_be_visible()
    brush = plane.locator(".u-select")
    expect(brush).to_be_visible()
    until(page, lambda: get_box(brush)["width"] > 100)


def test_invalid_text_is_reported_with_its_line_and_nothing_is_started(
    page: Page, studied: Lab
) -> None:
    page.goto(studied.url + "/?studies=all")
    page.get_by_role("combobox", name="Study", exact=True).select_option(label="Custom (TOML) …")
    text = page.get_by_label("Definition (TOML)")
    text.fill('title = "Mine"\nruns = 0\n')
    page.get_by_role("button", name="Start", exact=True).press("Enter")
    expect(page.get_by_role("alert").first).to_contain_text("line 2: runs is 0")
    text.fill('title = "Mine"\nruns = 2\n')
    page.get_by_role("button", name="Check").press("Enter")
    expect(page.get_by_text("Valid: 2 samples, 2 runs under NDOBC.")).to_be_visible()
    kept = studied.client.get("/api/v1/studies").json()["saved"]
    assert {one["name"] for one in kept} == {"short", "decided"}


def test_rejected_value_is_explained_at_its_field_and_a_bound_is_sent_in_si(
    page: Page, studied: Lab
) -> None:
    page.goto(studied.url + "/?studies=all")
    name = page.get_by_role("textbox", name="Save as")
    name.fill("a b")
    page.get_by_text("Success criterion: study default").click()
    page.get_by_role("checkbox", name="rms position error", exact=True).check()
    bound = page.get_by_role("spinbutton", name=re.compile("^rms position error, at most"))
    page.get_by_role("button", name="Check").click()
    expect(bound).to_be_focused()
    expect(bound).to_have_attribute("aria-invalid", "true")
    bound.fill("2")
    with page.expect_request("**/studies/check") as check:
        page.get_by_role("button", name="Check").click()
    assert check.value.post_data_json == {
        "source": "load",
        "name": "a b",
        "success": {"rms_position_error_rad": pytest.approx(math.radians(2))},
    }
    reason = page.locator("label", has=name).locator("+ [role=alert]")
    expect(reason).to_contain_text("Save as is 'a b': it must be")
    expect(page.get_by_role("alert")).to_have_count(1)
    name.fill("a")
    expect(reason).to_be_hidden()
    page.get_by_role("button", name="Check").click()
    expect(page.get_by_text(re.compile("^Valid: "))).to_be_visible()


ANGLE = {"type": "number", "minimum": 0, "maximum": math.pi, "unit": "rad"}
TURN = ANGLE | {"title": "Turn", "default": 0}
ADDED = {
    "warm_up_rad": ANGLE
    | {"title": "Warm-up", "default": math.pi / 2, "description": "Angle before the run"},
    "dry": {"type": "boolean", "default": False, "title": "Without motors"},
    "frame": {"type": "object", "properties": {"turn_rad": TURN}, "title": "Frame"},
}


def test_field_that_the_schema_gains_is_rendered_and_sent(page: Page, studied: Lab) -> None:
    """The schema in the page is changed, not its code; the server does not know the field."""

    def add_field(route: Route) -> None:
        answer = route.fetch()
        text = answer.text()
        field = json.dumps(ADDED, separators=(",", ":"))[1:-1] + ","
        place = '{"properties":{"source":'
        assert text.count(place) == 1
        route.fulfill(response=answer, body=text.replace(place, place[:15] + field + place[15:]))

    page.route(re.compile("otherpages-.*[.]js"), add_field)
    page.goto(studied.url + "/?studies=all")
    added = page.get_by_role("spinbutton", name="Warm-up")
    expect(added).to_have_value("90")
    expect(added).to_have_attribute("aria-valuetext", "90 deg")
    expect(added).to_have_attribute("aria-valuemax", "180")
    expect(page.get_by_title("Angle before the run")).to_be_visible()
    added.fill("200")
    added.press("Tab")
    expect(page.get_by_role("alert")).to_contain_text("Warm-up: 200 deg is out of range")
    added.fill("45")
    page.get_by_role("checkbox", name="Without motors").check()
    page.get_by_role("group", name="Frame").get_by_role("spinbutton", name="Turn").fill("90")
    with page.expect_request("**/studies/check") as check:
        page.get_by_role("button", name="Check").click()
    sent = check.value.post_data_json
    assert sent["warm_up_rad"] == pytest.approx(math.pi / 4)
    assert sent["dry"] is True
    assert sent["frame"] == {"turn_rad": pytest.approx(math.pi / 2)}
    expect(page.get_by_role("alert")).to_contain_text(["Warm-up", "Without motors", "Frame"])


SHARES_SHOWN = """panel => [...panel.querySelectorAll("dl > div")].map(row =>
    [...row.querySelectorAll("dd")].map(one => [one.querySelector("i"), one].map(
        each => each.getBoundingClientRect().width)).map(([bar, whole]) => bar / whole))"""


def test_bars_of_the_sensitivity_have_the_length_of_its_sobol_indices(
    page: Page, studied: Lab
) -> None:
    asked = studied.client.get("/api/v1/studies/decided/sensitivity").raise_for_status()
    (reported,) = asked.json()
    own, total = reported["first_order"], reported["total_order"]
    names = sorted(total, key=lambda name: -total[name]["value"])
    expected = [min(1.0, max(0.0, of[name]["value"])) for name in names for of in (own, total)]
    assert max(expected) > 0.3
    page.goto(studied.url + "/?studies=decided")
    panel = page.get_by_role("region", name="Sensitivity of the success")
    expect(panel).to_be_visible()

    def read_drawn() -> list[float]:
        return [share for row in panel.evaluate(SHARES_SHOWN) for share in row]

    until(page, lambda: read_drawn() == pytest.approx(expected, abs=0.01))
