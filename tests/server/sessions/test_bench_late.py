"""A setting after a short suspension of the loop's process: the server answers and continues."""

import os
import signal
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from svsa.hardware.emulator.launch import start_emulator
from tests.hardware.live_bench import IDLE_S, write_bench
from tests.hardware.safety.survivors import LOOP
from tests.lab import run_lab
from tests.server.sessions.bench_lab import BenchLab
from tests.waiting import wait_until

pytestmark = pytest.mark.wall_clock

STOPPED_S = 0.6
PROMPT = {"loop_s": 0.2, "stale_fault_s": 0.2}
"""The supervisor stops the drives within this time, and feedback of this age is a fault."""
ANSWER_S = 30.0
"""A blocked server does not answer at all."""


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Iterator[BenchLab]:
    """The rig's time advances while the loop is stopped, as that of a bench does."""
    folder: Path = tmp_path_factory.mktemp("bench")
    with start_emulator(False, IDLE_S, "--real-time") as emulator:
        path = write_bench(folder, emulator, lockstep=False, **PROMPT)
        with run_lab("--bench", str(path)) as lab:
            lab.client.timeout = ANSWER_S
            yield BenchLab(lab, emulator)


def test_setting_after_a_late_loop_is_answered(bench: BenchLab) -> None:
    with bench.running():
        bench.wait_for_ticks(200)
        loop = bench.find_process(LOOP)
        os.kill(loop, signal.SIGSTOP)
        time.sleep(STOPPED_S)
        os.kill(loop, signal.SIGCONT)
        wait_until(lambda: bench.read()["fault"] is not None, bench.describe)
    assert bench.read()["fault"]["code"] in ("loop_late", "loop_silent"), bench.describe()
    wait_until(lambda: bench.loop_state == "ticking", bench.describe)
    assert bench.ask("/law", {"law": "fl"}, "PUT")["lanes"][0]["law"] == "fl"
    bench.lab.client.get("/api/v1/health").raise_for_status()
    bench.lab.client.post("/api/v1/quick-stop").raise_for_status()
    bench.ask("/bench/clear")
    with bench.running():
        bench.wait_for_ticks(100)
