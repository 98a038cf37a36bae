"""Minutes of a session go past an open page, and leave nothing in it."""

import pytest
from playwright.sync_api import Page

from tests.browser.heap import (
    LOAD_PERIOD_S,
    Heap,
    measure_heap,
    prepare_lab,
    swing_load,
    watch_heap,
)
from tests.browser.test_page import open_page
from tests.exhaustive import exhaust
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("without_3d")]

SPEED = 20
BEGINNING_S = 60.0


@pytest.mark.parametrize("minutes", exhaust([2, 10], [2]))
def test_minutes_leave_nothing_behind(page: Page, lab: Lab, minutes: int) -> None:
    """The held window may fill; a new run empties it, and then all is as at the beginning."""
    prepare_lab(lab, page)
    open_page(page, lab)
    devtools = watch_heap(page)
    lab.client.put(lab.session + "/speed", json={"factor": SPEED}).raise_for_status()

    def pass_time(until_s: float) -> Heap:
        lab.client.post(lab.session + "/reset").raise_for_status()
        lab.client.post(lab.session + "/start").raise_for_status()
        while lab.read()["time_s"] < until_s:
            swing_load(lab)
            page.wait_for_timeout(1000 * LOAD_PERIOD_S / SPEED)
        return measure_heap(devtools)

    pass_time(BEGINNING_S)
    before = pass_time(BEGINNING_S)
    pass_time(60.0 * minutes)
    after = pass_time(BEGINNING_S)
    assert after.size_mb < before.size_mb + 1.0
    assert after.nodes < 1.05 * before.nodes
    assert after.listeners < 1.05 * before.listeners
