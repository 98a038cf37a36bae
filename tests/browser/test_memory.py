"""Minutes of a session do not increase the memory of an open page."""

from itertools import pairwise

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
def test_memory_is_constant_over_minutes(page: Page, lab: Lab, minutes: int) -> None:
    """The stored window may fill; a new run empties it, and the memory is as at the start.

    A leak grows in both halves of the time; what the page allocates once grows in one. The run is
    stepped second by second: the number of loads does not depend on how busy the machine is.
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
    heaps = [pass_time(BEGINNING_S)]
    for _ in range(2):
        pass_time(30.0 * minutes)
        heaps.append(pass_time(BEGINNING_S))
    for values in zip(*heaps, strict=True):
        assert min(after / before for before, after in pairwise(values)) < 1.05, heaps
