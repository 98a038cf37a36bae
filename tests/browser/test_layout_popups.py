"""Popups stay on the screen and at their button."""

import pytest
from playwright.sync_api import Page, expect

from tests.browser.measured_layout import FIND_POPUP_PROBLEMS
from tests.browser.settled import resize
from tests.browser.visited_layout import SIZES, measure, visit  # noqa: F401

pytestmark = pytest.mark.browser


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_popups_stay_on_the_screen(visited: Page) -> None:
    problems = measure(visited, FIND_POPUP_PROBLEMS, SIZES[::2])
    assert not problems, "\n".join(problems)


@pytest.mark.parametrize("visited", ["simulation"], indirect=True)
def test_popup_follows_its_button_when_the_window_changes(visited: Page) -> None:
    resize(visited, 1440, 900)
    visited.get_by_role("button", name="Plots", exact=True).click()
    opened = visited.locator(".popup:popover-open")
    expect(opened).to_be_in_viewport(ratio=1)
    resize(visited, 1280, 720)
    expect(opened).to_be_in_viewport(ratio=1)
    visited.keyboard.press("Escape")
