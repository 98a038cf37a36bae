"""The 3D view on the page: cameras, pushing the link, low graphics, other lanes as outlines."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.conftest import PATIENCE_MS
from tests.browser.test_page import come_back
from tests.browser.test_safety import wait_for_status
from tests.lab import Lab

pytestmark = pytest.mark.browser

ATTEMPTS = 30
SIZES = ((390, 844), (1280, 720), (1440, 900))
CAMERA = """() => {
    const viser = document.querySelector("iframe").contentWindow.__viserMutable;
    const { x, y, z } = viser?.camera?.position ?? {};
    return [x, y, z];
}"""
# With slow rendering the view is drawn twice a second, or less under other load.
STANDS_STILL = f"""async () => {{
    const read = {CAMERA};
    const before = read();
    await new Promise((resume) => setTimeout(resume, 600));
    for (let i = 0; i < 10; i++) await new Promise(requestAnimationFrame);
    return before.every((value, i) => Number.isFinite(value) && value === read()[i]);
}}"""


IS_THERE = f"place => ({CAMERA})().every((value, i) => Math.abs(value - place[i]) < 0.01)"


def wait_for_view(page: Page) -> None:
    """Wait until the view is displayed and its camera is at rest."""
    expect(page.frame_locator("iframe").locator("canvas").first).to_be_visible()
    page.wait_for_function(
        "() => !!document.querySelector('iframe')?.contentWindow?.__viserMutable?.camera"
    )
    page.wait_for_function(STANDS_STILL)


def open_view(page: Page, lab: Lab) -> None:
    come_back(page, lab)
    page.goto(lab.url)
    wait_for_view(page)


@pytest.fixture(scope="module")
def opened_once(browser: Browser, browser_context_args: dict, shared_lab: Lab) -> Iterator[Page]:
    context = browser.new_context(**browser_context_args)
    page = context.new_page()
    open_view(page, shared_lab)
    yield page
    context.close()


@pytest.fixture
def view(opened_once: Page, browser_context_args: dict, lab: Lab) -> Page:
    """The shared page of these tests, on Figure 4A at 1 s, in full graphics and without names."""
    lab.jump(1)
    page = opened_once
    page.set_viewport_size(browser_context_args["viewport"])
    for name in ("Low graphics", "Names of the parts"):
        switch = page.get_by_role("button", name=name)
        if switch.get_attribute("aria-pressed") == "true":
            switch.press("Enter")
        expect(switch).to_have_attribute("aria-pressed", "false")
    wait_for_view(page)
    return page


def test_camera_moves_to_a_preset_of_this_page_only(view: Page) -> None:
    page = view
    page.get_by_role("button", name="Camera: Side").click()
    page.wait_for_function(f"() => ({CAMERA})()[0] < -11")
    page.get_by_role("button", name="Camera: Front").click()
    page.wait_for_function(f"() => ({CAMERA})()[2] < -8")


def test_camera_remains_when_the_view_is_loaded_again(view: Page) -> None:
    """As after a lost connection."""
    view.get_by_role("button", name="Camera: Side").click()
    view.wait_for_function(f"() => ({CAMERA})()[0] < -11")
    view.get_by_role("button", name="Dark theme").click()
    view.wait_for_function("() => document.querySelector('iframe').src.includes('darkMode')")
    wait_for_view(view)
    assert view.evaluate(CAMERA)[0] < -11
    view.get_by_role("button", name="Light theme").click()
    wait_for_view(view)


# Its messages from the connection on are held until `connectViser()`.
SLOW_CONNECTION = """
const Plain = Worker;
window.Worker = class extends Plain {
    set onmessage(take) {
        let held = Promise.resolve();
        super.onmessage = (event) => {
            if (event.data.type === "connected")
                held = new Promise((connect) => { top.connectViser = connect; });
            held = held.then(() => take.call(this, event));
        };
    }
};"""


def test_camera_chosen_before_the_scene_arrives_remains(own_page: Page, lab: Lab) -> None:
    """viser returns to its first camera when it receives a scene."""
    own_page.add_init_script(SLOW_CONNECTION)
    open_view(own_page, lab)
    own_page.wait_for_function("() => !!window.connectViser")
    own_page.get_by_role("button", name="Camera: Side").click()
    own_page.evaluate("connectViser()")
    own_page.wait_for_function(f"() => ({CAMERA})()[0] < -11")
    own_page.wait_for_function(
        "() => !!document.querySelector('iframe').contentWindow.__viserMutable"
        ".nodeRefFromName['/a/l']"
    )
    wait_for_view(own_page)
    assert own_page.evaluate(CAMERA)[0] < -11


# Problems of the labels on the picture, once all labels have been laid out again.
FIND_LABEL_PROBLEMS = """async () => {
    for (let i = 0; i < 14; i++) await new Promise(requestAnimationFrame);
    const view = document.querySelector(".view");
    const frame = view.querySelector("iframe").getBoundingClientRect();
    const shown = [...view.querySelectorAll(".scene-labels span")]
        .filter((one) => getComputedStyle(one).visibility === "visible")
        .map((one) => ({ text: one.innerText, box: one.getBoundingClientRect() }));
    const tools = [...view.querySelectorAll(".tool")]
        .map((one) => ({ text: one.innerText || "tool", box: one.getBoundingClientRect() }));
    const problems = shown.length < 3 ? [`only ${shown.length} labels`] : [];
    for (const [index, { text, box }] of shown.entries()) {
        if (box.left < frame.left || box.right > frame.right || box.top < frame.top ||
            box.bottom > frame.bottom) problems.push(`${text} is cut`);
        for (const { text: other, box: b } of [...shown.slice(index + 1), ...tools]) {
            if (Math.min(box.right, b.right) > Math.max(box.left, b.left) &&
                Math.min(box.bottom, b.bottom) > Math.max(box.top, b.top)) {
                problems.push(`${text} lies over ${other}`);
            }
        }
    }
    return problems;
}"""


@pytest.mark.exhaustive
def test_labels_lie_on_the_picture_without_overlap(view: Page, lab: Lab) -> None:
    page = view
    comparisons = {"comparisons": [{"law": "fl"}, {"law": "ndobc"}]}
    lab.client.put(lab.session + "/lanes", json=comparisons).raise_for_status()
    lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
    problems = []

    def measure(where: str) -> None:
        """Repeat until the picture shows the requested view, after a finding."""
        found = []
        for _ in range(ATTEMPTS):
            found = page.evaluate(FIND_LABEL_PROBLEMS)
            if not found:
                return
        problems.extend(f"{where}: {problem}" for problem in found)

    for (width, height), stiffness in zip(SIZES, (5.0, 15.0, 60.0), strict=True):
        reference = {"kind": "constant", "stiffness_nm_per_rad": stiffness}
        lab.client.put(lab.session + "/stiffness", json=reference).raise_for_status()
        lab.jump(3)
        page.set_viewport_size({"width": width, "height": height})
        measure(f"{width} px")
        page.keyboard.press("n")
        for camera in ("Front", "Side", "Spring", "Whole"):
            page.get_by_role("button", name=f"Camera: {camera}").click()
            measure(f"{width} px, {camera}, {stiffness:g} N·m/rad, names")
        page.keyboard.press("n")
    assert not problems, "\n".join(problems)


@pytest.mark.exhaustive
@pytest.mark.usefixtures("kept_page", "still")
def test_initial_camera_is_fitted_and_a_narrower_window_moves_it_back(page: Page, lab: Lab) -> None:
    page.set_viewport_size({"width": 1280, "height": 720})
    open_view(page, lab)
    first = page.evaluate(CAMERA)
    page.get_by_role("button", name="Camera: Whole").click()
    page.wait_for_function(STANDS_STILL)
    page.wait_for_function(IS_THERE, arg=first)
    page.set_viewport_size({"width": 1130, "height": 1200})
    page.wait_for_function(f"() => ({CAMERA})()[2] < {1.2 * first[2]}")


def wait_for_push(page: Page, lab: Lab) -> None:
    """Wait until the link is pushed."""
    for _ in range(PATIENCE_MS // 100):
        if any(load["active"] for load in lab.read()["loads"]):
            return
        page.wait_for_timeout(100)
    raise AssertionError("the link is not pushed")


def wait_for_end(page: Page, lab: Lab) -> int:
    """Wait until nothing pushes and each push has ended; return their number.

    If the page sends nothing in time, the server ends its push, and the page starts the push again.
    """
    labels: list[str] = []
    for _ in range(PATIENCE_MS // 100):
        state = lab.read()
        events = (event["label"] for event in state["events"])
        labels = [label for label in events if label.startswith("Push")]
        many = len(labels) // 2
        is_pushed = any(load["active"] for load in state["loads"])
        if labels == many * ["Push on", "Push off"] and not is_pushed:
            return many
        page.wait_for_timeout(100)
    raise AssertionError(f"pushes: {labels}")


def test_link_is_pushed_with_the_mouse_and_by_keys(view: Page, lab: Lab) -> None:
    page = view
    page.get_by_role("button", name="Camera: Front").click()
    page.wait_for_function(f"() => ({CAMERA})()[2] < -8")
    page.wait_for_function(STANDS_STILL)
    lab.client.post(lab.session + "/start").raise_for_status()
    page.get_by_role("button", name="Push").click()
    layer = page.get_by_role("button", name=re.compile("Drag to push"))
    box = layer.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] * 0.7
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 110, y - 60, steps=4)
    wait_for_push(page, lab)
    page.mouse.up()
    by_mouse = wait_for_end(page, lab)
    assert by_mouse >= 1
    layer.focus()
    page.keyboard.down("ArrowRight")
    wait_for_push(page, lab)
    page.keyboard.up("ArrowRight")
    assert wait_for_end(page, lab) > by_mouse
    layer.press("Escape")
    expect(layer).to_be_hidden()


def test_shift_escape_stops_from_a_text_field_and_from_the_3d_view(view: Page, lab: Lab) -> None:
    page = view
    field = page.get_by_role("spinbutton", name=re.compile("Frequency")).first
    lab.client.post(lab.session + "/start").raise_for_status()
    field.fill("0.3")
    field.press("Shift+Escape")
    wait_for_status(page, lab, "paused")
    lab.client.post(lab.session + "/start").raise_for_status()
    inside = page.frame_locator("iframe").locator("body")
    inside.evaluate("body => { body.tabIndex = 0; body.focus(); }")
    page.keyboard.press("Shift+Escape")
    wait_for_status(page, lab, "paused")


def test_names_of_the_parts_are_shown_in_the_requesting_window_only(view: Page) -> None:
    page = view
    seen = """name => document.querySelector("iframe").contentWindow
        .__viserMutable && document.querySelector("iframe").contentWindow
        .__viserSceneTree.getState()[name]?.visibility"""
    names = page.get_by_role("button", name="Names of the parts")
    page.wait_for_function(f"() => ({seen})('/a/c/p/n4') === false")
    page.keyboard.press("n")
    expect(names).to_have_attribute("aria-pressed", "true")
    page.wait_for_function(f"() => ({seen})('/a/c/p/n4')")
    names.click()
    page.wait_for_function(f"() => !({seen})('/a/c/p/n4')")


def test_low_graphics_are_remembered(view: Page) -> None:
    page = view
    switch = page.get_by_role("button", name="Low graphics")
    full = page.frame_locator("iframe").locator("canvas").first.bounding_box()
    switch.click()
    expect(switch).to_have_attribute("aria-pressed", "true")
    pixels = "document.querySelector('iframe').contentWindow.innerWidth"
    assert full is not None
    page.wait_for_function(f"() => {pixels} < {0.7 * full['width']}")
    page.reload()
    expect(switch).to_have_attribute("aria-pressed", "true")


@pytest.mark.usefixtures("still")
def test_focused_3d_view_is_marked(own_page: Page, lab: Lab) -> None:
    open_view(own_page, lab)
    ring = "() => getComputedStyle(document.querySelector('.view'), '::after').borderTopWidth"
    assert own_page.evaluate(ring) != "2px"
    own_page.evaluate("document.querySelector('iframe').contentWindow.focus()")
    own_page.wait_for_function(f"({ring})() === '2px'")
    own_page.get_by_role("button", name="Reset").focus()
    own_page.wait_for_function(f"({ring})() !== '2px'")
