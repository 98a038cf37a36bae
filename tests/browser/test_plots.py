"""The plots in a real browser: held, zoomed, measured, saved; by role and label."""

import csv
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from svsa.actuators.signals import CHANNEL_NAMES
from tests.browser.conftest import KeptPage, leave_3d_empty
from tests.browser.test_page import ONE_DEGREE, choose, open_page, wait_for_samples
from tests.lab import Lab

pytestmark = pytest.mark.browser

NEWEST = "() => window.svsa.series('position_error_rad').time.at(-1)"
OLDEST = "() => window.svsa.series('position_error_rad').time[0]"
SOME_FRAMES = """async () => {
    for (let i = 0; i < 10; i++) await new Promise(requestAnimationFrame);
}"""
STREAMED = "channel => window.svsa.channels().includes(channel)"
SPAN = """() => {
    const words = document.querySelector(".time-axis").getAttribute("aria-valuetext") ?? "";
    const [, from, to] = words.match(/^([\\d.-]+) s to ([\\d.-]+) s$/).map(Number);
    return [from, to];
}"""


@pytest.fixture(scope="module")
def opened(kept_pages: tuple[KeptPage, KeptPage], shared_lab: Lab) -> Iterator[Page]:
    """The shared page of these tests, on a session paused at 25 s."""
    shared_lab.restart()
    shared_lab.jump(25)
    page = kept_pages[0].get()
    leave_3d_empty(page)
    open_page(page, shared_lab)
    wait_for_samples(page, 24.9)
    yield page
    kept_pages[0].forget()


@pytest.fixture
def page(opened: Page) -> Page:
    """Reset to live, with 20 s."""
    live = opened.get_by_role("button", name="Live", exact=True)
    if live.is_visible():
        live.press("Enter")
    expect(opened.get_by_role("button", name="Pause plots")).to_be_visible()
    choose(opened.get_by_role("radio", name="20 s"))
    return opened


def find_plot(page: Page, name: str) -> Locator:
    plots = page.get_by_role("region", name="Plots", exact=True)
    return plots.get_by_role("region", name=f"{name} plot", exact=True)


def find_axis(page: Page) -> Locator:
    return page.get_by_role("slider", name="Time shown")


def wait_for_span(page: Page, condition: str = "true") -> tuple[float, float]:
    """Return start and end of the time axis, s, from its accessible label, once they match."""
    reported = page.wait_for_function(
        f"() => {{ const [from, to] = ({SPAN})(); return ({condition}) && [from, to]; }}"
    )
    start, end = reported.json_value()
    return start, end


def is_about(what: str, value: float) -> str:
    return f"Math.abs({what} - {value}) <= 0.02"


def hold(page: Page) -> None:
    page.get_by_role("button", name="Pause plots").press("Enter")
    expect(page.get_by_role("button", name="Live")).to_be_visible()


def test_held_plots_do_not_move_while_samples_arrive(page: Page, shared_lab: Lab) -> None:
    hold(page)
    page.evaluate(SOME_FRAMES)
    before, newest = wait_for_span(page), page.evaluate(NEWEST)
    shared_lab.jump(1)
    wait_for_samples(page, newest + 0.9)
    page.evaluate(SOME_FRAMES)
    assert wait_for_span(page) == before
    page.get_by_role("button", name="Live").press("Enter")
    wait_for_span(page, f"to > {newest + 0.5}")


def test_every_channel_of_the_server_can_be_selected(page: Page) -> None:
    page.get_by_role("button", name="Plots", exact=True).click()
    picker = page.get_by_label("Another plot of")
    expect(picker).to_be_visible()
    options = picker.locator("option")
    values = options.evaluate_all("all => all.map(option => option.value).filter(Boolean)")
    edges = {f"stiffness_{edge}_nm_per_rad" for edge in ("upper", "lower")}
    derived = {"velocity_error_rad_per_s"} | edges
    assert sorted(values) == sorted(set(CHANNEL_NAMES) - {"time_s"} | derived)
    page.keyboard.press("Escape")
    expect(picker).to_be_hidden()


def test_added_channel_keeps_the_past_of_the_others(page: Page, shared_lab: Lab) -> None:
    oldest = page.evaluate(OLDEST)
    page.get_by_role("button", name="Position: curves, save, remove").click()
    page.get_by_role("checkbox", name="Principal motor θ₁").check()
    page.wait_for_function(STREAMED, arg="motor1_position_rad")
    shared_lab.jump(1)
    assert page.evaluate(OLDEST) == oldest
    first = "() => window.svsa.series('motor1_position_rad').value.findIndex(Number.isFinite)"
    page.wait_for_function(f"() => ({first})() > 0")
    page.keyboard.press("Escape")
    legend = find_plot(page, "Position").get_by_role("button", name=re.compile("^θ₁"))
    expect(legend).to_be_visible()


def test_wheel_drag_and_double_click_move_all_plots_together(page: Page) -> None:
    box = find_plot(page, "Torque").locator("canvas").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.wheel(0, -400)
    expect(page.get_by_role("button", name="Live")).to_be_visible()
    start, end = wait_for_span(page, "to - from < 15")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y, steps=4)
    page.mouse.up()
    wait_for_span(page, f"from < {start} && {is_about('to - from', end - start)}")
    page.mouse.dblclick(x, y)
    expect(page.get_by_role("button", name="Pause plots")).to_be_visible()


def test_keyboard_moves_zooms_and_goes_live(page: Page) -> None:
    choose(page.get_by_role("radio", name="10 s"))
    find_axis(page).focus()
    page.keyboard.press("+")
    start, _ = wait_for_span(page, is_about("to - from", 8))
    page.keyboard.press("ArrowLeft")
    wait_for_span(page, is_about("from", start - 0.8))
    page.keyboard.press("-")
    wait_for_span(page, is_about("to - from", 10))
    page.keyboard.press("End")
    expect(page.get_by_role("button", name="Pause plots")).to_be_visible()


def read_place(cursor: Locator) -> float:
    """Return the position of the cursor after it was drawn."""
    cursor.page.evaluate(SOME_FRAMES)
    return float(cursor.get_attribute("aria-valuenow") or "nan")


def test_cursors_measure_the_samples_between_them(page: Page) -> None:
    page.get_by_role("button", name="Cursors").click()
    first = page.get_by_role("slider", name="Cursor A")
    second = page.get_by_role("slider", name="Cursor B")
    table = page.get_by_role("region", name="Between the cursors", exact=True)
    expect(table.get_by_role("columnheader")).to_have_text(
        ["Curve", "at A", "at B", "Δy", "min", "max", "rms"]
    )
    for name in ("Position", "Position error", "Stiffness", "Torque", "Disturbance"):
        find_plot(page, name).scroll_into_view_if_needed()
        page.evaluate(SOME_FRAMES)
        plot, axis = find_plot(page, name).bounding_box(), find_axis(page).bounding_box()
        assert plot is not None
        assert axis is not None
        assert plot["height"] >= 80
        assert plot["y"] + plot["height"] <= axis["y"] + 2
    first.focus()
    page.keyboard.press("ArrowRight")
    before = read_place(first)
    page.keyboard.press("ArrowLeft")
    assert before - read_place(first) == pytest.approx(0.005)
    second.focus()
    page.keyboard.press("Shift+ArrowLeft")

    page.evaluate(SOME_FRAMES)
    box = second.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 12, box["y"] + 12)
    page.mouse.down()
    page.mouse.move(box["x"] - 150, box["y"] + 12, steps=5)
    page.mouse.up()
    a, b = read_place(first), read_place(second)
    expect(table).to_contain_text(f"{a:.3f} s")
    expect(table).to_contain_text(f"{b:.3f} s")
    series = page.evaluate("() => window.svsa.series('position_rad')")
    held = dict(zip(series["time"], series["value"], strict=True))
    row = table.get_by_role("row", name=re.compile("^actual")).first
    cells = [float(cell.replace("−", "-")) for cell in row.get_by_role("cell").all_inner_texts()]
    assert cells[0] == pytest.approx(held[a] / ONE_DEGREE, rel=1e-3, abs=1e-3)
    assert cells[1] == pytest.approx(held[b] / ONE_DEGREE, rel=1e-3, abs=1e-3)
    between = [v / ONE_DEGREE for t, v in held.items() if min(a, b) <= t <= max(a, b)]
    assert cells[3] == pytest.approx(min(between), rel=1e-3, abs=1e-3)
    assert cells[4] == pytest.approx(max(between), rel=1e-3, abs=1e-3)


def test_displayed_curves_are_saved(page: Page, tmp_path: Path) -> None:
    hold(page)
    saved = {}
    for kind in ("PNG", "SVG", "CSV"):
        page.get_by_role("button", name="Position error: curves, save, remove").click()
        group = page.get_by_role("dialog", name="Position error: curves, save, remove")
        with page.expect_download() as download:
            group.get_by_role("button", name=kind, exact=True).click()
        saved[kind] = tmp_path / download.value.suggested_filename
        download.value.save_as(saved[kind])
        assert saved[kind].name.startswith("svsa-position-error-")
    assert saved["PNG"].read_bytes().startswith(b"\x89PNG")
    assert "Position error" in saved["SVG"].read_text()
    rows = list(csv.reader(saved["CSV"].open()))
    assert rows[0] == ["time_s [s]", "NDOBC.position_error_rad [rad]"]
    times = [float(row[0]) for row in rows[1:]]
    assert len(times) > 300
    assert times[1] - times[0] == pytest.approx(0.005)


def test_disturbance_plot_names_the_law_that_does_not_use_the_estimate(
    page: Page, shared_lab: Lab
) -> None:
    plot, note = find_plot(page, "Disturbance"), "unused by FL"
    expect(plot).not_to_contain_text("unused")
    shared_lab.client.put(shared_lab.session + "/law", json={"law": "fl"}).raise_for_status()
    expect(plot).to_contain_text(note)
    shared_lab.client.put(shared_lab.session + "/law", json={"law": "ndobc"}).raise_for_status()
    expect(plot).not_to_contain_text(note)
