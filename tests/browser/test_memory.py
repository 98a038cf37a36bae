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
from tests.browser.test_page import open_page, wait_for_samples
from tests.exhaustive import exhaust
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("without_3d", "still")]

BEGINNING_S = 60.0


@pytest.mark.parametrize("minutes", exhaust([2, 10], [2]))
def test_minutes_leave_nothing_behind(page: Page, lab: Lab, minutes: int) -> None:
    """The held window may fill; a new run empties it, and then all is as at the beginning.

    Stepped second by second: as many loads come and go whatever else the machine does.
    """
    prepare_lab(lab, page)
    open_page(page, lab)
    devtools = watch_heap(page)

    def pass_time(until_s: float) -> Heap:
        lab.client.post(lab.session + "/reset").raise_for_status()
        for period in range(1, round(until_s / LOAD_PERIOD_S) + 1):
            swing_load(lab)
            lab.jump(LOAD_PERIOD_S)
            end = period * LOAD_PERIOD_S
            wait_for_samples(page, end - 0.1, end)
        return measure_heap(devtools)

    pass_time(BEGINNING_S)
    before = pass_time(BEGINNING_S)
    pass_time(60.0 * minutes)
    after = pass_time(BEGINNING_S)
    assert after.size_mb < before.size_mb + 1.0
    assert after.nodes < 1.05 * before.nodes
    assert after.listeners < 1.05 * before.listeners
