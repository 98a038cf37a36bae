"""The sessions of a class run in real time during a study."""

import os
import time
from pathlib import Path

import pytest

from tests.exhaustive import exhaust
from tests.lab import run_lab

pytestmark = pytest.mark.wall_clock
CLASSES = [(8, 5.0), (40, 10.0)]
"""Number of sessions, and duration of the measurement, s."""
STUDIES = "/api/v1/studies"


def list_workers(process: int) -> list[int]:
    """Return the parent of this process's workers, the workers, and their workers."""
    threads = Path(f"/proc/{process}/task").iterdir()
    children = [int(one) for thread in threads for one in (thread / "children").read_text().split()]
    family = [one for child in children for one in (child, *list_workers(child))]
    return [one for one in family if b"forkserver" in Path(f"/proc/{one}/cmdline").read_bytes()]


def read_delays(client) -> dict[str, float]:
    return {
        one["session"]: one["accumulated_delay_s"] for one in client.get("/api/v1/sessions").json()
    }


@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="processes are found in /proc")
@pytest.mark.parametrize("size", exhaust(CLASSES, CLASSES[:1]))
def test_sessions_run_in_real_time_during_a_study(size: tuple[int, float]) -> None:
    """The scheduler's own measure: the accumulated delay of a session."""
    sessions, watched_s = size
    with run_lab() as lab:
        for _ in range(sessions):
            lab.client.post("/api/v1/sessions", json={"figure": "4a"}).raise_for_status()
        asked = {"source": "perturbation", "runs": 1_000_000}
        begun = lab.client.post(STUDIES, json=asked).raise_for_status().json()
        path = f"/api/v1/jobs/{begun['job']['id']}"
        end = time.monotonic() + 200.0
        while not lab.client.get(path).json()["rate_per_s"]:
            assert time.monotonic() < end
            time.sleep(0.2)
        _copied, *workers = list_workers(lab.process.pid)
        assert workers
        assert {os.getpriority(os.PRIO_PROCESS, one) for one in workers} == {10}
        before, done = read_delays(lab.client), lab.client.get(path).json()["done"]
        time.sleep(watched_s)
        after = read_delays(lab.client)
        assert lab.client.get(path).json()["done"] > done, "the study went on meanwhile"
        given_up = max(after[name] - before[name] for name in before)
        assert given_up < 0.1 * watched_s
