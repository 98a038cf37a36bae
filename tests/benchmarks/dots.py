"""`python -m tests.benchmarks.dots [ROWS]`: how soon the page Studies has painted a brush of many
dots.

Both planes, the distributions and the table follow each brush. Software rendering, 1440 × 900.
"""

import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

from playwright.sync_api import Locator, Page, expect, sync_playwright

from svsa.evaluation.studies.execution import run_study
from svsa.evaluation.studies.store import keep_study
from tests.browser.conftest import ARGUMENTS, find_chromium
from tests.browser.settled import get_box
from tests.evaluation.studies.studies import build_study
from tests.lab import run_lab

ROWS, BRUSHES, WAIT_MS = 100_000, 20, 600_000
VIEWPORT = {"width": 1440, "height": 900}

# From the end of each drag to the second frame after it, ms.
TIME_BRUSHES = """() => {
    window.brushed = [];
    addEventListener("mouseup", () => {
        const begun = performance.now();
        const reported = () => window.brushed.push(performance.now() - begun);
        requestAnimationFrame(() => requestAnimationFrame(reported));
    }, { capture: true });
}"""


def drag(page: Page, plane: Locator, number: int) -> None:
    """Draw the selection again, each time from another corner."""
    box = get_box(plane.get_by_role("application"))
    share = 0.2 + 0.4 * number / BRUSHES
    page.mouse.move(box["x"] + share * box["width"], box["y"] + 0.3 * box["height"])
    page.mouse.down()
    page.mouse.move(box["x"] + 0.9 * box["width"], box["y"] + 0.8 * box["height"], steps=4)
    page.mouse.up()
    page.wait_for_function("number => window.brushed.length === number", arg=number + 1)


def main() -> None:
    """Print when the page was complete, and the times of the selections."""
    rows = int(sys.argv[1]) if len(sys.argv) > 1 else ROWS
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        kept = keep_study("dots", build_study(runs=rows // 2), Path(folder) / "studies")
        assert run_study(kept, workers=2)
        browser = playwright.chromium.launch(executable_path=find_chromium(), args=ARGUMENTS)
        with run_lab(data=folder) as lab:
            page = browser.new_page(viewport=VIEWPORT)
            begin = time.monotonic()
            page.goto(lab.url + "/?studies=dots")
            plane = page.get_by_role("region", name="First plane")
            expect(plane.get_by_role("application")).to_be_visible(timeout=WAIT_MS)
            shown_s = time.monotonic() - begin
            page.evaluate(TIME_BRUSHES)
            for number in range(BRUSHES):
                drag(page, plane, number)
            reported = page.get_by_text("runs in the brush").inner_text()
            times = page.evaluate("() => window.brushed")
        browser.close()
    load = f"load of the machine {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"
    print(f"{reported}; shown after {shown_s:.1f} s; {load}")
    middle, longest = statistics.median(times), max(times)
    print(f"a brush is painted after {middle:.0f} ms (median of {BRUSHES}; at most {longest:.0f})")


if __name__ == "__main__":
    main()
