"""How much memory a page holds while loads come and go."""

from typing import NamedTuple

from playwright.sync_api import CDPSession, Page

from tests.lab import Lab

LOAD_PERIOD_S = 10.0


class Heap(NamedTuple):
    """What a page and the frames in it hold after a collection: MB, and counts."""

    size_mb: float
    nodes: int
    listeners: int


def watch_heap(page: Page) -> CDPSession:
    """Chromium's own measurements of this page."""
    devtools = page.context.new_cdp_session(page)
    devtools.send("Performance.enable")
    return devtools


def measure_heap(devtools: CDPSession) -> Heap:
    """What is held now: collections go on until none frees more than a hundredth of it.

    What one collection finalizes is freed by the next.
    """
    held = _collect(devtools)
    while (left := _collect(devtools)).size_mb < 0.99 * held.size_mb:
        held = left
    return left


def _collect(devtools: CDPSession) -> Heap:
    devtools.send("HeapProfiler.collectGarbage")
    metrics = {m["name"]: m["value"] for m in devtools.send("Performance.getMetrics")["metrics"]}
    size_mb = metrics["JSHeapUsedSize"] / 1e6
    return Heap(size_mb, metrics["Nodes"], metrics["JSEventListeners"])


def prepare_lab(lab: Lab, page: Page) -> None:
    """Two lanes, and 60 s on screen."""
    lab.client.put(lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]}).raise_for_status()
    page.add_init_script("localStorage.setItem('svsa.window_s', '60')")


def swing_load(lab: Lab) -> None:
    """Hang the paper's load, or take it off."""
    loads = [load for load in lab.read()["loads"] if load["active"]]
    if loads:
        lab.client.delete(f"{lab.session}/loads/{loads[0]['id']}").raise_for_status()
    else:
        lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
