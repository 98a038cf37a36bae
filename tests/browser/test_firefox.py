"""The lab in Firefox: layout, plots and the actuator, with WebGL and without.

Skipped where there is no Firefox, or for WebGL no Xvfb; `SVSA_MUST_FIREFOX=1` fails instead.
"""

import math
from collections.abc import Iterator

import pytest

from tests.browser.conftest import RETURNING
from tests.browser.firefox import Firefox, find_firefox, run_display, run_firefox
from tests.browser.measured_layout import FIND_PROBLEMS
from tests.browser.test_without_webgl import (
    ANGLES_2D,
    ANGLES_3D,
    LARGEST_DIFFERENCE_DEG,
    NOTE,
    PARTS,
    SAMPLE_S,
)
from tests.browser.visited_layout import LEAST_PLOT_PX, SIZES
from tests.lab import Lab
from tests.waiting import wait_until

pytestmark = pytest.mark.browser

HAS_SAMPLES = """window.svsa?.channels().includes("position_rad") &&
    window.svsa.series("position_rad").time.at(-1) > """
SAMPLED = """[["position_rad", 1], ["position_reference_rad", 1], ["position_rad", 2]]
    .map(([channel, lane]) => window.svsa.series(channel, lane).value.at(-1))"""
# Pixels of curves in the plot with the fewest: only curves have a color, grid and text are grey.
LEAST_DRAWN = """Math.min(...[...document.querySelectorAll(".plot canvas")].map((canvas) => {
    const { width, height } = canvas;
    const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
    let colored = 0;
    for (let i = 0; i < data.length; i += 4) {
        const one = data.subarray(i, i + 3);
        if (data[i + 3] > 200 && Math.max(...one) - Math.min(...one) > 60) colored++;
    }
    return colored;
}))"""
VIEW_IS_DRAWN = """(() => {
    const frame = document.querySelector(".view iframe");
    return !!frame?.contentWindow?.__viserMutable?.nodeRefFromName?.["/a/r0"];
})()"""
PRESS_FRONT = """document.querySelector(".view button[aria-label='Camera: Front']")?.click()"""
CAMERA_X = 'document.querySelector(".view iframe").contentWindow.__viserMutable.camera.position'


@pytest.fixture(scope="module")
def firefox() -> Iterator[Firefox]:
    """With WebGL in software."""
    path = find_firefox()
    with run_display() as display, run_firefox(path, display) as one:
        yield one


@pytest.fixture(scope="module")
def flat_firefox() -> Iterator[Firefox]:
    with run_firefox(find_firefox(), webgl_disabled=True) as one:
        yield one


def open_lab(firefox: Firefox, lab: Lab) -> None:
    """With all controls; the paper's load has acted on NDOBC and FL for 3 s."""
    comparisons = {"comparisons": [{"law": "fl"}]}
    lab.client.put(lab.session + "/lanes", json=comparisons).raise_for_status()
    lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
    newest_s = lab.jump(3)["time_s"] - SAMPLE_S
    firefox.open(lab.url + "/icon.svg")
    firefox.evaluate(f"(() => {{ {RETURNING} }})()")
    firefox.resize(1440, 900)
    firefox.open(lab.url)
    firefox.wait_for(f"{HAS_SAMPLES}{newest_s}")


def read_sampled(firefox: Firefox) -> dict[str, float]:
    return dict(zip(PARTS, map(math.degrees, firefox.evaluate(SAMPLED)), strict=True))


def test_layout_and_plots_are_complete_and_3d_has_the_poses(firefox: Firefox, lab: Lab) -> None:
    open_lab(firefox, lab)
    firefox.wait_for(VIEW_IS_DRAWN)
    firefox.evaluate(PRESS_FRONT)
    firefox.wait_for(f"Math.abs({CAMERA_X}.z) > 8")
    sampled = read_sampled(firefox)
    # Poses and camera reach the scene one after the other.
    firefox.wait_for(
        f"""Object.entries(({ANGLES_3D})({PARTS!r}))
            .every(([name, angle]) => Math.abs(angle - ({sampled!r})[name]) < 1)"""
    )
    assert_complete(firefox)


def test_missing_webgl_is_stated_and_the_poses_are_drawn_in_2d(
    flat_firefox: Firefox, lab: Lab
) -> None:
    firefox = flat_firefox
    open_lab(firefox, lab)
    firefox.wait_for("document.querySelector('.schematic svg')")
    assert NOTE in firefox.evaluate("document.querySelector('.view').innerText")
    assert firefox.evaluate("document.querySelectorAll('.view iframe').length") == 0
    sampled = read_sampled(firefox)
    assert abs(sampled["q of FL"] - sampled["q"]) > 5
    expected = pytest.approx(sampled, abs=LARGEST_DIFFERENCE_DEG)
    wait_until(lambda: firefox.evaluate(f"({ANGLES_2D})()") == expected)
    assert_complete(firefox)


def assert_complete(firefox: Firefox) -> None:
    """The layout has no problem at any size, and every plot has curves."""
    firefox.wait_for(f"{LEAST_DRAWN} > 100")
    for size in SIZES:
        wait_for_layout(firefox, *size)


def wait_for_layout(firefox: Firefox, width: int, height: int) -> None:
    """Wait until the layout has no problem: it settles after a change of the size."""
    firefox.resize(width, height)
    firefox.wait_for(f"innerWidth === {width} && innerHeight === {height}")
    problems: list[str] = []

    def is_complete() -> bool:
        problems[:] = firefox.evaluate(f"({FIND_PROBLEMS})({LEAST_PLOT_PX['simulation']})")
        return problems == []

    wait_until(is_complete, lambda: "\n".join([f"{width} × {height}:", *problems]))
