"""A browser without WebGL: the reason for the missing 3D view, and the same poses in 2D."""

import math
import re
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser.conftest import ARGUMENTS
from tests.browser.settled import get_box, until
from tests.browser.test_page import come_back, wait_for_samples
from tests.browser.test_view import wait_for_view
from tests.lab import Lab

pytestmark = pytest.mark.browser

NOTE = "This browser has no WebGL, which the 3D view needs."
PICTURE = "The actuator from the front"
LARGEST_DIFFERENCE_DEG = 0.1
SAMPLE_S = 0.02
BORDER_PX = 2.0
PARTS = {"q": "/a/l", "q_d": "/a/g", "q of FL": "/a/r0"}

# Angles about the vertical on the picture, in degrees, by what turns: down from the axis is 0,
# counter-clockwise is positive. The 3D view's are of its front camera.
ANGLES_3D = """parts => {
    const { __viserMutable: viser } = document.querySelector("iframe").contentWindow;
    const onPicture = (frame, point) => {
        const camera = viser.camera;
        const moved = frame.localToWorld(camera.position.clone().set(...point)).project(camera);
        return [moved.x * camera.aspect, moved.y];
    };
    return Object.fromEntries(Object.entries(parts).map(([name, node]) => {
        const frame = viser.nodeRefFromName[node];
        const [[x0, y0], [x1, y1]] = [[0, 0, 0], [1, 0, 0]].map((at) => onPicture(frame, at));
        return [name, Math.atan2(x1 - x0, y0 - y1) * 180 / Math.PI];
    }));
}"""
ANGLES_2D = """() => {
    const svg = document.querySelector(".schematic svg");
    const angle = (part) => {
        const line = part.querySelector("path");
        const matrix = line.getScreenCTM();
        const [from, to] = [0, line.getTotalLength()]
            .map((at) => line.getPointAtLength(at).matrixTransform(matrix));
        return Math.atan2(to.x - from.x, to.y - from.y) * 180 / Math.PI;
    };
    const find = (channel, lane) =>
        svg.querySelector(`[data-channel="${channel}"][data-lane="${lane}"]`);
    return {
        q: angle(find("position_rad", 1)),
        q_d: angle(find("position_reference_rad", 1)),
        "q of FL": angle(find("position_rad", 2)),
    };
}"""


@pytest.fixture(scope="module")
def flat_browser(launch_browser: Callable[..., Browser]) -> Iterator[Browser]:
    """A Chromium without WebGL."""
    browser = launch_browser(args=[*ARGUMENTS, "--disable-3d-apis"])
    yield browser
    browser.close()


@pytest.fixture
def flat(flat_browser: Browser, browser_context_args: dict) -> Iterator[Page]:
    context = flat_browser.new_context(**browser_context_args)
    yield context.new_page()
    context.close()


def open_flat(page: Page, lab: Lab) -> None:
    come_back(page, lab)
    page.goto(lab.url)
    expect(page.get_by_role("img", name=PICTURE)).to_be_visible()


def test_view_states_why_there_is_no_3d_and_draws_the_same_poses(
    flat: Page, own_page: Page, lab: Lab
) -> None:
    comparisons = {"comparisons": [{"law": "fl"}]}
    lab.client.put(lab.session + "/lanes", json=comparisons).raise_for_status()
    lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
    newest_s = lab.jump(3)["time_s"] - SAMPLE_S
    open_flat(flat, lab)
    wait_for_samples(flat, newest_s)
    expect(flat.get_by_text(NOTE)).to_be_in_viewport(ratio=1)
    expect(flat.locator(".view iframe")).to_have_count(0)
    expect(flat.get_by_role("button", name=re.compile("^Camera"))).to_have_count(0)
    come_back(own_page, lab)
    own_page.goto(lab.url)
    wait_for_view(own_page)
    own_page.get_by_role("button", name="Camera: Front").click()
    wait_for_view(own_page)
    wait_for_samples(own_page, newest_s)

    state = own_page.evaluate(
        """() => [["position_rad", 1], ["position_reference_rad", 1], ["position_rad", 2]]
            .map(([channel, lane]) => window.svsa.series(channel, lane).value.at(-1))"""
    )
    sampled = dict(zip(PARTS, map(math.degrees, state), strict=True))
    assert abs(sampled["q of FL"] - sampled["q"]) > 5
    until(
        flat,
        lambda: flat.evaluate(ANGLES_2D) == pytest.approx(sampled, abs=LARGEST_DIFFERENCE_DEG),
    )
    until(
        own_page,
        lambda: own_page.evaluate(ANGLES_3D, PARTS) == pytest.approx(sampled, abs=1.0),
    )


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (390, 844)])
def test_tour_points_at_existing_elements(flat: Page, lab: Lab, width: int, height: int) -> None:
    """At each step its frame surrounds a drawn element."""
    lab.jump(1)
    flat.set_viewport_size({"width": width, "height": height})
    flat.goto(lab.url)
    tour = flat.get_by_role("region", name="Tour of the lab")
    tour.get_by_role("button", name="Take the tour").click()
    expect(tour).to_contain_text("The thick line is the link from the front")
    ring = flat.locator(".tour-ring")

    def is_around_the_picture() -> bool:
        frame, picture = get_box(ring), get_box(flat.get_by_role("img", name=PICTURE))
        return all(
            picture[start] >= frame[start] - BORDER_PX
            and picture[start] + picture[size] <= frame[start] + frame[size] + BORDER_PX
            for start, size in (("x", "width"), ("y", "height"))
        )

    until(flat, is_around_the_picture)
    for title in ("The plots", "The 3 kg load", "FL or NDOBC", "All controls"):
        tour.get_by_role("button", name="Next").click()
        expect(tour.get_by_role("heading")).to_have_text(title)
        expect(ring).to_be_in_viewport()
        until(flat, lambda: min(get_box(ring)["width"], get_box(ring)["height"]) > 20)


@pytest.mark.parametrize("kind", ["paper", "mass"])
def test_papers_load_is_drawn_as_torques_and_a_mass_as_a_mass(
    flat: Page, lab: Lab, kind: str
) -> None:
    """Also if no plot shows the disturbance."""
    flat.add_init_script("""localStorage.setItem("svsa.plots", '[{"preset": "error"}]')""")
    lab.client.post(lab.session + "/loads", json={"kind": kind}).raise_for_status()
    lab.jump(1)
    open_flat(flat, lab)
    picture = flat.get_by_role("img", name=PICTURE)
    expect(picture.locator("path[data-torque='disturbance_link_nm'][d^='M']")).to_be_attached()
    motor = picture.locator("path[data-torque='disturbance_motor2_nm'][d^='M']")
    expect(motor).to_have_count(1 if kind == "paper" else 0)
    expect(picture.locator(".schematic-load")).to_have_count(1 if kind == "mass" else 0)
