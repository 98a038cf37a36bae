"""Measurements in a page after its layout has settled."""

from collections.abc import Callable

from playwright.sync_api import FloatRect, Locator, Page

LOOKS, BETWEEN_LOOKS_MS = 40, 150


def until(page: Page, is_so: Callable[[], object]) -> None:
    """Repeat until true, like `expect`."""
    for _ in range(LOOKS):
        if is_so():
            return
        page.wait_for_timeout(BETWEEN_LOOKS_MS)
    assert is_so()


def find_lasting(page: Page, find: Callable[[], list[str]]) -> list[str]:
    """Return lasting problems: after a finding, the page is measured again."""
    found = find()
    for _ in range(LOOKS):
        if not found:
            break
        page.wait_for_timeout(BETWEEN_LOOKS_MS)
        found = find()
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
