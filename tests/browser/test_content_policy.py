"""No page of the lab violates its own Content-Security-Policy, in any of its frames."""

import pytest
from playwright.sync_api import BrowserContext, expect

from tests.browser.test_translation import PLACES
from tests.lab import Lab
from tests.waiting import follow_recording, wait_until

pytestmark = [pytest.mark.browser, pytest.mark.exhaustive]

REPORT = """document.addEventListener("securitypolicyviolation", (event) =>
    reportViolation(`${location.pathname}: ${event.violatedDirective} ${event.blockedURI}`))"""


def test_no_page_violates_its_policy(context: BrowserContext, lab: Lab, still: None) -> None:
    violations: list[str] = []
    context.expose_function("reportViolation", lambda text: violations.append(text))
    context.add_init_script(REPORT)
    page = context.new_page()
    answer = lab.client.post(lab.session + "/recording", json={}).raise_for_status().json()
    run_id = answer["recording"]["run_id"]
    lab.jump(1)
    lab.client.delete(lab.session + "/recording").raise_for_status()
    follow_recording(lab.client, f"/api/v1/runs/{run_id}")
    for place in (
        *PLACES.values(),
        f"/?run={run_id}",
        f"/?overlay={run_id}",
        "/docs",
        "/docs/guide/",
    ):
        page.goto(lab.url + place, wait_until="networkidle" if place == "/docs" else "load")
        expect(page.locator("main, #docs, body").first).to_be_visible()
    page.goto(lab.url)
    view = page.frame_locator("iframe").locator("canvas").first
    expect(view).to_be_visible()
    page.get_by_role("button", name="Keyboard shortcuts").press("Enter")
    assert violations == []
    page.evaluate("document.body.append(Object.assign(document.createElement('style'), {}))")
    page.evaluate("document.body.lastChild.textContent = 'b { color: red }'")
    wait_until(lambda: page.evaluate("1") and violations)
    assert "style-src" in violations[0], "a violation is seen"
