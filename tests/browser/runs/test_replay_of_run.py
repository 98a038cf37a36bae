"""The replay on the page of a run: loading, rejected, omitted, opened by a link."""

import json
import re
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import Page, Route, expect

from svsa_server.problems import MEDIA_TYPE
from tests.browser.runs.recorded import find_replay
from tests.browser.settled import expect_recorded, record_statuses, until
from tests.lab import Lab
from tests.waiting import follow_recording

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


def read_moment(page: Page) -> float:
    return float(parse_qs(urlsplit(page.url).query).get("t", ["0"])[0])


@pytest.mark.exhaustive
def test_slow_replay_is_reported(page: Page, lab: Lab, runs: tuple[str, str]) -> None:
    held: list[Route] = []
    page.route("**/replay", lambda route: held.append(route))
    page.goto(f"{lab.url}/?run={runs[1]}", wait_until="commit")
    waiting = page.get_by_role("status").filter(has_text="Preparing the replay…")
    expect(waiting).to_be_visible()
    until(page, lambda: held)
    expect(find_replay(page).get_by_role("button", name="Play")).to_have_count(0)
    held[0].continue_()
    expect(find_replay(page).get_by_role("button", name="Play")).to_be_visible()
    expect(waiting).to_have_count(0)


@pytest.mark.usefixtures("without_replay")
def test_rejected_replay_has_a_reason_and_can_be_requested_again(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    refusal = {"type": "urn:svsa:problem:busy", "detail": "Too many wait: ask again in 5 s."}
    answer = {"status": 503, "body": json.dumps(refusal), "content_type": MEDIA_TYPE}
    page.route("**/replay", lambda route: route.fulfill(**answer), times=1)
    page.goto(f"{lab.url}/?run={runs[1]}")
    reported = page.get_by_role("alert").filter(has_text="Too many wait: ask again in 5 s.")
    expect(reported).to_be_visible()
    reported.get_by_role("button", name="Try again").click()
    expect(find_replay(page).get_by_text("No replay")).to_be_visible()
    expect(reported).to_have_count(0)


def test_empty_run_is_reported_in_place_of_a_replay(page: Page, lab: Lab) -> None:
    lab.load_figure()
    lab.client.post(lab.session + "/pause").raise_for_status()
    answer = lab.client.post(lab.session + "/recording", json={}).raise_for_status().json()
    lab.client.delete(lab.session + "/recording").raise_for_status()
    run_id = answer["recording"]["run_id"]
    follow_recording(lab.client, f"/api/v1/runs/{run_id}")
    page.goto(f"{lab.url}/?run={run_id}")
    expect(page.get_by_text("This run has no samples")).to_be_visible()
    lab.client.delete(f"/api/v1/runs/{run_id}").raise_for_status()


def test_link_opens_the_same_run_at_the_same_time(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{lab.url}/?run={runs[0]}&t=5.25")
    time = find_replay(page).get_by_role("status", name="Time")
    expect(time).to_have_text("5.25 s")
    plots = find_replay(page).get_by_role("region", name="Plots", exact=True)
    over = "one => [...one.children].at(-1).getBoundingClientRect().bottom - "
    over += "one.getBoundingClientRect().bottom"
    until(page, lambda: plots.evaluate(over) < 0)  # the axis of time lies within its panel
    find_replay(page).get_by_role("slider", name="Time").fill("2.5")
    expect(page.get_by_role("button", name="Branch at 2.5 s")).to_be_visible()
    page.wait_for_url(re.compile(r"t=2\.5\b"))

    root = find_replay(page).locator(":root")
    root.evaluate("one => { one.dataset.kept = 'yes' }")
    page.get_by_role("button", name="Dark theme").click()
    expect(root).to_have_attribute("data-theme", "dark")
    expect(root, "the same page as before").to_have_attribute("data-kept", "yes")
    expect(time).to_have_text("2.50 s")
    page.get_by_role("button", name="Light theme").click()

    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    record_statuses(page)
    page.get_by_role("button", name="Copy link").press("Enter")
    expect_recorded(page, "Copied")
    assert page.evaluate("() => navigator.clipboard.readText()") == page.url
    assert read_moment(page) == 2.5
