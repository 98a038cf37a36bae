"""The recorded runs in a real browser: found, replayed, compared, branched, deleted, taken back."""

import re
from collections.abc import Iterator
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import FrameLocator, Locator, Page, Response, Route, expect

from tests.browser.test_page import go_to_page
from tests.lab import Lab, run_lab
from tests.server.routes.test_recording_routes import wait_for_run

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

PATIENCE_MS = 60_000
SECONDS = 7
BOTH, STIFF = "Both laws at 15 N·m/rad", "Stiff and alone"


def record(lab: Lab, name: str, figure: str, rivals: list[str], tags: list[str]) -> str:
    """A run of a figure of the paper with its load at 5 s, recorded from t = 0."""
    lab.load_figure(figure, load=True)
    lab.client.post(lab.session + "/pause").raise_for_status()
    lab.client.post(lab.session + "/reset").raise_for_status()
    lanes = {"rivals": [{"law": law} for law in rivals]}
    lab.client.put(lab.session + "/lanes", json=lanes).raise_for_status()
    wanted = {"name": name, "tags": tags, "notes": ""}
    answer = lab.client.post(lab.session + "/recording", json=wanted).raise_for_status().json()
    lab.jump(SECONDS)
    lab.client.delete(lab.session + "/recording").raise_for_status()
    return answer["recording"]["run_id"]


@pytest.fixture(scope="module")
def own_lab() -> Iterator[Lab]:
    """A lab whose runs nobody else records; the first test begins without one."""
    with run_lab() as lab:
        yield lab


@pytest.fixture(scope="module")
def recorded(own_lab: Lab) -> tuple[str, str]:
    """Two runs, the older first."""
    pair = (
        record(own_lab, BOTH, "4a", ["fl"], ["class"]),
        record(own_lab, STIFF, "4b", [], []),
    )
    for run in pair:
        assert wait_for_run(own_lab, run)["state"] == "complete"
    return pair


@pytest.fixture
def runs(own_lab: Lab, recorded: tuple[str, str]) -> Iterator[tuple[str, str]]:
    """Both runs, which are afterwards what they were before."""
    yield recorded
    for run, name, tags in zip(recorded, (BOTH, STIFF), (["class"], []), strict=True):
        path = f"/api/v1/runs/{run}"
        if own_lab.client.get(path).json()["deleted"] is not None:
            own_lab.client.post(path + "/restore").raise_for_status()
        wanted = {"name": name, "tags": tags, "notes": ""}
        own_lab.client.patch(path, json=wanted).raise_for_status()


@pytest.fixture
def without_replay(page: Page) -> None:
    """The frame of a replay stays empty, for tests that do not look at it: it has a 3D view."""
    page.route(
        re.compile(r"/replay(\?|$)"), lambda route: route.fulfill(body="<title>Replay</title>")
    )


def open_list(page: Page, lab: Lab) -> None:
    page.goto(lab.url + "/?runs=all")
    expect(page.get_by_role("heading", name=re.compile("^Runs"))).to_be_visible()


def find_names(page: Page) -> Locator:
    """What the runs of the table are called, from the top."""
    return page.get_by_role("table", name="Recorded runs").locator(".run-title > :first-child")


def find_replay(page: Page) -> FrameLocator:
    return page.frame_locator("iframe[title^='Replay of']")


def is_change(answer: Response) -> bool:
    """Whether it answers what was changed about a run."""
    return answer.request.method == "PATCH"


def read_moment(page: Page) -> float:
    return float(parse_qs(urlsplit(page.url).query).get("t", ["0"])[0])


def test_nothing_recorded_tells_how_and_then_the_run_is_there(page: Page, own_lab: Lab) -> None:
    own_lab.load_figure()
    page.goto(own_lab.url)
    expect(page.get_by_role("button", name="Record", exact=True)).to_be_enabled()
    page.keyboard.press("o")
    expect(page.get_by_text("Nothing is recorded yet")).to_be_visible()
    page.get_by_role("link", name="Back to the lab", exact=True).click()
    page.get_by_role("button", name="Record", exact=True).click()
    page.get_by_role("button", name=re.compile("^Recording (?!0:00)")).click()
    note = page.get_by_role("status").filter(has_text="Saved: Fig. 4A · NDOBC · σ 15 · no load")
    expect(note).to_be_visible()
    go_to_page(page, "Runs")
    row = page.get_by_role("table", name="Recorded runs").get_by_role("row").nth(1)
    expect(row.get_by_role("link", name="Fig. 4A · NDOBC · σ 15 · no load")).to_be_visible()
    page.set_viewport_size({"width": 1440, "height": 900})
    expect(row.get_by_role("img", name=re.compile("Position error of NDOBC"))).to_be_visible()
    row.get_by_role("button", name=re.compile("^Delete")).click()
    expect(page.get_by_text("Nothing is recorded yet")).to_be_visible()


def test_runs_are_found_by_what_is_seen_filtered_and_sorted(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    open_list(page, own_lab)
    names = find_names(page)
    expect(names).to_have_text([STIFF, BOTH])
    search = page.get_by_role("searchbox", name="Search")
    search.fill("alone 60")
    expect(names).to_have_text([STIFF])
    expect(page.locator("mark")).to_have_text(["alone", "60"])
    search.fill("nothing of this kind")
    page.get_by_role("button", name="Show all runs").click()
    expect(names).to_have_text([STIFF, BOTH])

    page.get_by_role("combobox", name="Law").select_option("fl")
    expect(names).to_have_text([BOTH])
    page.get_by_role("combobox", name="Law").select_option("")
    page.get_by_role("button", name="σ", exact=True).click()
    expect(names).to_have_text([BOTH, STIFF])
    head = page.get_by_role("columnheader", name="σ")
    expect(head).to_have_attribute("aria-sort", "ascending")
    page.keyboard.press("Enter")
    expect(names).to_have_text([STIFF, BOTH])
    expect(head).to_have_attribute("aria-sort", "descending")


@pytest.mark.usefixtures("without_replay")
def test_a_tag_is_given_on_the_page_of_a_run_and_filters_the_table(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{own_lab.url}/?run={runs[1]}")
    tags = page.get_by_role("list", name=f"Tags of {STIFF}")
    tags.get_by_role("button", name="+ tag").press("Enter")
    tags.get_by_role("textbox", name="New tag").fill("stiff")
    with page.expect_response(is_change):
        page.keyboard.press("Enter")
    expect(tags).to_contain_text("stiff")
    page.get_by_role("link", name="All runs").press("Enter")
    page.get_by_role("combobox", name="Tag").select_option("stiff")
    expect(find_names(page)).to_have_text([STIFF])
    page.get_by_role("link", name=STIFF).click()
    with page.expect_response(is_change):
        tags.get_by_role("button", name="Remove tag stiff").press("Enter")
    expect(tags).not_to_contain_text("stiff")
    assert own_lab.client.get(f"/api/v1/runs/{runs[1]}").json()["tags"] == []


def test_a_replay_that_takes_its_time_is_told_of(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    held: list[Route] = []
    page.route("**/replay", lambda route: held.append(route))
    page.goto(f"{own_lab.url}/?run={runs[1]}", wait_until="commit")
    waiting = page.get_by_role("status").filter(has_text="Making the replay…")
    expect(waiting).to_be_visible()
    expect(find_replay(page).get_by_role("button", name="Play")).to_have_count(0)
    held[0].continue_()
    expect(find_replay(page).get_by_role("button", name="Play")).to_be_visible(timeout=PATIENCE_MS)
    expect(waiting).to_have_count(0)


def test_a_replay_that_is_refused_says_why_and_can_be_asked_for_again(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    refusal = {"error": "busy", "message": "Too many wait: ask again in 5 s.", "violations": []}
    page.route("**/replay", lambda route: route.fulfill(status=503, json=refusal))
    page.goto(f"{own_lab.url}/?run={runs[1]}")
    told = page.get_by_role("alert").filter(has_text="Too many wait: ask again in 5 s.")
    expect(told).to_be_visible()
    page.unroute("**/replay")
    told.get_by_role("button", name="Try again").click()
    expect(find_replay(page).get_by_role("button", name="Play")).to_be_visible(timeout=PATIENCE_MS)
    expect(told).to_have_count(0)


NUMBERS_CUT = """() => [...document.querySelectorAll(".overlay-table td, .overlay-table th")]
    .filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.innerText)"""


def test_on_a_phone_the_numbers_of_an_overlay_come_beside_the_whole_names(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    long = "A name as long as somebody types it who does not think of tables, not even of one"
    own_lab.client.patch(f"/api/v1/runs/{runs[1]}", json={"name": long}).raise_for_status()
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(f"{own_lab.url}/?overlay={','.join(runs)}")
    table = page.get_by_role("region", name="Each in the window named")
    name = table.get_by_role("rowheader").filter(has_text=long)
    name.scroll_into_view_if_needed()
    whole = table.bounding_box()
    first = name.bounding_box()
    assert whole is not None
    assert first is not None
    assert first["width"] < 0.6 * whole["width"]
    assert page.evaluate(NUMBERS_CUT) == []
    table.evaluate("one => one.scrollTo({ left: 400 })")
    moved = name.bounding_box()
    assert moved is not None
    assert moved["x"] == pytest.approx(first["x"], abs=1), "the name stays beside its numbers"


@pytest.mark.usefixtures("without_replay")
def test_no_control_of_the_live_session_stands_above_a_replay(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{own_lab.url}/?run={runs[1]}")
    expect(page.get_by_role("button", name="Branch at 0 s")).to_be_visible()
    top = page.get_by_role("banner")
    for name in ("Fig. 4A", "Run", "Pause", "Reset", "Record"):
        expect(top.get_by_role("button", name=name, exact=True)).to_have_count(0)
    expect(page.get_by_role("button", name="Quick stop")).to_be_visible()
    top.get_by_role("link", name="Back to the lab").click()
    expect(top.get_by_role("button", name="Record", exact=True)).to_be_visible()


def test_a_run_that_is_not_there_says_so_and_leads_back(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{own_lab.url}/?run=20200101-000000-deadbeef")
    expect(page.get_by_role("heading", name="This run cannot be shown")).to_be_visible()
    expect(page.get_by_role("alert")).to_contain_text("20200101-000000-deadbeef")
    page.get_by_role("link", name="All runs").press("Enter")
    expect(find_names(page)).to_have_count(len(runs))


NAMES_CUT = """() => [...document.querySelectorAll(".run-title > :first-child")]
    .filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.innerText)"""


def test_a_run_is_named_whole_beside_its_tags(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    tags = {"name": "", "tags": ["stiff", "before the holidays", "group 3"]}
    own_lab.client.patch(f"/api/v1/runs/{runs[0]}", json=tags).raise_for_status()
    open_list(page, own_lab)
    name = find_names(page).filter(has_text="Fig. 4A · NDOBC vs FL · σ 15 · 3 kg")
    expect(name).to_be_visible()
    assert page.evaluate(NAMES_CUT) == []


def test_a_link_opens_the_same_run_at_the_same_moment(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{own_lab.url}/?run={runs[0]}&t=5.25")
    time = find_replay(page).get_by_role("status", name="Time")
    expect(time).to_have_text("5.25 s", timeout=PATIENCE_MS)
    plots = find_replay(page).get_by_role("region", name="Plots", exact=True)
    over = "one => [...one.children].at(-1).getBoundingClientRect().bottom - "
    over += "one.getBoundingClientRect().bottom"
    assert plots.evaluate(over) < 0, "the axis of time lies within its panel"
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
    page.get_by_role("button", name="Copy link").press("Enter")
    expect(page.get_by_role("status").filter(has_text="Copied")).to_be_attached()
    page.goto(page.evaluate("() => navigator.clipboard.readText()"))
    expect(time).to_have_text("2.50 s", timeout=PATIENCE_MS)
    assert read_moment(page) == 2.5


@pytest.mark.usefixtures("without_replay")
def test_a_run_is_renamed_and_written_about(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{own_lab.url}/?run={runs[1]}")
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
def test_a_branch_is_a_private_session_that_stands_at_the_moment(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    page.goto(f"{own_lab.url}/?run={runs[0]}&t=6")
    page.get_by_role("button", name="Branch at 6 s").press("Enter")
    expect(page.get_by_text("Private session.")).to_be_visible(timeout=PATIENCE_MS)
    session = parse_qs(urlsplit(page.url).query)["session"][0]
    path = f"/api/v1/sessions/{session}"
    state = own_lab.client.get(path).json()
    assert (state["tick"], state["status"]) == (6000, "paused")
    page.get_by_role("button", name=re.compile("Remove 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Hang 3 kg"))).to_be_visible()
    assert own_lab.client.get(path).json()["loads"] == []
    origin = page.get_by_role("complementary", name="Private session")
    expect(origin).to_contain_text(f"It goes on from Branch of {BOTH} at 6 s")
    assert own_lab.read()["session"] == "lab"
    page.get_by_role("link", name="Back to the shared lab").click()
    expect(page.get_by_text("Private session.")).to_have_count(0)
    own_lab.client.delete(path)


@pytest.mark.usefixtures("without_replay")
def test_a_run_of_a_bench_cannot_be_branched_and_the_page_says_why(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    def tell_bench(route: Route) -> None:
        answer = route.fetch()
        route.fulfill(response=answer, json=answer.json() | {"plant": "emulated"})

    page.route(f"**/api/v1/runs/{runs[0]}", tell_bench)
    page.goto(f"{own_lab.url}/?run={runs[0]}")
    expect(page.get_by_text("this one was recorded on a bench")).to_be_visible()
    expect(page.get_by_role("button", name=re.compile("^Branch"))).to_have_count(0)


def test_runs_are_laid_over_one_another_from_their_load_on(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    open_list(page, own_lab)
    overlay = page.get_by_role("button", name="Overlay runs")
    expect(overlay).to_be_disabled()
    for name in (BOTH, STIFF):
        page.get_by_role("checkbox", name=f"Choose {name}").check()
    page.get_by_role("button", name="Overlay 2 runs").click()
    page.wait_for_url(re.compile("overlay="))
    for title in ("Position error", "Stiffness error"):
        plot = page.get_by_role("region", name=title, exact=True)
        expect(plot.locator("canvas")).to_be_visible()
    rows = page.get_by_role("table", name="Each in the window named").get_by_role("rowheader")
    expect(rows).to_have_text([f"{BOTH} · NDOBC", f"{BOTH} · FL", STIFF])
    metrics = own_lab.client.get(f"/api/v1/runs/{runs[0]}/metrics?start_s=5").json()["lanes"]
    peak = metrics["lane2"]["peak_position_error_rad"] * 57.29578
    row = page.get_by_role("row", name=f"{BOTH} · FL")
    expect(row.get_by_role("cell").nth(2)).to_have_text(f"{peak:.1f}")
    expect(row.get_by_role("cell").nth(0)).to_have_text(re.compile(r"3 kg load, 5\.00–"))
    differing = page.get_by_role("table", name="Settings that differ")
    expect(differing.get_by_role("row", name="σ_d")).to_contain_text("N·m/rad1560")
    expect(differing.get_by_role("row", name="Beside it")).to_contain_text("FLnothing")
    entry = page.get_by_role("button", name=f"{BOTH} · FL")
    entry.click()
    expect(entry).to_have_attribute("aria-pressed", "false")


def test_a_deleted_run_is_taken_back_at_once_or_from_the_trash(
    page: Page, own_lab: Lab, runs: tuple[str, str]
) -> None:
    open_list(page, own_lab)
    names = find_names(page)
    delete = page.get_by_role("button", name=f"Delete {STIFF}")
    delete.click()
    expect(names).to_have_text([BOTH])
    page.get_by_role("status").get_by_role("button", name="Undo").click()
    expect(names).to_have_text([STIFF, BOTH])
    delete.click()
    expect(names).to_have_text([BOTH])
    page.get_by_role("button", name="Trash").click()
    restore = page.get_by_role("button", name=f"Restore {STIFF}")
    restore.first.click()
    expect(restore).to_have_count(0)
    page.get_by_role("button", name="Trash").click()
    expect(names).to_have_text([STIFF, BOTH])


def test_a_run_is_exported_in_every_format(page: Page, own_lab: Lab, runs: tuple[str, str]) -> None:
    page.goto(f"{own_lab.url}/?run={runs[1]}")
    for kind in ("CSV", "Parquet", "MAT", "MCAP", "HTML"):
        page.get_by_text("Export", exact=True).click()
        with page.expect_download(timeout=PATIENCE_MS) as download:
            page.get_by_role("link", name=re.compile(f"^{kind}")).click()
        assert download.value.suggested_filename.endswith("." + kind.lower())
        assert download.value.path().stat().st_size > 1000
