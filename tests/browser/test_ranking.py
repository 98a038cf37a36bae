"""The page Ranking: sorting, selecting a row, and opening one of its runs, by keyboard alone."""

import re

import pytest
from playwright.sync_api import Page, expect

from svsa.evaluation.ranking.entry import get_entry_title
from svsa.evaluation.ranking.results import load_published
from tests.browser.test_page import go_to_page, open_page
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


def test_table_is_sorted_selected_from_and_opens_a_run(page: Page, still_lab: Lab) -> None:
    open_page(page, still_lab)
    go_to_page(page, "Ranking")
    table = page.get_by_role("region", name="Success rates, rank and fixed scenarios")
    rows = load_published().rows
    first = table.get_by_role("rowheader").first
    expect(first).to_have_text(get_entry_title(rows[0].key))
    head = table.get_by_role("columnheader", name=re.compile("^Largest load"))
    head.get_by_role("button").press("Enter")
    expect(head).to_have_attribute("aria-sort", "descending")
    largest = max(row.largest_load_nm for row in rows)
    best = next(row for row in rows if row.largest_load_nm == largest)
    expect(first).to_have_text(get_entry_title(best.key))
    title = get_entry_title("ndobc_w")
    table.get_by_role("button", name=title, exact=True).press("Enter")
    expect(page.get_by_role("heading", name=title, exact=True)).to_be_visible()
    expect(page.get_by_role("img", name="Position error against stiffness error")).to_be_visible()
    cell = re.compile(rf"^{re.escape(title)}, 3 kg: peak error, °: \d")
    table.get_by_role("button", name=cell).press("Enter")
    page.wait_for_url(re.compile(r"\?session="))
    expect(page.get_by_text("Private session.")).to_be_visible()
    expect(page.get_by_role("button", name=f"Control law: {title}").first).to_be_visible()
    expect(page.get_by_role("note")).to_have_count(0)


def test_run_in_which_ndobc_faults_is_shown_alone_with_the_reason(
    page: Page, still_lab: Lab
) -> None:
    open_page(page, still_lab)
    go_to_page(page, "Ranking")
    cell = re.compile(rf"^{re.escape(get_entry_title('fl'))}, Load removal: peak error, °: ")
    page.get_by_role("button", name=cell).press("Enter")
    page.wait_for_url(re.compile(r"\?session="))
    note = page.get_by_role("note").filter(has_text="is shown alone")
    expect(note).to_contain_text("NDOBC, declared gains: At ")
