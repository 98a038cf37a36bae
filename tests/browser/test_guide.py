"""The guide at /docs/guide/ by axe-core, where long lines and tables scroll."""

from functools import partial
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.browser.settled import find_lasting
from tests.browser.test_accessibility import AXE, FIND_VIOLATIONS, PHONE, TAGS, WIDE
from tests.docs.test_questions import site  # noqa: F401
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.exhaustive, pytest.mark.usefixtures("kept_page")]

PAGES = ("index", "studies", "scripting", "tutorials/index", "reference/equations", "laws/ndobc")


@pytest.mark.parametrize("name", PAGES)
def test_guide_page_has_no_accessibility_violation(
    page: Page,
    still_lab: Lab,
    site: Path,  # noqa: F811
    name: str,
) -> None:
    page.goto(f"{still_lab.url}/docs/guide/{name}.html")
    expect(page.get_by_role("heading", level=1)).to_be_visible()
    page.evaluate(AXE.read_text(encoding="utf-8"))
    found: list[str] = []
    for width, height in (WIDE, PHONE):
        page.set_viewport_size({"width": width, "height": height})
        for scheme in ("light", "dark"):
            page.emulate_media(color_scheme=scheme)
            texts = find_lasting(page, partial(page.evaluate, FIND_VIOLATIONS, TAGS))
            found += [f"{width} px, {scheme}: {text}" for text in texts]
    assert not found, "\n".join(found)
