"""The page Ranking: sorted, chosen from and left for one of its runs, by keyboard alone."""

import re

import pytest
from playwright.sync_api import Page, expect

from svsa.control.installed import get_title
from svsa.evaluation.ranking.results import load_published
from tests.browser.test_page import go_to_page, open_page
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


@pytest.mark.smoke
def test_the_table_is_sorted_chosen_from_and_left_for_a_run(page: Page, still_lab: Lab) -> None:
    open_page(page, still_lab)
    go_to_page(page, "Ranking")
    table = page.get_by_role("region", name="Errors, faults and score, a law a row")
    first = table.get_by_role("rowheader").first
    best = max(load_published().rows, key=lambda row: row.score)
    expect(first).to_contain_text(get_title(best.law))
    head = table.get_by_role("columnheader", name=re.compile("^2 Hz"))
    head.get_by_role("button").press("Enter")
    expect(head).to_have_attribute("aria-sort", "ascending")
    rows = [row for row in load_published().rows if row.sine_2hz_rms_deg is not None]
    least = min(rows, key=lambda row: row.sine_2hz_rms_deg or 0.0)
    expect(table.get_by_role("button", name=re.compile("2 Hz: .*, best"))).to_have_text(
        f"{least.sine_2hz_rms_deg:.3g}"
    )
    faulted = [row.law for row in load_published().rows if row.load_removal_peak_deg is None]
    title = get_title(next(law for law in faulted if law != "ndobc"))
    table.get_by_role("button", name=title, exact=True).press("Enter")
    expect(page.get_by_role("heading", name=title, exact=True)).to_be_visible()
    cell = re.compile(rf"^{re.escape(title)}, Load removal: \D")
    table.get_by_role("button", name=cell).press("Enter")
    page.wait_for_url(re.compile(r"\?session="))
    expect(page.get_by_text("Private session.")).to_be_visible()
    expect(page.get_by_role("button", name=f"Control law: {title}").first).to_be_visible()
    expect(page.get_by_role("note")).to_have_count(0)


def test_a_run_that_ndobc_would_end_is_seen_alone_with_the_reason(
    page: Page, still_lab: Lab
) -> None:
    open_page(page, still_lab)
    go_to_page(page, "Ranking")
    title = get_title("fl")
    cell = re.compile(rf"^{re.escape(title)}, Load removal: ")
    page.get_by_role("button", name=cell).press("Enter")
    page.wait_for_url(re.compile(r"\?session="))
    note = page.get_by_role("note").filter(has_text="nothing was put beside")
    expect(note).to_contain_text("NDOBC: At 8.187 s the deflection")
