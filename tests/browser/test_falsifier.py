"""The page of the falsifier: search, save, run other laws and view in 3D, by keyboard."""

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.test_accessibility import PHONE, TABLET, WIDE, expect_no_violation
from tests.browser.test_page import go_to_page
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


def search(page: Page, lab: Lab) -> Locator:
    """Search by keyboard to the end; return the laws that ran in the result."""
    page.goto(lab.url)
    go_to_page(page, "Falsifier")
    page.get_by_label("Failure criterion").select_option(label="peak error")
    page.get_by_label("Effects").select_option(label="none")
    page.get_by_label("Length of a run").fill("8")
    page.get_by_label("Maximum runs").fill("64")
    page.get_by_role("button", name="Search").press("Enter")
    # The result of an earlier search is shown until then.
    page.wait_for_url(re.compile("falsifier=(?!all)"))
    reported = page.get_by_role("region", name=re.compile("^NDOBC: "))
    expect(reported).to_contain_text("Simplified load with the same failure")
    expect(reported).to_contain_text(re.compile(r"pulse of .* N·m on the link"))
    laws = page.get_by_role("region", name="Laws under this load")
    expect(laws).to_contain_text("None of 2 laws had a fault.")
    for name in ("Load", "Position error", "Stiffness error"):
        expect(page.get_by_role("region", name=name, exact=True)).to_be_visible()
    return laws


@pytest.mark.exhaustive
def test_result_has_no_violation(page: Page, still_lab: Lab) -> None:
    search(page, still_lab)
    expect_no_violation(page, WIDE, TABLET, PHONE)


def test_load_is_searched_saved_run_with_a_law_and_shown(page: Page, still_lab: Lab) -> None:
    laws = search(page, still_lab)
    page.get_by_label("Save as").fill("mine")
    page.get_by_label("Save as").press("Enter")
    page.wait_for_url(re.compile("scenario=mine"))
    page.get_by_text("Choose laws").press("Enter")
    page.get_by_role("checkbox", name="FL", exact=True).press("Space")
    expect(laws).to_contain_text("No fault.")
    assert "laws=ndobc" in page.url
    address = page.url
    page.get_by_role("button", name="Open NDOBC under this load in 3D").press("Enter")
    page.wait_for_url(re.compile("session="))
    expect(page.get_by_text("Private session.")).to_be_visible()

    page.goto(address)
    rows = page.get_by_role("table").get_by_role("row")
    expect(rows).to_have_count(2)
    kept = still_lab.client.get("/api/v1/scenarios").json()
    assert "mine" in [one["name"] for one in kept]


def test_invalid_bound_is_reported_at_its_field_and_nothing_is_started(
    page: Page, still_lab: Lab
) -> None:
    page.goto(still_lab.url + "/?falsifier=all")
    before = still_lab.client.get("/api/v1/jobs").json()["total"]
    onset = page.get_by_label("Onset from")
    onset.fill("7.5")
    page.get_by_role("button", name="Search").press("Enter")
    reason = "Range of the onset is [7.5, 7.0]: it must be two numbers, the first at least 0"
    expect(onset).to_have_accessible_description(re.compile(re.escape(reason)))
    expect(onset).to_have_attribute("aria-invalid", "true")
    expect(page.get_by_role("alert")).to_have_count(1)
    assert still_lab.client.get("/api/v1/jobs").json()["total"] == before
