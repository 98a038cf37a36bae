"""`python -m tests.benchmarks.plots [SECONDS] [PORT]`: how often each plot is drawn beside the 3D
view.

Four lanes, 60 s on screen, every plot of the page in view, software rendering, 1 kHz.
"""

import json
import os
import sys

from playwright.sync_api import Browser, Page, sync_playwright

from tests.browser.conftest import ARGUMENTS, find_chromium
from tests.lab import Lab, run_lab

WINDOW_S = 60
LANES = [{"law": law} for law in ("fl", "ndobc", "fl")]
EVERY_PLOT = [
    "position",
    "error",
    "stiffness",
    "stiffnessError",
    "torque",
    "disturbance",
    "deflection",
    "phase",
]
VIEWPORT = {"width": 1280, "height": 1080}

# Counts how often each canvas is cleared, which every drawing begins with, and the frames.
COUNT = """([plots, seconds]) => {
    localStorage.setItem("svsa.plots", plots);
    localStorage.setItem("svsa.window_s", String(seconds));
    if (window !== window.top) return;
    const counts = new Map();
    const clear = CanvasRenderingContext2D.prototype.clearRect;
    CanvasRenderingContext2D.prototype.clearRect = function (...place) {
        const plot = this.canvas.closest(".plot")?.getAttribute("aria-label");
        if (plot) counts.set(plot, (counts.get(plot) ?? 0) + 1);
        return clear.apply(this, place);
    };
    let frames = 0;
    const tick = () => { frames++; requestAnimationFrame(tick); };
    requestAnimationFrame(tick);
    window.drawn = () => ({ frames, ...Object.fromEntries(counts) });
}"""
HIDE_VIEW = "() => document.querySelector('.view iframe')?.remove()"
HELD_S = """() => {
    const { time } = window.svsa.series("position_error_rad");
    return time.length ? time.at(-1) - time[0] : 0;
}"""


def measure(page: Page, seconds: float) -> dict[str, float]:
    """Frames and drawings a second, by the name of the plot."""
    before = page.evaluate("() => [performance.now(), window.drawn()]")
    page.wait_for_timeout(seconds * 1000)
    after = page.evaluate("() => [performance.now(), window.drawn()]")
    lapse = (after[0] - before[0]) / 1000
    return {name: (count - before[1].get(name, 0)) / lapse for name, count in after[1].items()}


def open_page(browser: Browser, lab: Lab) -> Page:
    """The page with 60 s of samples of every lane."""
    page = browser.new_page(viewport=VIEWPORT)
    plots = json.dumps([{"preset": preset} for preset in EVERY_PLOT])
    page.add_init_script(f"({COUNT})({json.dumps([plots, WINDOW_S])})")
    page.goto(lab.url)
    for _ in range(10 * WINDOW_S):
        page.wait_for_timeout(500)
        if page.evaluate(HELD_S) > WINDOW_S - 1:
            return page
    raise AssertionError(f"{WINDOW_S} s of samples did not come")


def show(title: str, rates: dict[str, float]) -> None:
    """One line for the frames and one a plot."""
    plots = {name: rate for name, rate in rates.items() if name != "frames"}
    load = f"load of the machine {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"
    print(
        f"{title}: {rates['frames']:.1f} frames/s, slowest plot {min(plots.values()):.1f}/s, {load}"
    )
    for name, rate in plots.items():
        print(f"  {name:24} {rate:5.1f} draws/s")


def main() -> None:
    """Print the rates with the 3D view running, and without it."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0
    port = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    with run_lab(port=port) as lab, sync_playwright() as playwright:
        lab.client.put(lab.session + "/lanes", json={"comparisons": LANES}).raise_for_status()
        browser = playwright.chromium.launch(executable_path=find_chromium(), args=ARGUMENTS)
        page = open_page(browser, lab)
        show("With the 3D view", measure(page, seconds))
        page.evaluate(HIDE_VIEW)
        page.wait_for_timeout(2000)
        show("Without it", measure(page, seconds))
        browser.close()


if __name__ == "__main__":
    main()
