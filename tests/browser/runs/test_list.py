"""The list of runs: searched, filtered, sorted, tagged, deleted and restored."""

import pytest
from playwright.sync_api import Page, expect

from tests.browser.runs.recorded import BOTH, STIFF, find_names, is_change, open_list
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


@pytest.mark.smoke
def test_runs_are_searched_by_visible_text_filtered_and_sorted(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    open_list(page, lab)
    names = find_names(page)
    expect(names).to_have_text([STIFF, BOTH])
    search = page.get_by_role("searchbox", name="Search")
    search.fill("alone 60")
    expect(names).to_have_text([STIFF])
    expect(page.locator("mark")).to_have_text(["alone", "60"])
    search.fill("nothing of this kind")
    page.get_by_role("button", name="Show all runs").click()
    expect(names).to_have_text([STIFF, BOTH])

    page.get_by_role("combobox", name="Law").select_option("fl")
    expect(names).to_have_text([BOTH])
    page.get_by_role("combobox", name="Law").select_option("")
    page.get_by_role("button", name="σ", exact=True).click()
    expect(names).to_have_text([BOTH, STIFF])
    head = page.get_by_role("columnheader", name="σ")
    expect(head).to_have_attribute("aria-sort", "ascending")
    page.keyboard.press("Enter")
    expect(names).to_have_text([STIFF, BOTH])
    expect(head).to_have_attribute("aria-sort", "descending")


@pytest.mark.usefixtures("without_replay")
def test_tag_is_added_on_the_page_of_a_run_and_filters_the_table(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{lab.url}/?run={runs[1]}")
    tags = page.get_by_role("list", name=f"Tags of {STIFF}")
    tags.get_by_role("button", name="+ tag").press("Enter")
    tags.get_by_role("textbox", name="New tag").fill("stiff")
    with page.expect_response(is_change):
        page.keyboard.press("Enter")
    expect(tags).to_contain_text("stiff")
    page.get_by_role("link", name="All runs").press("Enter")
    page.get_by_role("combobox", name="Tag").select_option("stiff")
    expect(find_names(page)).to_have_text([STIFF])
    page.get_by_role("link", name=STIFF).click()
    with page.expect_response(is_change):
        tags.get_by_role("button", name="Remove tag stiff").press("Enter")
    expect(tags).not_to_contain_text("stiff")
    assert lab.client.get(f"/api/v1/runs/{runs[1]}").json()["tags"] == []


def test_missing_run_is_reported_with_a_link_back(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{lab.url}/?run=20200101-000000-deadbeef")
    expect(page.get_by_role("heading", name="This run cannot be shown")).to_be_visible()
    expect(page.get_by_role("alert")).to_contain_text("20200101-000000-deadbeef")
    page.get_by_role("link", name="All runs").press("Enter")
    expect(find_names(page)).to_have_count(len(runs))


NAMES_CUT = """() => [...document.querySelectorAll(".run-title > :first-child")]
    .filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.innerText)"""


def test_name_of_a_run_is_complete_next_to_its_tags(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    tags = {"name": "", "tags": ["stiff", "before the holidays", "group 3"]}
    lab.client.patch(f"/api/v1/runs/{runs[0]}", json=tags).raise_for_status()
    open_list(page, lab)
    name = find_names(page).filter(has_text="Fig. 4A · NDOBC vs FL · σ 15 · 3 kg")
    expect(name).to_be_visible()
    assert page.evaluate(NAMES_CUT) == []


def test_deleted_run_is_restored_immediately_or_from_the_trash(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    open_list(page, lab)
    names = find_names(page)
    delete = page.get_by_role("button", name=f"Delete {STIFF}")
    delete.click()
    expect(names).to_have_text([BOTH])
    page.get_by_role("status").get_by_role("button", name="Undo").click()
    expect(names).to_have_text([STIFF, BOTH])
    delete.click()
    expect(names).to_have_text([BOTH])
    page.get_by_role("button", name="Trash").click()
    restore = page.get_by_role("button", name=f"Restore {STIFF}")
    expect(restore.first).to_be_visible()
    others = restore.count() - 1  # of the same name, deleted by another module
    restore.first.click()
    expect(restore).to_have_count(others)
    page.get_by_role("button", name="Trash").click()
    expect(names).to_have_text([STIFF, BOTH])
