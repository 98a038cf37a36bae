"""The plots in a real browser: chosen, held, zoomed, measured, saved; by role and label."""

import csv
import re
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from svsa.signals import CHANNEL_NAMES
from tests.browser.test_page import ONE_DEGREE, choose, open_page, wait_for_samples
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

VELOCITIES = ("velocity_reference_rad_per_s", "velocity_rad_per_s")
NEWEST = "() => window.svsa.series('position_error_rad').time.at(-1)"
SOME_FRAMES = """async () => {
    for (let i = 0; i < 10; i++) await new Promise(requestAnimationFrame);
}"""
STREAMED = "channel => window.svsa.channels().includes(channel)"


def find_plot(page: Page, name: str) -> Locator:
    plots = page.get_by_role("region", name="Plots", exact=True)
    return plots.get_by_role("region", name=f"{name} plot", exact=True)


def find_axis(page: Page) -> Locator:
    return page.get_by_role("slider", name="Time shown")


def read_span(page: Page) -> tuple[float, float]:
    """From and to of the time axis, s, as it tells them to a screen reader."""
    axis = find_axis(page)
    axis.focus()
    page.evaluate(SOME_FRAMES)
    words = axis.get_attribute("aria-valuetext") or ""
    found = re.fullmatch(r"([\d.-]+) s to ([\d.-]+) s", words)
    assert found, words
    return float(found.group(1)), float(found.group(2))


def hold(page: Page) -> None:
    page.get_by_role("button", name="Pause plots").click()
    expect(page.get_by_role("button", name="Live")).to_be_visible()


def test_the_plots_stand_still_while_the_data_go_on(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    wait_for_samples(page, 1.0)
    hold(page)
    before, newest = read_span(page), page.evaluate(NEWEST)
    wait_for_samples(page, newest + 1.0)
    assert read_span(page) == before
    assert lab.read()["status"] == "running"
    page.get_by_role("button", name="Live").click()
    expect(page.get_by_role("button", name="Pause plots")).to_be_visible()


def test_plots_are_added_removed_kept_and_reset(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    assert not page.evaluate(STREAMED, "deflection_rad")
    page.get_by_role("button", name="Plots", exact=True).click()
    page.get_by_role("checkbox", name="Deflection").check()
    page.get_by_role("checkbox", name="Phase plane").check()
    page.get_by_role("checkbox", name="Stiffness", exact=True).uncheck()
    page.get_by_label("Another plot of").select_option(label="Lever ratio μ")
    page.keyboard.press("Escape")
    for name in ("Deflection", "Phase plane", "Lever ratio μ"):
        expect(find_plot(page, name)).to_be_visible()
    expect(find_plot(page, "Stiffness")).to_have_count(0)
    for channel in ("deflection_rad", "deflection_limit_rad", "lever_ratio", *VELOCITIES):
        page.wait_for_function(STREAMED, arg=channel)
    assert not page.evaluate(STREAMED, "stiffness_nm_per_rad")

    page.reload()
    wait_for_samples(page)
    expect(find_plot(page, "Lever ratio μ")).to_be_visible()
    page.get_by_role("button", name="Lever ratio μ: curves, save, remove").click()
    page.get_by_role("button", name="Remove plot").click()
    expect(find_plot(page, "Lever ratio μ")).to_have_count(0)
    page.get_by_role("button", name="Plots", exact=True).click()
    page.get_by_role("button", name="First plots again").click()
    expect(find_plot(page, "Stiffness")).to_be_visible()
    expect(find_plot(page, "Deflection")).to_have_count(0)


def test_every_channel_of_the_server_can_be_picked(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    page.get_by_role("button", name="Plots", exact=True).click()
    picker = page.get_by_label("Another plot of")
    expect(picker).to_be_visible()
    options = picker.locator("option")
    values = options.evaluate_all("all => all.map(option => option.value).filter(Boolean)")
    derived = {"velocity_error_rad_per_s"}
    assert sorted(values) == sorted(set(CHANNEL_NAMES) - {"time_s"} | derived)


def test_a_channel_more_keeps_the_past_of_the_others(page: Page, lab: Lab) -> None:
    lab.jump(25)
    lab.client.post(lab.session + "/start").raise_for_status()
    open_page(page, lab)
    wait_for_samples(page, 27.0)
    oldest = page.evaluate("() => window.svsa.series('position_error_rad').time[0]")
    page.get_by_role("button", name="Position: curves, save, remove").click()
    page.get_by_role("checkbox", name="Principal motor θ₁").check()
    page.wait_for_function(STREAMED, arg="motor1_position_rad")
    assert page.evaluate("() => window.svsa.series('position_error_rad').time[0]") == oldest
    first = "() => window.svsa.series('motor1_position_rad').value.findIndex(Number.isFinite)"
    page.wait_for_function(f"() => ({first})() > 0")
    page.keyboard.press("Escape")
    legend = find_plot(page, "Position").get_by_role("button", name=re.compile("^θ₁"))
    expect(legend).to_be_visible()


def test_wheel_drag_and_double_click_move_all_plots_in_step(page: Page, lab: Lab) -> None:
    lab.jump(25)
    open_page(page, lab)
    wait_for_samples(page, 24.0)
    box = find_plot(page, "Torque").locator("canvas").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.wheel(0, -400)
    expect(page.get_by_role("button", name="Live")).to_be_visible()
    start, end = read_span(page)
    assert end - start < 15
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y, steps=4)
    page.mouse.up()
    moved = read_span(page)
    assert moved[0] < start
    assert moved[1] - moved[0] == pytest.approx(end - start, abs=0.02)
    page.mouse.dblclick(x, y)
    expect(page.get_by_role("button", name="Pause plots")).to_be_visible()


def test_the_keyboard_moves_zooms_and_goes_live(page: Page, lab: Lab) -> None:
    lab.jump(4)
    open_page(page, lab)
    wait_for_samples(page, 3.0)
    choose(page.get_by_role("radio", name="10 s"))
    find_axis(page).focus()
    page.keyboard.press("+")
    start, end = read_span(page)
    assert end - start == pytest.approx(8, abs=0.02)
    page.keyboard.press("ArrowLeft")
    earlier = read_span(page)
    assert earlier[0] == pytest.approx(start - 0.8, abs=0.02)
    page.keyboard.press("-")
    start, end = read_span(page)
    assert end - start == pytest.approx(10, abs=0.02)
    page.keyboard.press("End")
    expect(page.get_by_role("button", name="Pause plots")).to_be_visible()


def test_cursors_measure_the_samples_between_them(page: Page, lab: Lab) -> None:
    lab.jump(5)
    open_page(page, lab)
    wait_for_samples(page, 4.0)
    page.get_by_role("button", name="Cursors").click()
    first = page.get_by_role("slider", name="Cursor A")
    second = page.get_by_role("slider", name="Cursor B")
    table = page.get_by_role("region", name="Between the cursors", exact=True)
    expect(table.get_by_role("columnheader")).to_have_text(
        ["Curve", "at A", "at B", "Δy", "min", "max", "rms"]
    )
    for name in ("Position", "Position error", "Stiffness", "Torque", "Disturbance"):
        find_plot(page, name).scroll_into_view_if_needed()
        plot, axis = find_plot(page, name).bounding_box(), find_axis(page).bounding_box()
        assert plot is not None
        assert axis is not None
        assert plot["height"] >= 80
        assert plot["y"] + plot["height"] <= axis["y"] + 2
    first.focus()
    page.keyboard.press("ArrowRight")
    before = float(first.get_attribute("aria-valuenow") or "nan")
    page.keyboard.press("ArrowLeft")
    assert before - float(first.get_attribute("aria-valuenow") or "nan") == pytest.approx(0.005)
    second.focus()
    page.keyboard.press("Shift+ArrowLeft")

    box = second.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 12, box["y"] + 12)
    page.mouse.down()
    page.mouse.move(box["x"] - 150, box["y"] + 12, steps=5)
    page.mouse.up()
    a, b = (float(one.get_attribute("aria-valuenow") or "nan") for one in (first, second))
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


def test_an_event_tells_what_it_did_where_it_happened(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Remove 3 kg"))).to_be_visible()
    onset = lab.read()["loads"][0]["start_s"]
    wait_for_samples(page, onset + 2.0)
    mark = page.get_by_role("button", name=re.compile("^3 kg load on, "))
    mark.focus()
    numbers = page.get_by_role("table", name=re.compile("^Position error until now"))
    cells = numbers.get_by_role("cell").all_inner_texts()
    peak = lab.read()["metrics"]["since_load"]["peak_position_error_rad"] / ONE_DEGREE
    assert float(cells[0]) == pytest.approx(peak, rel=1e-3)
    assert 0.1 < float(cells[2]) < 0.5
    page.keyboard.press("Escape")
    expect(numbers).to_have_count(0)


def test_what_is_seen_is_saved(page: Page, lab: Lab, tmp_path: Path) -> None:
    lab.jump(3)
    open_page(page, lab)
    wait_for_samples(page, 2.0)
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


@pytest.mark.exhaustive
def test_eight_plots_do_not_scroll_the_page(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    page.get_by_role("button", name="Plots", exact=True).click()
    for name in ("Stiffness error", "Deflection", "Phase plane"):
        page.get_by_role("checkbox", name=name).check()
    page.keyboard.press("Escape")
    expect(find_axis(page)).to_be_in_viewport(ratio=1)
    heights = page.evaluate("() => [document.documentElement.scrollHeight, window.innerHeight]")
    assert heights[0] == heights[1]


@pytest.mark.exhaustive
def test_the_last_event_stands_still_beside_the_plots(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    page.keyboard.press("z")
    expect(page.get_by_text("No event yet")).to_be_visible()
    page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
    title = page.locator(".zoom-title")
    expect(title).to_have_text(re.compile(r"[\d.]+ s: 3 kg load on"))
    onset = lab.read()["loads"][0]["start_s"]
    wait_for_samples(page, onset + 1.5)
    page.wait_for_timeout(300)
    picture = "canvas => canvas.toDataURL()"
    live, zoom = find_plot(page, "Position").locator("canvas").all()
    before = live.evaluate(picture), zoom.evaluate(picture)
    wait_for_samples(page, onset + 2.5)
    page.wait_for_timeout(300)
    assert live.evaluate(picture) != before[0]
    assert zoom.evaluate(picture) == before[1]
    page.keyboard.press("z")
    expect(find_plot(page, "Position").locator("canvas")).to_have_count(1)
