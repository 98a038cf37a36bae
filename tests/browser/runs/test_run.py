"""The page of a run: renamed, branched, exported."""

import re
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import Page, Response, Route, expect

from tests.browser.runs.recorded import BOTH, STIFF, is_change
from tests.browser.test_page import show_all_controls
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]


@pytest.mark.exhaustive
@pytest.mark.usefixtures("without_replay")
def test_replay_has_no_controls_of_the_live_session(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{lab.url}/?run={runs[1]}")
    expect(page.get_by_role("button", name="Branch at 0 s")).to_be_visible()
    top = page.get_by_role("banner")
    for name in ("Fig. 4A", "Run", "Pause", "Reset", "Record"):
        expect(top.get_by_role("button", name=name, exact=True)).to_have_count(0)
    expect(page.get_by_role("button", name="Quick stop")).to_have_count(0)
    top.get_by_role("link", name="Lab", exact=True).click()
    show_all_controls(page)
    expect(top.get_by_role("button", name="Record", exact=True)).to_be_visible()


def is_change_of_notes(answer: Response) -> bool:
    return is_change(answer) and answer.ok and "notes" in answer.request.post_data_json


@pytest.mark.usefixtures("without_replay")
def test_run_is_renamed_and_annotated(page: Page, lab: Lab, runs: tuple[str, str]) -> None:
    page.goto(f"{lab.url}/?run={runs[1]}")
    name = page.get_by_role("textbox", name="Name")
    expect(name).to_have_value(STIFF)
    name.fill("Group 3")
    with page.expect_response(is_change):
        name.press("Enter")
    notes = page.get_by_role("textbox", name="Notes")
    notes.fill("no step at the load")
    with page.expect_response(is_change):
        notes.press("Enter")
    page.get_by_role("link", name="All runs").press("Enter")
    row = page.get_by_role("row").filter(has=page.get_by_role("link", name="Group 3"))
    expect(row).to_contain_text("no step at the load")
    page.go_back()
    expect(name).to_have_value("Group 3")


@pytest.mark.usefixtures("without_replay")
def test_branch_is_a_paused_private_session_at_the_selected_time(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{lab.url}/?run={runs[0]}&t=6")
    page.get_by_role("button", name="Branch at 6 s").press("Enter")
    expect(page.get_by_text("Private session.")).to_be_visible()
    session = parse_qs(urlsplit(page.url).query)["session"][0]
    path = f"/api/v1/sessions/{session}"
    state = lab.client.get(path).json()
    assert (state["tick"], state["status"]) == (6000, "paused")
    page.get_by_role("button", name=re.compile("Remove 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Hang 3 kg"))).to_be_visible()
    assert lab.client.get(path).json()["loads"] == []
    origin = page.get_by_role("complementary", name="Private session")
    expect(origin).to_contain_text(f"Continued from Branch of {BOTH} at 6 s")
    assert lab.read()["session"] == "lab"
    page.get_by_role("link", name="Back to the shared lab").click()
    expect(page.get_by_text("Private session.")).to_have_count(0)
    lab.client.delete(path)


@pytest.mark.usefixtures("without_replay")
def test_run_of_a_bench_cannot_be_branched_with_a_reason(
    page: Page, lab: Lab, runs: tuple[str, str]
) -> None:
    def report_bench(route: Route) -> None:
        answer = route.fetch()
        route.fulfill(response=answer, json=answer.json() | {"plant": "emulated"})

    page.route(f"**/api/v1/runs/{runs[0]}", report_bench)
    page.goto(f"{lab.url}/?run={runs[0]}")
    expect(page.get_by_text("this run was recorded on a bench")).to_be_visible()
    expect(page.get_by_role("button", name=re.compile("^Branch"))).to_have_count(0)


@pytest.mark.usefixtures("without_replay")
def test_run_is_exported_in_every_format(page: Page, lab: Lab, runs: tuple[str, str]) -> None:
    """HTML takes some time: the page reports that it is being created, and that it is saved."""
    page.goto(f"{lab.url}/?run={runs[1]}")
    for kind in ("CSV", "Parquet", "MAT", "MCAP", "HTML"):
        page.get_by_text("Export", exact=True).click()
        role = "button" if kind == "HTML" else "link"
        with page.expect_download() as download:
            page.get_by_role(role, name=re.compile(f"^{kind}")).click()
        assert download.value.suggested_filename.endswith("." + kind.lower())
        assert download.value.path().stat().st_size > 1000
    expect(page.get_by_text("The HTML page is saved.")).to_be_visible()
