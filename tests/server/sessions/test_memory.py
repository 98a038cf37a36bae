"""Resident memory of private sessions in a real server: while they run, and after they have ended.

The history of one lane is 8.92 MB (32,768 ticks, 34 channels of 8 bytes); 0.40 MB are left for the
rest of a session, which needs about 0.1 MB.
"""

import pytest

from tests.benchmarks.attacks import read_memory_mb
from tests.benchmarks.memory import end_sessions, open_sessions
from tests.lab import run_lab
from tests.waiting import wait_until

SESSIONS = 48
HISTORY_MB = 8.92
LARGEST_SESSION_MB = 9.32
KEPT_MB = 16.0
"""Bound of what 48 ended sessions leave, MB: free lists of the allocator, two sessions' worth."""


@pytest.mark.exhaustive
def test_session_with_one_lane_costs_9_mb_which_return_when_it_ends():
    """Costs that occur once, such as imports, belong to the first session, which is not counted.

    A session is released a few ms after the answer to its end.
    """
    with run_lab(max_sessions=str(SESSIONS)) as lab:
        lab.client.post(lab.session + "/pause").raise_for_status()
        first = open_sessions(lab, 1)
        with_first_mb = read_memory_mb(lab)
        end_sessions(lab, first)
        wait_until(lambda: with_first_mb - read_memory_mb(lab) > 0.9 * HISTORY_MB)
        before_mb = read_memory_mb(lab)
        for _ in range(2):
            paths = open_sessions(lab, SESSIONS)
            assert read_memory_mb(lab) - before_mb < SESSIONS * LARGEST_SESSION_MB
            end_sessions(lab, paths)
            wait_until(lambda: read_memory_mb(lab) - before_mb < KEPT_MB, longest_s=30.0)
