"""`python -m tests.bench.page [SECONDS] [PORT]`: does the open page's memory grow?

Two lanes, 60 s on screen, a load hung and taken off every ten seconds; the heap after a
collection, once a minute.
"""

import sys
import time

from playwright.sync_api import CDPSession, sync_playwright

from tests.browser.conftest import ARGUMENTS, find_chromium
from tests.lab import Lab, run_lab

LOAD_PERIOD_S = 10.0
SHOW_PERIOD_S = 60.0


def measure(devtools: CDPSession) -> tuple[float, int, int]:
    """Heap of the page and its 3D view after a collection, MB; nodes and listeners in them."""
    devtools.send("HeapProfiler.collectGarbage")
    metrics = {m["name"]: m["value"] for m in devtools.send("Performance.getMetrics")["metrics"]}
    return metrics["JSHeapUsedSize"] / 1e6, metrics["Nodes"], metrics["JSEventListeners"]


def swing_load(lab: Lab) -> None:
    """Hang the paper's load, or take it off."""
    loads = [load for load in lab.read()["loads"] if load["active"]]
    if loads:
        lab.client.delete(f"{lab.session}/loads/{loads[0]['id']}").raise_for_status()
    else:
        lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()


def main() -> None:
    """Print the memory once a minute, and how much it grew after the first two."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 600.0
    port = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    found: list[tuple[float, int, int]] = []
    with run_lab(port=port) as lab, sync_playwright() as playwright:
        lab.client.put(lab.session + "/lanes", json={"rivals": [{"law": "fl"}]}).raise_for_status()
        browser = playwright.chromium.launch(executable_path=find_chromium(), args=ARGUMENTS)
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        page.add_init_script("localStorage.setItem('svsa.window_s', '60')")
        page.goto(lab.url)
        devtools = page.context.new_cdp_session(page)
        devtools.send("Performance.enable")
        begin = time.monotonic()
        while (lapse := time.monotonic() - begin) < seconds:
            page.wait_for_timeout(LOAD_PERIOD_S * 1000)
            swing_load(lab)
            if lapse >= SHOW_PERIOD_S * len(found):
                found.append(measure(devtools))
                heap, nodes, listeners = found[-1]
                words = f"{nodes} nodes, {listeners} listeners"
                print(f"{lapse:5.0f} s {heap:6.1f} MB, {words}", flush=True)
        settled = found[min(2, len(found) - 1)]
        print(f"after 2 minutes, heap {found[-1][0] - settled[0]:+.1f} MB to the end")
        browser.close()


if __name__ == "__main__":
    main()
