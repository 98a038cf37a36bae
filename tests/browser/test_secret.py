"""A simulation that is locked with a secret: requested once and never shown."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_accessibility import PHONE, WIDE, expect_no_violation
from tests.browser.test_page import show_all_controls, wait_for_samples
from tests.browser.test_safety import wait_for_status
from tests.browser.test_script import open_drawer
from tests.lab import Lab, run_lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

SECRET = "correct horse battery"


@pytest.fixture(scope="module")
def locked_lab() -> Iterator[Lab]:
    with run_lab(secret=SECRET) as lab:
        yield lab


@pytest.fixture
def locked(page: Page, locked_lab: Lab) -> Lab:
    """The running lab, and a page that requests its secret."""
    locked_lab.load_figure()
    locked_lab.client.post(locked_lab.session + "/start").raise_for_status()
    page.goto(locked_lab.url)
    expect(page.get_by_label("Secret")).to_be_visible()
    return locked_lab


def test_secret_is_requested_once_and_never_shown(page: Page, locked: Lab) -> None:
    field = page.get_by_label("Secret")
    field.fill("wrong wrong")
    field.press("Enter")
    expect(page.get_by_text(re.compile("not the secret", re.I))).to_be_visible()
    # Without login a simulation cannot be stopped, so no stop is offered.
    expect(page.get_by_role("dialog").get_by_role("button", name="Quick stop")).to_have_count(0)
    # The page repeats a stop without an answer: it must be rejected before the login.
    with page.expect_response(re.compile("/api/v1/quick-stop$")):
        page.keyboard.press("Shift+Escape")
    field.fill(SECRET)
    field.press("Enter")
    wait_for_samples(page)
    assert locked.client.get(locked.session).json()["status"] == "running"
    page.keyboard.press("Shift+Escape")
    wait_for_status(page, locked, "paused")
    page.reload()
    wait_for_samples(page)
    show_all_controls(page)
    drawer = open_drawer(page)
    page.get_by_role("button", name="Run", exact=True).click()
    expect(drawer.get_by_role("listitem")).to_have_count(1)
    expect(page.get_by_text(SECRET[:13])).to_have_count(0)


@pytest.mark.exhaustive
@pytest.mark.usefixtures("locked")
def test_login_has_no_violation(page: Page) -> None:
    expect_no_violation(page, WIDE, PHONE)
