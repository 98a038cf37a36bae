"""The page Grades: graded, and looked at by criterion, by keyboard alone."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from svsa.course.progress import ProgressStore
from tests.browser.test_accessibility import PHONE, WIDE, expect_no_violation
from tests.browser.test_page import WORKER_MS, go_to_page, open_page
from tests.grading.test_class_grades import hand_in
from tests.lab import Lab, run_lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


@pytest.fixture(scope="module")
def lab_with_hand_ins(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    """Two students have handed in what is not done."""
    folder: Path = tmp_path_factory.mktemp("data")
    store = ProgressStore(folder)
    hand_in(store, "p-1", "Ada")
    hand_in(store, "p-2", "Bob")
    with run_lab(data=str(folder)) as lab:
        yield lab


def test_what_was_handed_in_is_graded_and_seen_by_criterion(
    page: Page, lab_with_hand_ins: Lab
) -> None:
    open_page(page, lab_with_hand_ins)
    go_to_page(page, "Grades")
    table = page.get_by_role("region", name="Points, a student a row")
    expect(table.get_by_role("button", name="not graded")).to_have_count(2)
    page.get_by_role("button", name="Grade 2").press("Enter")
    points = table.get_by_role("row", name="Ada").get_by_role("button", name="0 of 14")
    expect(points).to_be_visible(timeout=WORKER_MS)
    expect(page.get_by_role("button", name="All is graded")).to_be_disabled()
    points.press("Enter")
    expect(points).to_have_attribute("aria-pressed", "true")
    told = page.get_by_role("table", name="Points by criterion")
    expect(told.get_by_text("Nothing was predicted.").first).to_be_visible()
    expect_no_violation(page, WIDE, PHONE)
    page.goto(lab_with_hand_ins.url + "/grades")
    expect(table).to_be_visible()
