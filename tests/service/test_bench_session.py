"""The lab with a bench: `svsa serve --bench` and the emulated rig, both against the wall clock.

What the rig's drives were told is read from the rig itself. Nothing here asks how punctual
anything was: staleness is relaxed in the bench file and every wait is generous.
"""

import contextlib
import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from svsa.rig.launch import RunningRig, start_rig
from tests.hardware.live_bench import write_bench
from tests.lab import Lab, run_lab
from tests.processes import find_child

pytestmark = pytest.mark.wall_clock

PATIENCE_S = 20.0
ATTEMPTS = 5
ZERO_S = 5.0
LOOP, SUPERVISOR = "svsa.runtime.realtime.process", "svsa.hardware.supervisor"


class BenchLab:
    """A lab that drives the emulated rig."""

    def __init__(self, lab: Lab, rig: RunningRig) -> None:
        self.lab, self.rig = lab, rig

    def read(self) -> dict[str, Any]:
        return self.lab.read()

    @property
    def status(self) -> str:
        return self.read()["bench"]["status"]

    def ask(self, path: str, json: Any = None, method: str = "POST") -> dict[str, Any]:
        answer = self.lab.client.request(method, self.lab.session + path, json=json)
        assert answer.is_success, answer.text
        return answer.json()

    def refuse(self, path: str, json: Any = None, method: str = "POST") -> str:
        """Ask for something that is refused for the state that the bench is in; why."""
        answer = self.lab.client.request(method, self.lab.session + path, json=json)
        assert answer.status_code == 409, answer.text
        return answer.json()["message"]

    def read_drives(self) -> list[tuple[int | None, int]]:
        """Mode and commanded current, mA, of both drives, as the rig has them."""
        drives = self.rig.control.read_state()["drives"].values()
        return [(drive["mode"], drive["commanded_ma"]) for drive in drives]

    def is_at_zero(self) -> bool:
        return all(mode is None or current == 0 for mode, current in self.read_drives())

    def wait_for(self, status: str) -> None:
        wait_until(lambda: self.status == status, self.describe)

    def describe(self) -> str:
        """What to look at where it does not do what it should."""
        state = self.read()
        return f"{state['fault']} {state['bench']}"

    def make_ready(self) -> None:
        """Armed and at home, from wherever it is: the rig is set to its marks while OFF.

        Again where the machine let the loop stand still meanwhile, which is a fault of its own.
        """
        for _ in range(ATTEMPTS):
            if self._arm_and_home():
                return
            assert self.read()["fault"]["code"] == "loop_late", self.describe()
        raise AssertionError(self.describe())

    def _arm_and_home(self) -> bool:
        """Whether it is READY and at home, or has a fault."""
        if self.status != "off":
            self.ask("/quick-stop")
            self.wait_for("fault")
            self.ask("/bench/clear")
            self.wait_for("off")
        self.rig.control.home()
        self.ask("/bench/arm")
        wait_until(lambda: self.status in ("ready", "fault"), self.describe)
        for step in ("link", "motor1", "motor2"):
            body = {"step": step, "by": "a test"}
            answer = self.lab.client.post(self.lab.session + "/bench/home", json=body)
            if self.status == "fault":
                return False
            assert answer.is_success, answer.text
        return True

    def wait_for_ticks(self, ticks: int = 300) -> dict[str, Any]:
        """The state once so many more ticks have been done."""
        begin = self.read()["tick"]
        wait_until(lambda: self.read()["tick"] >= begin + ticks, self.describe)
        return self.read()

    @contextlib.contextmanager
    def watched(self) -> Iterator[None]:
        """Somebody has a stream of it open, and reads it."""
        with connect(self.lab.stream_url, proxy=None, max_size=None) as stream:
            stream.recv(timeout=PATIENCE_S)
            thread = threading.Thread(target=read_stream, args=(stream,))
            thread.start()
            yield
        thread.join(PATIENCE_S)

    @contextlib.contextmanager
    def running(self) -> Iterator[None]:
        """Ready, watched, and begun."""
        self.make_ready()
        with self.watched():
            self.ask("/start")
            self.wait_for("run")
            yield

    def find_process(self, module: str) -> int:
        """The process of this lab that runs a module."""
        return find_child(self.lab.process.pid, module)


def read_stream(stream: Any) -> None:
    with contextlib.suppress(ConnectionClosed):
        while True:
            stream.recv()


def wait_until(
    done: Callable[[], bool], describe: Callable[[], str] = str, longest_s: float = PATIENCE_S
) -> None:
    end = time.monotonic() + longest_s
    while not done():
        assert time.monotonic() < end, describe()
        time.sleep(0.02)


@contextlib.contextmanager
def run_bench_lab(folder: Path) -> Iterator[BenchLab]:
    with (
        start_rig(lockstep=False) as rig,
        run_lab("--bench", str(write_bench(folder, rig))) as lab,
    ):
        yield BenchLab(lab, rig)


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Iterator[BenchLab]:
    with run_bench_lab(tmp_path_factory.mktemp("bench")) as running:
        yield running


def test_it_is_armed_and_homed_step_by_step_and_nothing_out_of_turn(bench: BenchLab) -> None:
    state = bench.read()
    assert state["bench"]["status"] == "off"
    assert state["bench"]["problems"] == []
    assert state["status"] == "paused"
    assert "arm it" in refuse_watched(bench)
    bench.rig.control.home()
    bench.ask("/bench/arm")
    assert "READY" in bench.refuse("/bench/home", {"step": "link", "by": "Ada"})
    bench.wait_for("ready")
    assert bench.read()["bench"]["emulated"] is True
    assert "zero mark of link" in refuse_watched(bench)
    wrong = bench.lab.client.post(
        bench.lab.session + "/bench/home", json={"step": "motor2", "by": "Ada"}
    )
    assert wrong.status_code in (409, 422)
    for step, following in (("link", "motor1"), ("motor1", "motor2"), ("motor2", None)):
        homing = bench.ask("/bench/home", {"step": step, "by": "Ada"})["bench"]["homing"]
        assert homing["next_step"] == following
        assert homing["instruction"]
    assert "Nobody watches" in bench.refuse("/start")
    assert [mode for mode, _ in bench.read_drives()] == [2, 2]
    assert bench.is_at_zero()


def refuse_watched(bench: BenchLab) -> str:
    with bench.watched():
        return bench.refuse("/start")


def test_a_run_takes_commands_at_a_tick_and_carries_its_twin(bench: BenchLab) -> None:
    bench.make_ready()
    run_id = bench.ask("/recording", {"name": "A run", "tags": ["mine"]})["recording"]["run_id"]
    with bench.watched():
        bench.ask("/start")
        bench.wait_for("run")
        bench.wait_for_ticks()
        bench.ask("/position", {"kind": "constant", "position_rad": 0.3}, "PUT")
        bench.ask("/stiffness", {"kind": "constant", "stiffness_nm_per_rad": 40.0}, "PUT")
        bench.ask("/gains", {"stiffness_coefficients": [900.0, 60.0]}, "PUT")
        bench.ask("/law", {"law": "fl"}, "PUT")
        bench.ask("/law", {"law": "ndobc"}, "PUT")
        bench.ask("/loads", {"kind": "constant", "torque_nm": [1.0, 0.0, 0.0]})
        state = bench.wait_for_ticks(1500)
        assert state["status"] == "running"
        assert state["fault"] is None
        assert bench.rig.control.read_state()["loads"] == 1
        assert len(state["lanes"]) == 2
        assert [lane["law"] for lane in state["lanes"]] == ["ndobc", "ndobc"]
        assert all(lane["since_load"] is not None for lane in state["lanes"])
        sample = state["sample"]
        assert sample["position_rad"] == pytest.approx(0.3, abs=0.05)
        assert sample["stiffness_nm_per_rad"] == pytest.approx(40.0, abs=2.0)
        assert sample["disturbance_link_nm"] is None
        assert sample["estimate_link_nm"] == pytest.approx(1.0, abs=0.4)
        assert 0.0 < abs(sample["position_residual_rad"]) < 0.1
        for refused in (("/step", {"ticks": 1}, "POST"), ("/speed", {"factor": 2.0}, "PUT")):
            assert "real time" in bench.refuse(*refused)
        assert "stop it" in bench.refuse("/reset")
        bench.ask("/loads", method="DELETE")
        bench.ask("/pause")
        bench.wait_for("ready")
        assert bench.is_at_zero()
        assert bench.read()["status"] == "paused"
    bench.ask("/recording", method="DELETE")
    check_recording(bench, run_id)


def check_recording(bench: BenchLab, run_id: str) -> None:
    """It says what it was made on, has every command with its tick, and is not simulated again."""
    client, runs = bench.lab.client, f"/api/v1/runs/{run_id}"
    wait_until(lambda: client.get(runs).json()["state"] != "recording")
    run = client.get(runs).json()
    assert set(run["tags"]) == {"mine", "emulated"}
    assert run["ticks"] > 1000
    commands = run["commands"]
    ticks = [command["tick"] for command in commands]
    kinds = [command["command"]["kind"] for command in commands]
    assert kinds[:3] == ["position", "stiffness", "gains"]
    assert ticks == sorted(ticks)
    assert 0 < ticks[0] < ticks[-1] <= run["ticks"]
    for path, body in (("/compare", None), ("/branch", {"tick": 10})):
        answer = client.post(runs + path, json=body)
        assert answer.status_code == 409, answer.text
        assert "emulated" in answer.json()["message"]


def test_a_quick_stop_is_latched_until_it_is_cleared(bench: BenchLab) -> None:
    with bench.running():
        bench.wait_for_ticks(200)
        bench.ask("/quick-stop")
        wait_until(bench.is_at_zero, longest_s=ZERO_S)
        state = bench.read()
        assert (state["status"], state["bench"]["status"]) == ("fault", "fault")
        assert state["fault"]["code"] == "quick_stop"
        for refused in ("/start", "/bench/arm"):
            assert "fault" in bench.refuse(refused)
        bench.ask("/bench/clear")
        bench.wait_for("off")
        assert bench.read()["fault"] is None


def test_losing_the_last_watcher_stops_it(bench: BenchLab) -> None:
    with bench.running():
        with bench.watched():
            bench.wait_for_ticks(100)
        bench.wait_for_ticks(1200)
        assert bench.status == "run", "one still watches"
    bench.wait_for("ready")
    assert bench.is_at_zero()
    assert bench.read()["fault"] is None


def test_a_killed_loop_leaves_zero_current_and_is_started_anew(bench: BenchLab) -> None:
    with bench.running():
        bench.wait_for_ticks(200)
        os.kill(bench.find_process(LOOP), signal.SIGKILL)
        wait_until(bench.is_at_zero, longest_s=ZERO_S)
        wait_until(lambda: bench.read()["fault"] is not None)
        fault = bench.read()["fault"]
        assert fault["code"] == "loop_lost"
        assert "supervisor" in fault["message"]
    bench.ask("/bench/clear")
    assert_runs_again(bench)


def test_a_killed_supervisor_ends_the_run_and_is_started_anew(bench: BenchLab) -> None:
    with bench.running():
        bench.wait_for_ticks(200)
        os.kill(bench.find_process(SUPERVISOR), signal.SIGKILL)
        wait_until(lambda: bench.read()["fault"] is not None)
        wait_until(bench.is_at_zero, longest_s=ZERO_S)
        state = bench.read()
        assert state["fault"]["code"] == "supervisor_lost"
        assert state["bench"]["supervised"] is False
    bench.ask("/bench/clear")
    assert_runs_again(bench)


def test_a_silent_loop_has_a_name_and_a_way_back_and_stops_nobody_else(bench: BenchLab) -> None:
    """Nobody watches any more, so that the server has a reason to ask it at every wake."""
    client = bench.lab.client
    private = client.post("/api/v1/sessions", json={"figure": "4a"}).raise_for_status().json()
    path = f"/api/v1/sessions/{private['session']}"
    with bench.running():
        bench.wait_for_ticks(200)
        os.kill(bench.find_process(LOOP), signal.SIGSTOP)
    wait_until(bench.is_at_zero, longest_s=ZERO_S)
    wait_until(lambda: bench.read()["fault"] is not None)
    state = bench.read()
    loop = state["bench"]["loop"]
    assert state["fault"]["code"] == "loop_silent"
    assert "Start the loop anew" in state["fault"]["message"]
    assert (state["status"], state["bench"]["status"]) == ("fault", "fault")
    assert (loop["alive"], loop["state"], loop["stopped_by"]) == (False, "silent", "supervisor")
    assert loop["silent_s"] > 0.5
    assert state["bench"]["current_a"] is None, "nobody hears what they make"
    assert min(state["bench"]["ages_s"]) > 0.5, "what was heard is as old as the last tick"
    before = client.get(path).json()["tick"]
    assert "silent" in bench.refuse("/bench/arm")
    wait_until(lambda: client.get(path).json()["tick"] > before + 1000)
    client.delete(path).raise_for_status()
    state = bench.ask("/bench/restart")
    assert (state["fault"], state["bench"]["loop"]["state"]) == (None, "ticking")
    assert_runs_again(bench)


def test_without_loop_and_supervisor_the_server_stops_the_drives(bench: BenchLab) -> None:
    with bench.running():
        bench.wait_for_ticks(200)
        for module in (LOOP, SUPERVISOR):
            os.kill(bench.find_process(module), signal.SIGKILL)
        wait_until(bench.is_at_zero, longest_s=ZERO_S)
        wait_until(lambda: bench.read()["bench"]["loop"]["stopped_by"] == "server")
        state = bench.read()
        assert state["fault"]["code"] == "loop_and_supervisor_lost"
        assert "The server has opened the bus" in state["fault"]["message"]
        assert state["bench"]["loop"]["state"] == "gone"
        assert state["bench"]["loop"]["unreachable"] is None
    bench.ask("/bench/restart")
    assert_runs_again(bench)


def assert_runs_again(bench: BenchLab) -> None:
    with bench.running():
        state = bench.wait_for_ticks(100)
        assert state["fault"] is None
        assert state["bench"]["supervised"] is True


def test_a_killed_server_leaves_zero_current(bench: BenchLab) -> None:
    """And neither loop nor supervisor goes on without it. The last test: its lab is gone."""
    with bench.running():
        bench.wait_for_ticks(200)
        left = [bench.find_process(LOOP), bench.find_process(SUPERVISOR)]
        bench.lab.process.kill()
        wait_until(bench.is_at_zero, longest_s=ZERO_S)
        wait_until(lambda: not any(Path(f"/proc/{each}").exists() for each in left))
        assert [mode for mode, _ in bench.read_drives()] == [None, None]
