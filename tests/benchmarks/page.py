"""`python -m tests.benchmarks.page [SECONDS] [PORT]`: does the open page's memory grow?

Two lanes, 60 s on screen, a load hung and taken off every ten seconds; the heap after a
collection, once a minute, in real time and with the 3D view.
"""

import sys
import time

from playwright.sync_api import sync_playwright

from tests.browser.conftest import ARGUMENTS, find_chromium
from tests.browser.heap import (
    LOAD_PERIOD_S,
    Heap,
    measure_heap,
    prepare_lab,
    swing_load,
    watch_heap,
)
from tests.lab import run_lab

SHOW_PERIOD_S = 60.0


def main() -> None:
    """Print the memory once a minute, and how much it grew after the first two."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 600.0
    port = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    found: list[Heap] = []
    with run_lab(port=port) as lab, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=find_chromium(), args=ARGUMENTS)
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        prepare_lab(lab, page)
        page.goto(lab.url)
        devtools = watch_heap(page)
        begin = time.monotonic()
        while (lapse := time.monotonic() - begin) < seconds:
            page.wait_for_timeout(LOAD_PERIOD_S * 1000)
            swing_load(lab)
            if lapse >= SHOW_PERIOD_S * len(found):
                found.append(measure_heap(devtools))
                heap = found[-1]
                words = f"{heap.nodes} nodes, {heap.listeners} listeners"
                print(f"{lapse:5.0f} s {heap.size_mb:6.1f} MB, {words}", flush=True)
        settled = found[min(2, len(found) - 1)]
        print(f"after 2 minutes, heap {found[-1].size_mb - settled.size_mb:+.1f} MB to the end")
        browser.close()


if __name__ == "__main__":
    main()
