"""Overlay of runs."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.runs.recorded import BOTH, STIFF, open_list
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


NUMBERS_CUT = """() => [...document.querySelectorAll(".overlay-table td, .overlay-table th")]
    .filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.innerText)"""


@pytest.mark.exhaustive
def test_numbers_of_an_overlay_are_next_to_complete_names_on_a_phone(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    long = "A name as long as a user types it who does not think of tables, not even of one"
    lab.client.patch(f"/api/v1/runs/{runs[1]}", json={"name": long}).raise_for_status()
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(f"{lab.url}/?overlay={','.join(runs)}")
    table = page.get_by_role("region", name="Metrics of each run in the window named")
    name = table.get_by_role("rowheader").filter(has_text=long)
    name.scroll_into_view_if_needed()
    whole = table.bounding_box()
    first = name.bounding_box()
    assert whole is not None
    assert first is not None
    assert first["width"] < 0.6 * whole["width"]
    assert page.evaluate(NUMBERS_CUT) == []
    table.evaluate("one => one.scrollTo({ left: 400 })")
    moved = name.bounding_box()
    assert moved is not None
    assert moved["x"] == pytest.approx(first["x"], abs=1), "the name stays next to its numbers"


def test_runs_are_aligned_at_their_load(page: Page, lab: Lab, runs: tuple[str, str]) -> None:
    open_list(page, lab)
    overlay = page.get_by_role("button", name="Overlay runs")
    expect(overlay).to_be_disabled()
    for name in (BOTH, STIFF):
        page.get_by_role("checkbox", name=f"Choose {name}").check()
    page.get_by_role("button", name="Overlay 2 runs").click()
    page.wait_for_url(re.compile("overlay="))
    for title in ("Position error", "Stiffness error"):
        plot = page.get_by_role("region", name=title, exact=True)
        expect(plot.locator("canvas")).to_be_visible()
    rows = page.get_by_role("table", name="Metrics of each run in the window named").get_by_role(
        "rowheader"
    )
    expect(rows).to_have_text([f"{BOTH} · NDOBC", f"{BOTH} · FL", STIFF])
    metrics = lab.client.get(f"/api/v1/runs/{runs[0]}/metrics?start_s=5").json()["lanes"]
    peak = metrics["lane2"]["peak_position_error_rad"] * 57.29578
    row = page.get_by_role("row", name=f"{BOTH} · FL")
    expect(row.get_by_role("cell").nth(2)).to_have_text(f"{peak:.1f}")
    expect(row.get_by_role("cell").nth(0)).to_have_text(re.compile(r"3 kg load, 5\.00–"))
    differing = page.get_by_role("table", name="Settings that differ")
    expect(differing.get_by_role("row", name="Stiffness reference")).to_contain_text("N·m/rad1560")
    expect(differing.get_by_role("row", name="Comparison lanes")).to_contain_text("FLnothing")
    entry = page.get_by_role("button", name=f"{BOTH} · FL")
    entry.click()
    expect(entry).to_have_attribute("aria-pressed", "false")
