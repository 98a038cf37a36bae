"""A session that blocks all sessions: the server still answers, stops a bench, and ends."""

import contextlib
import signal
import threading
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from svsa_server.responsive import SILENT_S
from tests.hardware.live_bench import start_live_emulator, write_bench
from tests.hardware.safety.survivors import LOAD
from tests.lab import END_TIMEOUT_S, Lab, run_lab
from tests.server.blocked_lab import BLOCKED, BLOCKING, BLOCKING_WAKE, PROGRAM
from tests.server.sessions.bench_lab import BenchLab
from tests.waiting import PATIENCE_S, wait_until

STOP = "/api/v1/quick-stop"


@contextlib.contextmanager
def blocked(lab: Lab, factor: float = BLOCKING) -> Iterator[list[httpx.Response]]:
    """Block the shared session; yield the answers to its request."""
    answers: list[httpx.Response] = []

    def ask() -> None:
        with httpx.Client(base_url=lab.url, timeout=PATIENCE_S, trust_env=False) as client:
            answers.append(client.put(lab.session + "/speed", json={"speed": factor}))

    thread = threading.Thread(target=ask)
    thread.start()
    # Without the file, a busy machine could delay the sessions as long before they block.
    wait_until((lab.data / BLOCKED).exists)
    wait_until(lambda: lab.client.get("/api/v1/health").json()["sessions_silent_s"] > 0.0)
    yield answers
    thread.join(PATIENCE_S)


def end_blocked(lab: Lab, number: signal.Signals) -> int:
    """Return the exit code of the server after this signal."""
    assert lab.process is not None
    lab.process.send_signal(number)
    return lab.process.wait(END_TIMEOUT_S)


@pytest.mark.exhaustive
def test_every_request_is_answered_while_a_session_blocks() -> None:
    with run_lab(program=PROGRAM) as lab, connect(lab.stream_url, proxy=None) as stream:
        with blocked(lab) as answers:
            health = lab.client.get("/api/v1/health").raise_for_status().json()
            assert health["status"] == "ok"
            assert health["sessions_silent_s"] < SILENT_S, "health waits for no session"
            for stop in (STOP, lab.session + "/quick-stop"):
                refused = lab.client.post(stop)
                assert refused.status_code == 503
                assert "have not responded for" in refused.json()["detail"]
            origin = {"Origin": "http://elsewhere.example"}
            assert lab.client.post(STOP, headers=origin).status_code == 403
            assert lab.client.get(lab.session).status_code == 503
        (answer,) = answers
        assert answer.status_code == 503
        assert answer.json()["type"] == "urn:svsa:problem:silent"
        with pytest.raises(ConnectionClosed) as closed:
            while True:
                stream.recv(PATIENCE_S)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1013
        with pytest.raises(InvalidStatus):
            connect(lab.stream_url, proxy=None)
        assert end_blocked(lab, signal.SIGINT) == 1


@pytest.mark.exhaustive
def test_sigterm_ends_a_server_whose_session_computes_indefinitely() -> None:
    with run_lab(program=PROGRAM) as lab:
        with blocked(lab, BLOCKING_WAKE):
            assert lab.client.post(STOP).status_code == 503
        assert end_blocked(lab, signal.SIGTERM) == -signal.SIGTERM


@pytest.mark.wall_clock
def test_quick_stop_reaches_a_bench_whose_session_blocks(tmp_path: Path) -> None:
    with (
        start_live_emulator() as emulator,
        run_lab("--bench", str(write_bench(tmp_path, emulator)), program=PROGRAM) as lab,
    ):
        bench = BenchLab(lab, emulator)
        with bench.running():
            bench.ask("/position", {"kind": "constant", "position_rad": 0.2}, "PUT")
            emulator.control.load(LOAD)
            wait_until(lambda: not bench.is_at_zero(), bench.describe)
            with blocked(lab):
                reported = lab.client.post(lab.session + "/quick-stop")
                assert "passed to the loop of the bench" in reported.json()["detail"]
                assert lab.client.post(STOP).status_code == 204
                wait_until(bench.is_at_zero)
        assert end_blocked(lab, signal.SIGINT) == 1
