"""An arm on the page: opened, loaded, pushed at the tip, compared, replayed."""

import re
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.conftest import ARGUMENTS
from tests.browser.settled import get_box, until
from tests.browser.test_accessibility import PHONE, TABLET, WIDE, expect_no_violation
from tests.browser.test_page import (
    choose,
    come_back,
    go_to_page,
    show_all_controls,
    wait_for_samples,
)
from tests.lab import Lab
from tests.waiting import follow_recording

PUSH = "Push the tip"
SETTLING_S = 3.0

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page")]


class Arm:
    """A private session of an arm."""

    def __init__(self, lab: Lab) -> None:
        self._lab = lab
        answer = lab.client.post("/api/v1/sessions", json={"from": "arm"})
        self.name = answer.raise_for_status().json()["session"]
        self.path = f"/api/v1/sessions/{self.name}"
        self.url = f"{lab.url}/?session={self.name}"

    def read(self) -> dict:
        return self._lab.client.get(self.path).raise_for_status().json()

    def put(self, path: str, value: dict) -> None:
        self._lab.client.put(self.path + path, json=value).raise_for_status()

    def post(self, path: str, value: dict | None = None) -> dict:
        return self._lab.client.post(self.path + path, json=value).raise_for_status().json()

    def hold_still(self) -> None:
        """Hold both joints, so that the tip stays at its place in the picture."""
        for joint, angle in ((1, 0.3), (2, 0.9)):
            value = {"kind": "constant", "position_rad": angle}
            self.put(f"/position?joint={joint}", value)

    def _list_active(self) -> list[dict]:
        return [one["load"] for one in self.read()["loads"] if one["active"]]

    def read_push(self) -> tuple[float, float]:
        """Force of the push at the tip, N; zero without a push."""
        pushes = [load for load in self._list_active() if load["kind"] == "tip_push"]
        x, y = pushes[-1]["force_n"] if pushes else (0.0, 0.0)
        return x, y

    def list_loads(self) -> list[str]:
        """The kinds of the loads that act."""
        return [load["kind"] for load in self._list_active()]


@pytest.fixture
def arm(still_lab: Lab) -> Arm:
    """An arm that runs; it ends with the test."""
    return Arm(still_lab)


def open_arm(page: Page, lab: Lab, arm: Arm) -> None:
    come_back(page, lab)
    page.goto(arm.url)
    wait_for_samples(page)
    show_all_controls(page)


def find_ellipse(page: Page) -> Locator:
    return page.locator("[data-ellipse]")


@pytest.mark.smoke
@pytest.mark.usefixtures("without_3d")
def test_arm_is_opened_with_an_actuator_in_each_joint(page: Page, still_lab: Lab) -> None:
    page.goto(still_lab.url)
    go_to_page(page, "Actuators")
    choose(page.get_by_role("radio", name="Planar arm"))
    page.wait_for_url(re.compile("actuators=arm"))
    card = page.get_by_role("region", name="Planar arm", exact=True)
    expect(card).to_contain_text("Two rods of 0.3 m and 0.3 kg")
    choose(card.get_by_role("radio", name="MACCEPA"))
    expect(card.get_by_label("Actuator of joint 1")).to_have_value("maccepa")
    choose(card.get_by_role("radio", name="Two rods"))
    expect(card.get_by_label("Actuator of joint 2")).to_have_value("svsa")
    card.get_by_role("button", name="Open arm").click()
    page.wait_for_url(re.compile(r"\?session="))
    expect(page.get_by_text("Private session: Planar arm.")).to_be_visible()
    for joint in (1, 2):
        plot = page.locator(f"[data-plot='position.{joint}']")
        expect(plot.get_by_role("heading")).to_contain_text(f"Joint {joint}: Position")
    expect(page.get_by_role("button", name=re.compile(PUSH))).to_be_visible()
    expect(page.get_by_role("button", name=re.compile("Hang 0.1 kg"))).to_be_enabled()
    expect(page.get_by_role("alert").filter(visible=True)).to_have_count(0)


@pytest.mark.usefixtures("without_3d")
def test_tip_carries_a_mass_and_is_pushed_by_mouse_and_keys(
    page: Page, still_lab: Lab, arm: Arm
) -> None:
    arm.hold_still()
    open_arm(page, still_lab, arm)
    page.get_by_role("button", name=re.compile("Hang 0.1 kg")).click()
    expect(page.get_by_role("button", name=re.compile("Remove 0.1 kg"))).to_be_visible()
    assert arm.list_loads() == ["tip_mass"]
    wait_for_samples(page, arm.read()["time_s"] + SETTLING_S)
    expect(page.locator("[data-mass]")).to_be_visible()
    tip = page.get_by_role("button", name=re.compile(PUSH))
    box = get_box(tip)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y - 40, steps=3)
    until(page, lambda: arm.read_push()[0] > 1.0)
    expect(page.locator(".tip-plane-hint")).to_have_text(re.compile(r"\d N$"))
    page.mouse.up()
    until(page, lambda: arm.list_loads() == ["tip_mass"])
    tip.focus()
    page.keyboard.down("ArrowUp")
    until(page, lambda: is_upward(*arm.read_push()))
    page.keyboard.up("ArrowUp")
    until(page, lambda: arm.list_loads() == ["tip_mass"])
    assert arm.read()["fault"] is None


def is_upward(x: float, y: float) -> bool:
    return x == 0.0 < y


@pytest.mark.usefixtures("without_3d")
def test_two_controllers_are_compared_on_the_same_load(
    page: Page, still_lab: Lab, arm: Arm
) -> None:
    open_arm(page, still_lab, arm)
    page.get_by_role("switch", name="Compare with FL").press("Enter")
    table = page.locator("table.comparison")
    for name in ("Joint 1 NDOBC", "Joint 2 NDOBC", "Joint 1 FL", "Joint 2 FL"):
        expect(table).to_contain_text(name)
    page.get_by_role("button", name=re.compile("Hang 0.1 kg")).click()
    for joint in (1, 2):
        legend = page.locator(f"[data-plot='error.{joint}']")
        expect(legend).to_contain_text("NDOBC")
        expect(legend).to_contain_text("FL")
        expect(legend).not_to_contain_text("Joint 1 FL")
    expect(page.locator("[data-links]")).to_have_count(2)
    assert [lane["joint"] for lane in arm.read()["lanes"]] == [1, 2, 1, 2]
    page.reload()
    wait_for_samples(page)
    expect(page.locator("[data-links]")).to_have_count(2)
    expect(page.get_by_role("button", name=re.compile("Remove 0.1 kg"))).to_be_visible()


@pytest.mark.usefixtures("without_3d")
def test_settings_of_a_joint_change_that_joint_and_the_ellipse(
    page: Page, still_lab: Lab, arm: Arm
) -> None:
    """Held still, so that the ellipse depends on the stiffness alone."""
    arm.hold_still()
    open_arm(page, still_lab, arm)
    wait_for_samples(page, 3.0)
    before = [float(find_ellipse(page).get_attribute(axis) or 0) for axis in ("rx", "ry")]
    controls = page.get_by_role("region", name="Controls")
    choose(controls.get_by_role("radio", name="Joint 2"))
    expect(page.locator("[data-plot='position.1']")).to_have_count(0)
    expect(page.locator("[data-plot='position.2']")).to_be_visible()
    field = controls.get_by_role("spinbutton", name="Stiffness", exact=True)
    field.fill("30")
    field.press("Enter")
    until(page, lambda: read_stiffness(arm) == (80.0, 30.0))
    until(
        page,
        lambda: float(find_ellipse(page).get_attribute("rx") or 0) < 0.9 * before[0],
    )
    choose(controls.get_by_role("radio", name="All", exact=True))
    expect(controls.get_by_text("The joints differ").first).to_be_visible()
    undo = controls.get_by_role("button", name="Undo, 1 step kept").first
    undo.click()
    until(page, lambda: read_stiffness(arm) == (80.0, 80.0))
    expect(controls.get_by_role("button", name="Undo", exact=True).first).to_be_disabled()


def read_stiffness(arm: Arm) -> tuple[float, float]:
    configuration = arm.read()["configuration"]
    first, second = configuration["stiffness"], configuration["arm"]["other_joints"][0]["stiffness"]
    return first["stiffness_nm_per_rad"], second["stiffness_nm_per_rad"]


@pytest.mark.usefixtures("without_3d")
def test_feedforward_estimate_wall_and_path_are_switched_on_the_page(
    page: Page, still_lab: Lab, arm: Arm
) -> None:
    open_arm(page, still_lab, arm)
    wait_for_samples(page, 4.0)
    choose(page.get_by_role("checkbox", name="Arm feedforward"))
    until(page, lambda: arm.read()["configuration"]["arm"]["feedforward"])
    choose(page.get_by_role("checkbox", name="Estimate the tip mass"))
    expect(page.locator(".arm-estimate")).to_contain_text(re.compile(r"Estimated mass\s+-?−?\d"))
    # Paused: the estimate would take contact for mass, and the arm reach a limit within seconds.
    arm.post("/pause")
    wall = page.get_by_role("checkbox", name="Wall")
    choose(wall)
    expect(page.locator(".tip-wall")).to_be_visible()
    assert arm.list_loads() == ["wall"]
    wall.press("Space")
    expect(page.locator(".tip-wall")).to_have_count(0)
    arm.post("/start")
    setup = arm.read()["configuration"]["arm"]
    assert setup["feedforward"]
    assert setup["adaptation"] is not None
    ellipse, motion = (
        page.get_by_role("radio", name="Tip ellipse"),
        page.get_by_role("heading", name="Motion"),
    )
    choose(ellipse)
    expect(motion).to_have_count(0)
    assert arm.read()["configuration"]["arm"]["tip"] is not None
    page.get_by_role("button", name=re.compile("^Undo, ")).first.click()
    expect(motion).to_be_visible()
    expect(ellipse).not_to_be_checked()
    assert arm.read()["configuration"]["arm"]["tip"] is None
    choose(ellipse)
    expect(motion).to_have_count(0)
    assert arm.read()["configuration"]["arm"]["tip"] is not None
    wait_for_samples(page, 0.5)
    assert arm.read()["fault"] is None


def test_3d_view_shows_both_joints_the_mass_and_the_comparison(
    page: Page, still_lab: Lab, arm: Arm
) -> None:
    arm.put("/lanes", {"comparisons": [{"law": "fl"}]})
    arm.post("/loads", {"kind": "tip_mass", "mass_kg": 0.1})
    open_arm(page, still_lab, arm)
    page.wait_for_function(
        """() => {
            const { __viserMutable: viser, __viserSceneTree: tree } =
                document.querySelector(".view iframe")?.contentWindow ?? {};
            const nodes = tree?.getState();
            const isSeen = (name) => nodes[name]?.effectiveVisibility ?? false;
            return viser?.camera && nodes && viser.nodeRefFromName["/a/l/2/l"]
                && ["/a/w", "/a/r", "/a/k"].every(isSeen);
        }"""
    )
    expect(page.get_by_role("button", name="Camera: Above")).to_be_visible()
    expect(page.get_by_role("button", name="Push", exact=True)).to_have_count(0)


@pytest.mark.usefixtures("without_3d")
def test_recorded_arm_is_listed_and_replayed_with_plots_of_both_joints(
    page: Page, still_lab: Lab, arm: Arm
) -> None:
    client = still_lab.client
    arm.post("/pause")
    arm.post("/recording", {"name": ""})
    for _ in range(2):
        arm.post("/step", {"ticks": 1000})
    run = arm.read()["recording"]["run_id"]
    client.delete(arm.path + "/recording").raise_for_status()
    follow_recording(client, f"/api/v1/runs/{run}")
    come_back(page, still_lab)
    page.goto(f"{still_lab.url}/?runs=all")
    row = page.get_by_role("row").filter(has=page.locator(f"a[href*='{run}']"))
    expect(row).to_contain_text("Arm")
    page.goto(f"{still_lab.url}/?run={run}")
    replay = page.frame_locator("iframe")
    for joint in (1, 2):
        expect(replay.locator(f"[data-plot='position.{joint}'] h3")).to_contain_text(
            f"Joint {joint}: Position"
        )


@pytest.mark.exhaustive
@pytest.mark.usefixtures("without_3d")
def test_page_of_an_arm_has_no_accessibility_violation(
    page: Page, still_lab: Lab, arm: Arm
) -> None:
    arm.post("/pause")
    arm.post("/step", {"ticks": 1000})
    arm.put("/lanes", {"comparisons": [{"law": "fl"}]})
    for _ in range(8):
        arm.post("/step", {"ticks": 1000})
    arm.post("/loads", {"kind": "tip_mass", "mass_kg": 0.1})
    arm.post("/step", {"ticks": 1000})
    open_arm(page, still_lab, arm)
    expect_no_violation(page, WIDE, TABLET, PHONE)


@pytest.mark.exhaustive
@pytest.mark.usefixtures("without_3d")
def test_basic_view_of_an_arm_has_less_than_thirty_controls(
    page: Page, still_lab: Lab, arm: Arm
) -> None:
    page.goto(still_lab.url + "/icon.svg")
    page.evaluate("localStorage.setItem('svsa.tour', 'done')")
    page.goto(arm.url)
    wait_for_samples(page)
    expect(page.get_by_role("button", name=re.compile(PUSH))).to_be_visible()
    controls = page.locator("button, input, select, a[href], summary, [role=button]")
    visible = controls.filter(visible=True).count()
    assert 10 < visible < 50
    settings = page.locator(".lab").locator("button, input, select, [role=button]")
    assert settings.filter(visible=True).count() < 30


@pytest.fixture(scope="module")
def flat_browser(launch_browser: Callable[..., Browser]) -> Iterator[Browser]:
    """A Chromium without WebGL."""
    browser = launch_browser(args=[*ARGUMENTS, "--disable-3d-apis"])
    yield browser
    browser.close()


def test_picture_of_the_plane_replaces_the_3d_view_without_webgl(
    flat_browser: Browser, browser_context_args: dict, still_lab: Lab, arm: Arm
) -> None:
    context = flat_browser.new_context(**browser_context_args)
    page = context.new_page()
    open_arm(page, still_lab, arm)
    expect(page.get_by_text("This browser has no WebGL")).to_be_visible()
    expect(page.locator(".view iframe")).to_have_count(0)
    expect(page.get_by_role("button", name=re.compile(PUSH))).to_be_visible()
    links = page.locator("[data-links='0']")
    expect(links).to_have_attribute("d", re.compile(r"^M0 0L-?[\d.]+ -?[\d.]+L-?[\d.]+ -?[\d.]+$"))
    context.close()
