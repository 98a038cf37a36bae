"""The page Leaderboard: sorting, opening a worst run by keyboard alone, and submitting a law."""

import re
import shutil
from collections.abc import Iterator

import pytest
from playwright.sync_api import Page, expect

from svsa.teaching.leaderboard import board as boards
from svsa.teaching.leaderboard.board import FOLDER, Board, build_entry, measure_missing
from svsa.teaching.submission import digest_law
from tests.browser.test_accessibility import PHONE, WIDE, expect_no_violation
from tests.browser.test_page import go_to_page, open_page
from tests.lab import Lab
from tests.teaching.leaderboard.test_leaderboard import build_short_season

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

SEED = 1
"""Of a season in whose four trials NDOBC is better than FL."""

ALL_WITHIN_THE_PAGE = """() => {
    const page = document.querySelector("main");
    return [...page.querySelectorAll(".visually-hidden")]
        .every(({ offsetParent }) => page.contains(offsetParent));
}"""


@pytest.fixture
def lab_with_board(still_lab: Lab) -> Iterator[Lab]:
    """A board with FL, NDOBC and a submitted law with the results of FL."""
    folder = still_lab.data / FOLDER
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(boards, "build_season", lambda _: build_short_season(SEED))
        patched.setattr(boards, "list_law_names", lambda: ("fl", "ndobc"))
        board = Board(folder)
        measure_missing(board)
        standing = board.get("fl").standing
        board.keep(build_entry(digest_law(b"mine"), "Mine", False, standing, "Ada"))
    yield still_lab
    shutil.rmtree(folder)


def test_board_is_sorted_opens_a_worst_run_and_survives_a_reload(
    page: Page, lab_with_board: Lab
) -> None:
    open_page(page, lab_with_board)
    go_to_page(page, "Leaderboard")
    table = page.get_by_role("region", name=re.compile("^Rank, success rate"))
    rows = table.get_by_role("row")
    expect(rows.nth(1)).to_contain_text("NDOBC")
    expect(table.get_by_role("row", name=re.compile("Mine by Ada"))).to_be_visible()
    expect(table.get_by_text("not measured in this season yet").first).to_be_visible()
    head = table.get_by_role("columnheader", name="Trials held")
    head.get_by_role("button").press("Enter")
    expect(head).to_have_attribute("aria-sort", "descending")
    # Otherwise the document would be as long as the table, and the window would scroll.
    assert page.evaluate(ALL_WITHIN_THE_PAGE)
    table.get_by_role("link", name=re.compile("^Mine, worst run in 3D")).press("Enter")
    expect(page.get_by_role("heading", name="Worst run of Mine")).to_be_visible()
    expect(page.get_by_text("are not saved")).to_be_visible()
    page.reload()
    expect(page.get_by_role("heading", name="Worst run of Mine")).to_be_visible()
    page.get_by_role("link", name="← Leaderboard").press("Enter")
    expect(table).to_be_visible()
    page.goto(lab_with_board.url + "/leaderboard")
    expect(page).to_have_url(re.compile(r"/\?leaderboard=all$"))
    expect(table).to_be_visible()


@pytest.mark.exhaustive
def test_board_has_no_violation(page: Page, lab_with_board: Lab) -> None:
    page.goto(lab_with_board.url + "/?leaderboard=all")
    expect(page.get_by_role("region", name=re.compile("^Rank, success rate"))).to_be_visible()
    expect_no_violation(page, WIDE, PHONE)
    assert page.evaluate(ALL_WITHIN_THE_PAGE)


def test_failing_law_is_reported_with_the_place(page: Page, lab_with_board: Lab) -> None:
    page.goto(lab_with_board.url + "/?leaderboard=all")
    page.get_by_role("textbox", name="Name of the law").fill("Broken")
    page.get_by_role("textbox", name=re.compile("^Its text")).fill(
        "def law(*given):\n    return spring\n"
    )
    page.get_by_role("button", name="Submit", exact=True).press("Enter")
    expect(page.get_by_role("heading", name=re.compile("^Measur.*: Broken"))).to_be_in_viewport()
    reported = page.get_by_role("alert").filter(has_text="The submission failed.")
    expect(reported).to_contain_text("NameError: name 'spring' is not defined")
    expect(reported).to_contain_text("line 2, in law")
