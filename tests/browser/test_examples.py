"""The pages of the evaluation on a fresh lab: each opens on a result, and fits 1440 px."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_accessibility import PHONE, expect_no_violation
from tests.lab import Lab, run_lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

DESKTOP = (1440, 900)
COUNT_SCROLLING = """() => [...document.querySelectorAll("main *")].filter((one) =>
    /auto|scroll/.test(getComputedStyle(one).overflowX) && one.scrollWidth > one.clientWidth
).length"""


@pytest.fixture(scope="module")
def fresh_lab() -> Iterator[Lab]:
    with run_lab() as lab:
        yield lab


def open_wide(page: Page, lab: Lab, query: str) -> None:
    page.set_viewport_size({"width": DESKTOP[0], "height": DESKTOP[1]})
    page.goto(f"{lab.url}/?{query}=all")


def expect_no_scrolling(page: Page) -> None:
    page.wait_for_function(f"() => ({COUNT_SCROLLING})() === 0")


def test_studies_page_first_shows_a_finished_example(page: Page, fresh_lab: Lab) -> None:
    open_wide(page, fresh_lab, "studies")
    head = page.get_by_role("heading", name=re.compile("^Example A step of 0 to 10"))
    expect(head).to_be_visible()
    expect(page.get_by_role("row", name=re.compile("^NDOBC 256"))).to_be_visible()
    expect(page.get_by_role("region", name="First plane")).to_be_visible()
    expect(page.get_by_role("button", name="Delete")).to_have_count(0)
    expect_no_scrolling(page)
    expect_no_violation(page, DESKTOP, PHONE)


def test_finished_study_is_loading_until_its_runs_are_read(page: Page, fresh_lab: Lab) -> None:
    page.route("**/studies/*/rows*", lambda _: None)
    open_wide(page, fresh_lab, "studies")
    expect(page.get_by_text("Loading the runs …")).to_be_visible()
    expect(page.get_by_text("No run completed yet")).to_have_count(0)


def test_falsifier_page_first_shows_a_finished_example(page: Page, fresh_lab: Lab) -> None:
    open_wide(page, fresh_lab, "falsifier")
    expect(page.get_by_role("heading", name=re.compile("^Example impulse-ndobc"))).to_be_visible()
    laws = page.get_by_role("region", name="Laws under this load")
    expect(laws).to_contain_text("1 of 2 laws had no fault.")
    expect_no_scrolling(page)
    expect_no_violation(page, DESKTOP, PHONE)


def test_leaderboard_shows_the_published_ranking_and_starts_no_season(
    page: Page, fresh_lab: Lab
) -> None:
    open_wide(page, fresh_lab, "leaderboard")
    published = page.get_by_role("region", name="Example Published ranking")
    expect(published.get_by_role("row").nth(1)).to_contain_text(re.compile(r"9\d\.\d \("))
    expect_no_scrolling(page)
    expect_no_violation(page, DESKTOP, PHONE)
    assert fresh_lab.client.get("/api/v1/leaderboard").json()["began"] is None


def test_ranking_table_has_columns_named_in_words(page: Page, fresh_lab: Lab) -> None:
    open_wide(page, fresh_lab, "ranking")
    heads = page.get_by_role("table").get_by_role("columnheader")
    expect(heads.nth(4)).to_have_text("p-value against NDOBC")
    expect_no_scrolling(page)
