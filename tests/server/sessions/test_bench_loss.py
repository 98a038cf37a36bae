"""The lab with a bench whose processes are killed or stand still while it holds a load.

The next test shows that the bench runs again, because there it holds a load. These tests do not
measure times: `tests.hardware.safety.test_survivors` does, and also tests a killed server.
"""

import contextlib
import os
import signal
from collections.abc import Iterator
from typing import Any

import pytest

from tests.hardware.safety.survivors import LOAD, LOOP, SUPERVISOR, wait_until_held
from tests.server.sessions.bench_lab import BenchLab, run_bench_lab
from tests.waiting import wait_until

pytestmark = pytest.mark.wall_clock


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Iterator[BenchLab]:
    with run_bench_lab(tmp_path_factory.mktemp("bench")) as running:
        yield running


@contextlib.contextmanager
def holding(bench: BenchLab) -> Iterator[None]:
    """In any previous state: start, and hold a load at rest on a rig that waits for its loop. In
    the first tenth of a second of a load, a loop suspended for that long leaves a motor above its
    speed limit.
    """
    with bench.running():
        state = bench.wait_for_ticks(100)
        assert state["fault"] is None
        wait_until(lambda: bench.read()["bench"]["supervised"], bench.describe)
        bench.ask("/position", {"kind": "constant", "position_rad": 0.2}, "PUT")
        bench.emulator.control.load(LOAD)
        try:
            assert wait_until_held(bench.emulator), bench.describe()
            yield
        finally:
            bench.emulator.control.set_loads(())


def wait_until_reported(bench: BenchLab, words: str) -> dict[str, Any]:
    """Return the fault once it has this text: the action taken is known later than the event."""

    def read() -> dict[str, Any]:
        return bench.read()["fault"] or {"message": ""}

    wait_until(lambda: words in read()["message"], bench.describe)
    return read()


def test_killed_loop_leaves_zero_current_and_is_restarted(bench: BenchLab) -> None:
    with holding(bench):
        os.kill(bench.find_process(LOOP), signal.SIGKILL)
        wait_until(bench.is_at_zero, bench.describe)
        fault = wait_until_reported(bench, "The supervisor keeps both drives at zero current")
        assert fault["code"] == "loop_lost"
    bench.ask("/bench/clear")


@pytest.mark.exhaustive
def test_killed_supervisor_ends_the_run_and_is_restarted(bench: BenchLab) -> None:
    with holding(bench):
        os.kill(bench.find_process(SUPERVISOR), signal.SIGKILL)
        fault = wait_until_reported(bench, "supervisor")
        wait_until(bench.is_at_zero, bench.describe)
        state = bench.read()
        assert fault["code"] == "supervisor_lost"
        assert state["bench"]["supervised"] is False
    bench.ask("/bench/clear")


def test_silent_loop_is_named_with_a_recovery_and_stops_no_other_user(bench: BenchLab) -> None:
    """No user watches, so the server has a reason to query the loop at every wake-up."""
    client = bench.lab.client
    private = client.post("/api/v1/sessions", json={"figure": "4a"}).raise_for_status().json()
    path = f"/api/v1/sessions/{private['session']}"
    with holding(bench):
        os.kill(bench.find_process(LOOP), signal.SIGSTOP)
    wait_until(bench.is_at_zero, bench.describe)
    wait_until_reported(bench, "The supervisor keeps both drives at zero current")
    state = bench.read()
    loop = state["bench"]["loop"]
    assert state["fault"]["code"] == "loop_silent"
    assert "Restart the loop" in state["fault"]["message"]
    assert (state["status"], state["bench"]["status"]) == ("fault", "fault")
    assert (loop["alive"], loop["state"], loop["stopped_by"]) == (False, "silent", "supervisor")
    assert loop["silent_s"] > 0.5
    assert state["bench"]["current_a"] is None, "no user hears what they make"
    assert min(state["bench"]["ages_s"]) > 0.5, "what was heard is as old as the last tick"
    before = client.get(path).json()["tick"]
    assert "silent" in bench.expect_rejection("/bench/arm")
    wait_until(lambda: client.get(path).json()["tick"] > before + 1000)
    client.delete(path).raise_for_status()
    state = bench.ask("/bench/restart")
    assert (state["fault"], state["bench"]["loop"]["state"]) == (None, "ticking")


def test_server_stops_the_drives_without_loop_and_supervisor(bench: BenchLab) -> None:
    with holding(bench):
        warmed = [motor["heat"] for motor in bench.read()["bench"]["motors"]]
        for module in (LOOP, SUPERVISOR):
            os.kill(bench.find_process(module), signal.SIGKILL)
        wait_until(bench.is_at_zero, bench.describe)
        wait_until_reported(bench, "The server has opened the bus")
        state = bench.read()
        assert state["fault"]["code"] == "loop_and_supervisor_lost"
        assert state["bench"]["loop"]["stopped_by"] == "server"
        assert state["bench"]["loop"]["state"] == "gone"
        assert state["bench"]["loop"]["unreachable"] is None
    state = bench.ask("/bench/restart")
    for motor, warm in zip(state["bench"]["motors"], warmed, strict=True):
        assert motor["heat"] > 0.1 * warm > 0.0, "a motor is as warm as before the restart"
    with holding(bench):
        pass
