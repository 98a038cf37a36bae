"""The page Grades: grading, and the view by criterion, by keyboard alone."""

import re
import shutil
from collections.abc import Iterator

import pytest
from playwright.sync_api import Locator, Page, expect

from svsa.teaching.course.progress import ProgressStore
from svsa.teaching.grading.class_grades import open_book
from tests.browser.test_accessibility import PHONE, WIDE, expect_no_violation
from tests.browser.test_page import go_to_page, open_page
from tests.lab import Lab
from tests.teaching.grading.test_class_grades import submit

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


@pytest.fixture
def lab_with_submissions(still_lab: Lab) -> Iterator[Lab]:
    """Two students have submitted incomplete work."""
    store = ProgressStore(still_lab.data)
    submitted = [submit(store, "p-1", "Ada"), submit(store, "p-2", "Bob")]
    yield still_lab
    for path in submitted:
        path.unlink()
    shutil.rmtree(open_book(store).folder)


def grade(page: Page, lab: Lab) -> Locator:
    """Grade the submissions by keyboard, and open Ada's points in the table."""
    open_page(page, lab)
    go_to_page(page, "Grades")
    table = page.get_by_role("region", name="Points: one row per student")
    for student in ("Ada", "Bob"):
        row = table.get_by_role("row", name=student)
        expect(row.get_by_role("button", name="not graded")).to_be_visible()
    page.get_by_role("button", name=re.compile("^Grade [0-9]")).press("Enter")
    points = table.get_by_role("row", name="Ada").get_by_role("button", name="0 of 14")
    expect(points).to_be_visible()
    expect(page.get_by_role("button", name="All submissions are graded")).to_be_disabled()
    points.press("Enter")
    expect(points).to_have_attribute("aria-pressed", "true")
    reported = page.get_by_role("table", name="Points by criterion")
    expect(reported.get_by_text("Nothing was predicted.").first).to_be_visible()
    return table


def test_submissions_are_graded_and_shown_by_criterion(
    page: Page, lab_with_submissions: Lab
) -> None:
    table = grade(page, lab_with_submissions)
    page.goto(lab_with_submissions.url + "/grades")
    expect(table).to_be_visible()


@pytest.mark.exhaustive
def test_grades_have_no_violation(page: Page, lab_with_submissions: Lab) -> None:
    grade(page, lab_with_submissions)
    expect_no_violation(page, WIDE, PHONE)
