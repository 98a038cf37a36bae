"""Resident memory of private sessions in a real server: while they run, and after they have ended.

The history of one lane is 7.34 MB (32,768 ticks, 28 channels of 8 bytes); 0.66 MB are left for the
rest of a session, which needs about 0.1 MB.
"""

import pytest

from tests.benchmarks.attacks import read_memory_mb
from tests.benchmarks.memory import end_sessions, open_sessions
from tests.lab import run_lab

SESSIONS = 48
LARGEST_SESSION_MB = 8.0
KEPT_MB = 16.0
"""Bound of what 48 ended sessions leave, MB: free lists of the allocator, two sessions' worth."""


@pytest.mark.exhaustive
def test_session_with_one_lane_costs_8_mb_which_return_when_it_ends():
    """Costs that occur once, such as imports, belong to the first session, which is not counted."""
    with run_lab(max_sessions=str(SESSIONS)) as lab:
        lab.client.post(lab.session + "/pause").raise_for_status()
        end_sessions(lab, open_sessions(lab, 1))
        before_mb = read_memory_mb(lab)
        for _ in range(2):
            paths = open_sessions(lab, SESSIONS)
            assert read_memory_mb(lab) - before_mb < SESSIONS * LARGEST_SESSION_MB
            end_sessions(lab, paths)
            assert read_memory_mb(lab) - before_mb < KEPT_MB
