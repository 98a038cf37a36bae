"""A page whose first requests are not answered: it reports it, retries, and opens."""

import pytest
from playwright.sync_api import Page, expect

from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d", "still")]

# Address of a page, and a request that it opens with.
PAGES = {
    "falsifier": ("falsifier=all", "adversaries"),
    "studies": ("studies=all", "studies"),
    "ranking": ("ranking=all", "ranking"),
    "leaderboard": ("leaderboard=all", "leaderboard"),
    "course": ("learn=all", "course"),
    "runs": ("runs=all", "runs?*"),
}


@pytest.mark.parametrize("name", PAGES)
def test_page_without_an_answer_retries(page: Page, lab: Lab, name: str) -> None:
    address, path = PAGES[name]
    page.route(f"**/api/v1/{path}", lambda route: route.abort())
    page.goto(f"{lab.url}/?{address}")
    message = page.get_by_text("The server does not answer. Retrying …")
    expect(message).to_be_visible()
    with page.expect_response(f"**/api/v1/{path}"):
        page.unroute(f"**/api/v1/{path}")
    expect(message).to_have_count(0)
    if name == "falsifier":
        expect(page.get_by_label("Failure criterion")).to_be_visible()
