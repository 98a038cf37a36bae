"""Recording of the runs of these tests, and their places on the page."""

import re

from playwright.sync_api import FrameLocator, Locator, Page, Response, expect

from tests.lab import Lab

SECONDS = 7
BOTH, STIFF = "Both laws at 15 N·m/rad", "Stiff and alone"


def record(lab: Lab, name: str, figure: str, comparisons: list[str], tags: list[str]) -> str:
    """Record a figure of the paper with its load at 5 s, from t = 0."""
    lab.load_figure(figure, load=True)
    lab.client.post(lab.session + "/pause").raise_for_status()
    lab.client.post(lab.session + "/reset").raise_for_status()
    lanes = {"comparisons": [{"law": law} for law in comparisons]}
    lab.client.put(lab.session + "/lanes", json=lanes).raise_for_status()
    wanted = {"name": name, "tags": tags, "notes": ""}
    answer = lab.client.post(lab.session + "/recording", json=wanted).raise_for_status().json()
    lab.jump(SECONDS)
    lab.client.delete(lab.session + "/recording").raise_for_status()
    return answer["recording"]["run_id"]


def open_list(page: Page, lab: Lab) -> None:
    page.goto(lab.url + "/?runs=all")
    expect(page.get_by_role("heading", name=re.compile("^Runs"))).to_be_visible()


def find_names(page: Page) -> Locator:
    """Return the names of the runs in the table, from the top."""
    return page.get_by_role("table", name="Recorded runs").locator(".run-title > :first-child")


def find_replay(page: Page) -> FrameLocator:
    return page.frame_locator("iframe[title^='Replay of']")


def is_change(answer: Response) -> bool:
    """Whether this answers a change of a run."""
    return answer.request.method == "PATCH"
