"""A lab with two runs."""

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Page

from tests.browser.runs.recorded import BOTH, STIFF, record
from tests.lab import Lab
from tests.waiting import follow_recording


@pytest.fixture(scope="module")
def lab(lab_without_runs: Lab) -> Lab:
    """The shared lab with only the runs of the module."""
    return lab_without_runs


@pytest.fixture(scope="module")
def recorded(lab: Lab) -> tuple[str, str]:
    """Two runs, the older first."""
    pair = (
        record(lab, BOTH, "4a", ["fl"], ["class"]),
        record(lab, STIFF, "4b", [], []),
    )
    for run in pair:
        assert follow_recording(lab.client, f"/api/v1/runs/{run}")["state"] == "complete"
    return pair


@pytest.fixture
def runs(lab: Lab, recorded: tuple[str, str]) -> Iterator[tuple[str, str]]:
    """Both runs, which are restored afterwards."""
    yield recorded
    for run, name, tags in zip(recorded, (BOTH, STIFF), (["class"], []), strict=True):
        path = f"/api/v1/runs/{run}"
        if lab.client.get(path).json()["deleted"] is not None:
            lab.client.patch(path, json={"deleted": False}).raise_for_status()
        wanted = {"name": name, "tags": tags, "notes": ""}
        lab.client.patch(path, json=wanted).raise_for_status()


@pytest.fixture
def without_replay(page: Page) -> None:
    """The frame of a replay stays empty, for tests that do not need its 3D view."""
    empty = {"body": "<p>No replay</p>", "content_type": "text/html"}
    page.route(re.compile(r"/replay(\?|$)"), lambda route: route.fulfill(**empty))
