"""Measurements in a page after its layout has settled."""

import time
from collections.abc import Callable

from playwright.sync_api import FloatRect, Locator, Page

from tests.browser.conftest import PATIENCE_MS

BETWEEN_LOOKS_MS = 150


def until(page: Page, is_so: Callable[[], object]) -> None:
    """Repeat until true, for as long as `expect`."""
    end = time.monotonic() + PATIENCE_MS / 1000
    while not is_so():
        assert time.monotonic() < end, f"not true within {PATIENCE_MS / 1000:g} s"
        page.wait_for_timeout(BETWEEN_LOOKS_MS)


def find_lasting(page: Page, find: Callable[[], list[str]]) -> list[str]:
    """Return lasting problems: after a finding, the page is measured again, as `until` does."""
    end = time.monotonic() + PATIENCE_MS / 1000
    while (found := find()) and time.monotonic() < end:
        page.wait_for_timeout(BETWEEN_LOOKS_MS)
    return found


def resize(page: Page, width: int, height: int) -> None:
    """Resize, and wait until the page has its size."""
    page.set_viewport_size({"width": width, "height": height})
    page.wait_for_function(
        "([width, height]) => innerWidth === width && innerHeight === height", arg=[width, height]
    )


def get_box(one: Locator) -> FloatRect:
    """Return the box of an element that exists."""
    box = one.bounding_box()
    assert box is not None
    return box


def record_statuses(page: Page) -> None:
    """Record every text of a status from now on: a busy machine may not look while it is shown."""
    page.evaluate(
        """() => {
            window.statuses = [];
            const record = () => {
                for (const status of document.querySelectorAll("[role=status]"))
                    window.statuses.push(status.textContent);
            };
            const changes = { childList: true, characterData: true, subtree: true };
            new MutationObserver(record).observe(document.body, changes);
        }"""
    )


def expect_recorded(page: Page, text: str) -> None:
    """Wait until a status has had this text since `record_statuses`."""
    page.wait_for_function("text => window.statuses.includes(text)", arg=text)
