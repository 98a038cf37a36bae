"""Resident memory of private sessions in a real server: while they run, and after they have ended.

The history of one lane is 7.34 MB (32,768 ticks, 28 channels of 8 bytes); 0.66 MB are left for the
rest of a session, which needs about 0.1 MB.
"""

import pytest

from svsa.runs.session.journal import HISTORY_TICKS
from tests.benchmarks.attacks import read_memory_mb
from tests.lab import Lab, run_lab

SESSIONS = 48
LARGEST_SESSION_MB = 8.0
KEPT_MB = 16.0
"""Bound of what 48 ended sessions leave, MB: free lists of the allocator, two sessions' worth."""
STEP_TICKS = 8192


def open_sessions(lab: Lab, count: int, **wanted: object) -> list[str]:
    """Open paused sessions with a history that is full."""
    paths = []
    for _ in range(count):
        opened = lab.client.post("/api/v1/sessions", json={"figure": "4a"} | wanted)
        paths.append(f"/api/v1/sessions/{opened.raise_for_status().json()['session']}")
        lab.client.post(paths[-1] + "/pause").raise_for_status()
        for _ in range(HISTORY_TICKS // STEP_TICKS):
            lab.client.post(paths[-1] + "/step", json={"ticks": STEP_TICKS}).raise_for_status()
    return paths


def end_sessions(lab: Lab, paths: list[str]) -> None:
    for path in paths:
        lab.client.delete(path).raise_for_status()


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
