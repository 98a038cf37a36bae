"""A page during a second page, a reload, and a restart of the server."""

import itertools
import re
from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext, Page, expect

from tests.browser.conftest import PATIENCE_MS
from tests.browser.test_page import (
    LAST_TIME,
    choose,
    go_to_page,
    open_page,
    wait_for_samples,
)
from tests.lab import Lab, run_lab
from tests.waiting import follow

pytestmark = pytest.mark.browser

SAMPLE_S = 0.02
FOOT_IS_AT = """height => {
    const { bottom } = document.querySelector(".statusbar").getBoundingClientRect();
    return Math.round(bottom) === height;
}"""
BEGINS_BEFORE = "time => window.svsa.series('position_error_rad').time[0] < time"
WRITE_NUMBERS = """number => {
    document.querySelectorAll(".readout dd").forEach((shown) => {
        shown.textContent = `${number} deg`;
    });
}"""
IS_WIDE = "width => document.documentElement.scrollWidth === width"


@pytest.mark.usefixtures("without_3d", "still")
def test_two_pages_show_one_session_with_their_own_layout(
    context: BrowserContext, lab: Lab
) -> None:
    first, second = context.new_page(), context.new_page()
    open_page(first, lab)
    open_page(second, lab)
    first.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    expect(second.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    second.get_by_role("switch", name=re.compile("^Compare with")).click()
    expect(first.get_by_role("switch", name=re.compile("^Compare with"))).to_be_checked()
    expect(
        second.get_by_role("table", name=re.compile("Comparison of controllers"))
    ).to_be_visible()
    choose(second.get_by_role("radio", name="5 s"))
    expect(first.get_by_role("radio", name="20 s")).to_be_checked()
    first.get_by_role("button", name="Run", exact=True).click()
    second.get_by_role("button", name="Pause", exact=True).click()
    expect(first.get_by_role("button", name="Run", exact=True)).to_be_visible()
    end = lab.read()["time_s"]
    for page in (first, second):
        wait_for_samples(page, after_s=end - SAMPLE_S, before_s=end)
    first.close()
    second.get_by_role("button", name="Run", exact=True).click()
    wait_for_samples(second, end)


@pytest.mark.smoke
@pytest.mark.usefixtures("kept_page", "without_3d", "still")
def test_reload_during_a_run_loses_nothing(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    lab.jump(6)
    choose(page.get_by_role("radio", name="60 s"))
    page.get_by_role("button", name="Record", exact=True).click()
    expect(page.get_by_role("button", name=re.compile("^Recording"))).to_be_visible()
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    lab.jump(1)
    wait_for_samples(page, 7.9)
    page.reload()
    expect(page.get_by_role("button", name=re.compile("^Recording"))).to_be_visible()
    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    expect(page.get_by_role("radio", name="60 s")).to_be_checked()
    wait_for_samples(page, 7.9)
    page.wait_for_function(BEGINS_BEFORE, arg=2.0)
    lab.jump(1)
    wait_for_samples(page, 8.9)
    expect(page.get_by_role("button", name=re.compile("3 kg load on")).first).to_be_visible()


@pytest.mark.usefixtures("kept_page", "without_3d")
def test_restarted_server_is_found_with_its_recordings(page: Page, tmp_path: Path) -> None:
    with run_lab(data=str(tmp_path)) as lab:
        port = int(lab.url.rpartition(":")[2])
        open_page(page, lab)
        lab.client.post(lab.session + "/recording", json={"name": "Cut"}).raise_for_status()
        lab.jump(8)
        wait_for_samples(page, after_s=7.9)
        for _ in range(PATIENCE_MS // 100):
            if lab.read()["recording"]["ticks"] > 7000:
                break
            page.wait_for_timeout(100)
        end = page.evaluate(LAST_TIME)
        lab.process.kill()
        lost = page.get_by_role("alert").get_by_text("Connection lost")
        expect(lost).to_be_visible()
        bar = page.get_by_role("region", name="Status", exact=True)
        expect(bar.get_by_text("Unknown")).to_be_visible()
        for claim in ("Running", "Paused", "real time", "watching"):
            expect(bar.get_by_text(claim)).to_have_count(0)
    with (
        page.expect_request("**/viser/lab/**") as view,
        run_lab(port=port, data=str(tmp_path)) as lab,
    ):
        lab.client.post(lab.session + "/reset").raise_for_status()
        lab.jump(1)
        wait_for_samples(page, before_s=end)
        lab.jump(1)
        wait_for_samples(page, 1.9)
        expect(lost).to_be_hidden()
        another = page.get_by_role("status").filter(has_text="This is a new session")
        expect(another).to_be_visible()
        another.get_by_role("button", name="Dismiss").click()
        expect(another).to_be_hidden()
        go_to_page(page, "Runs")
        row = page.get_by_role("table", name="Recorded runs").get_by_role("row").last
        expect(row.get_by_role("link", name="Cut")).to_be_visible()
        expect(row).to_contain_text("cut off")
        listed = follow(lab.client, "/api/v1/runs", lambda answer: answer["indexing"] is None)
        assert listed["runs"][0]["duration_s"] > 7
    assert view.value.is_navigation_request(), "the 3D view is fetched again"


@pytest.mark.usefixtures("kept_page", "without_3d")
def test_ended_private_session_is_reported_with_a_link_back(page: Page, lab: Lab) -> None:
    name = lab.client.post("/api/v1/sessions", json={}).raise_for_status().json()["session"]
    page.goto(f"{lab.url}/?session={name}")
    bar = page.get_by_role("region", name="Status", exact=True)
    expect(bar.get_by_text("Live")).to_be_visible()
    lab.client.delete(f"/api/v1/sessions/{name}").raise_for_status()
    banner = page.get_by_role("complementary", name="Private session")
    expect(banner).to_contain_text("has ended")
    expect(bar.get_by_text("Running")).to_have_count(0)
    for width, number in itertools.product((390, 320), ("0.0017", "\N{MINUS SIGN}100.1234")):
        page.set_viewport_size({"width": width, "height": 844})
        page.evaluate(WRITE_NUMBERS, number)
        page.wait_for_function(IS_WIDE, arg=width)
    page.set_viewport_size({"width": 1280, "height": 720})
    page.reload()
    expect(banner, "a link to it says so too").to_contain_text("has ended")
    page.wait_for_function(FOOT_IS_AT, arg=720)
    expect(page.get_by_text("Waiting for the lab")).to_have_count(0)
    banner.get_by_role("link", name="Back to the shared lab").click()
    expect(bar.get_by_text("Live")).to_be_visible()
