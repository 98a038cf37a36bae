"""Memory of a page while loads are added and removed."""

import json
from typing import Any, NamedTuple

from playwright.sync_api import CDPSession, Page

from tests.lab import Lab

LOAD_PERIOD_S = 10.0


class Heap(NamedTuple):
    """Objects of a page and its frames after a garbage collection: MB, and counts.

    The size leaves out machine code: V8 compiles further functions while a page is used, and drops
    them only under memory pressure.
    """

    size_mb: float
    nodes: int
    listeners: int


def watch_heap(page: Page) -> CDPSession:
    """Chromium's own measurements of this page."""
    devtools = page.context.new_cdp_session(page)
    devtools.send("Performance.enable")
    return devtools


def measure_heap(devtools: CDPSession) -> Heap:
    """Count the objects of a heap snapshot; Chromium collects garbage before it takes one."""
    chunks: list[str] = []

    def add(event: dict[str, str]) -> None:
        chunks.append(event["chunk"])

    devtools.on("HeapProfiler.addHeapSnapshotChunk", add)
    devtools.send("HeapProfiler.takeHeapSnapshot", {"reportProgress": False})
    devtools.remove_listener("HeapProfiler.addHeapSnapshotChunk", add)
    metrics = {m["name"]: m["value"] for m in devtools.send("Performance.getMetrics")["metrics"]}
    size_mb = _sum_objects(json.loads("".join(chunks))) / 1e6
    return Heap(size_mb, metrics["Nodes"], metrics["JSEventListeners"])


def _sum_objects(snapshot: dict[str, Any]) -> int:
    """Sum the sizes of the nodes of a heap snapshot that are not machine code: bytes."""
    meta, nodes = snapshot["snapshot"]["meta"], snapshot["nodes"]
    fields = meta["node_fields"]
    types = nodes[fields.index("type") :: len(fields)]
    sizes = nodes[fields.index("self_size") :: len(fields)]
    code = meta["node_types"][fields.index("type")].index("code")
    return sum(size for kind, size in zip(types, sizes, strict=True) if kind != code)


def prepare_lab(lab: Lab, page: Page) -> None:
    """Two lanes, and 60 s on screen."""
    lab.client.put(lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]}).raise_for_status()
    page.add_init_script("localStorage.setItem('svsa.window_s', '60')")


def swing_load(lab: Lab) -> None:
    """Add or remove the paper's load."""
    loads = [load for load in lab.read()["loads"] if load["active"]]
    if loads:
        lab.client.delete(f"{lab.session}/loads/{loads[0]['id']}").raise_for_status()
    else:
        lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
