"""From clicks to scripts: the calls of the page, and the script that repeats an experiment."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.browser.settled import expect_recorded, record_statuses
from tests.browser.test_arm import Arm, open_arm
from tests.browser.test_page import choose, choose_law, open_page
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d", "still")]

LONGEST_SCRIPT_S = 300
COPIED = "async text => (await navigator.clipboard.readText()) === text"


def open_drawer(page: Page) -> Locator:
    page.get_by_role("button", name="Calls as code").click()
    return page.get_by_role("region", name="Calls", exact=True)


def read_clipboard(page: Page) -> str:
    return page.evaluate("() => navigator.clipboard.readText()")


def run_script(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    path = folder / "experiment.py"
    path.write_text(code, encoding="utf-8")
    return subprocess.run(
        [sys.executable, str(path)],
        capture_output=True,
        text=True,
        timeout=LONGEST_SCRIPT_S,
        check=False,
    )


@pytest.fixture(autouse=True)
def clipboard(page: Page) -> None:
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])


def test_every_action_shows_its_call_in_python_and_curl(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    drawer = open_drawer(page)
    expect(drawer).to_contain_text("Use any control")
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    calls = drawer.get_by_role("listitem")
    expect(calls).to_have_count(1)
    address = f"{lab.url}/api/v1/sessions/lab/loads"
    python = f'httpx.post("{address}", json={{"kind": "paper"}})'
    expect(calls.first).to_contain_text(python)
    choose_law(page, "FL")
    expect(calls.last).to_contain_text('json={"law": "fl"}')
    expect(calls).to_have_count(2)
    record_statuses(page)
    calls.first.get_by_role("button", name="Copy POST sessions/lab/loads").click()
    expect_recorded(page, "Copied")
    page.wait_for_function(COPIED, arg=python)

    choose(drawer.get_by_role("radio", name="curl"))
    expect(calls.first).to_contain_text(f"curl -X POST '{address}' -H 'Content-Type:")
    page.get_by_text("Gains, coefficient by coefficient").click()
    field = page.get_by_role("spinbutton", name=re.compile("c₀ of q"))
    field.fill("-1")
    field.press("Enter")
    expect(calls.last).to_contain_text("rejected, 422")
    page.get_by_role("button", name="Copy all").click()
    page.wait_for_function(
        "async () => (await navigator.clipboard.readText()).split('curl -X').length === 4"
    )


def test_experiment_as_a_script_repeats_it_and_disturbs_no_user(
    page: Page, lab: Lab, tmp_path: Path
) -> None:
    open_page(page, lab)
    field = page.get_by_role("spinbutton", name="Stiffness", exact=True).first
    field.fill("40")
    with page.expect_response("**/stiffness"):
        field.press("Enter")
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    lab.jump(1)
    page.get_by_role("switch", name=re.compile("^Compare with")).click()
    expect(page.get_by_role("table", name=re.compile("Comparison of controllers"))).to_be_visible()
    page.get_by_role("button", name=re.compile("Remove 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Hang 3 kg"))).to_be_visible()
    lab.jump(1)

    drawer = open_drawer(page)
    record_statuses(page)
    drawer.get_by_role("button", name="Copy this experiment as a script").click()
    expect_recorded(page, "Copied")
    before = lab.read()
    sessions = len(lab.client.get("/api/v1/sessions").json())
    code = read_clipboard(page)
    with page.expect_download() as download:
        drawer.get_by_role("button", name="Save .py").click()
    assert download.value.suggested_filename == "experiment.py"
    assert download.value.path().read_text(encoding="utf-8") == code
    done = run_script(code, tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr

    reported = [
        f"{lane['name']}: rms position error {lane['in_window']['rms_position_error_rad']:.3e} rad"
        f" since {before['window']['start_s']:.3f} s"
        for lane in before["lanes"]
    ]
    assert done.stdout.splitlines() == [*reported, f"reached {before['time_s']:.3f} s"]
    assert lab.read() == before
    assert len(lab.client.get("/api/v1/sessions").json()) == sessions


def test_script_of_an_arm_is_saved_or_its_problem_is_shown(page: Page, lab: Lab) -> None:
    open_arm(page, lab, Arm(lab))
    drawer = open_drawer(page)
    with page.expect_download() as download:
        drawer.get_by_role("button", name="Save .py").click()
    assert 'settings = {"arm": "rods",' in download.value.path().read_text(encoding="utf-8")
    problem = {"problem": "Its limits are different."}
    page.route("**/origin", lambda route: route.fulfill(json=route.fetch().json() | problem))
    drawer.get_by_role("button", name="Save .py").click()
    expect(drawer.get_by_role("alert")).to_have_text("Its limits are different.")


@pytest.mark.exhaustive
def test_script_stops_where_the_lab_rejects_a_call(page: Page, lab: Lab, tmp_path: Path) -> None:
    open_page(page, lab)
    drawer = open_drawer(page)
    with page.expect_download() as download:
        drawer.get_by_role("button", name="Save .py").click()
    code = download.value.path().read_text(encoding="utf-8")
    broken = code.replace("session.reset()", "session.set_speed(-1)")
    done = run_script(broken, tmp_path)
    assert done.returncode == 1
    assert "speed is -1: it must be" in done.stderr
    assert "Traceback" not in done.stderr
