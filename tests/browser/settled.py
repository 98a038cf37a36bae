"""What is measured in a page once the page has found the place of everything."""

from collections.abc import Callable

from playwright.sync_api import FloatRect, Locator, Page

LOOKS, BETWEEN_LOOKS_MS = 40, 150


def until(page: Page, is_so: Callable[[], object]) -> None:
    """As `expect` does, look again while it is not so."""
    for _ in range(LOOKS):
        if is_so():
            return
        page.wait_for_timeout(BETWEEN_LOOKS_MS)
    assert is_so()


def find_lasting(page: Page, find: Callable[[], list[str]]) -> list[str]:
    """What is found wrong for good: where something is, the page is looked at again."""
    found = find()
    for _ in range(LOOKS):
        if not found:
            break
        page.wait_for_timeout(BETWEEN_LOOKS_MS)
        found = find()
    return found


def resize(page: Page, width: int, height: int) -> None:
    """Until the page knows its size."""
    page.set_viewport_size({"width": width, "height": height})
    page.wait_for_function(
        "([width, height]) => innerWidth === width && innerHeight === height", arg=[width, height]
    )


def get_box(one: Locator) -> FloatRect:
    """Of what is there to be measured."""
    box = one.bounding_box()
    assert box is not None
    return box
