"""A lab with a bench: `svsa serve --bench` and an emulator, as processes.

The commands that the rig's drives received are read from the rig itself, and every timeout is long.
"""

import contextlib
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from svsa.actuators.parameters import SVSA
from svsa.hardware.emulator.launch import RunningEmulator
from tests.hardware.live_bench import start_live_emulator, write_bench
from tests.lab import START_TIMEOUT_S, Lab, run_lab
from tests.processes import find_child
from tests.waiting import wait_until

PATIENCE_S = 120.0


class BenchLab:
    """A lab that drives the emulator, whose loop has been started."""

    def __init__(self, lab: Lab, emulator: RunningEmulator) -> None:
        self.lab, self.emulator = lab, emulator
        wait_until(lambda: self.loop_state != "starting", self.describe, START_TIMEOUT_S)
        assert self.loop_state == "ticking", self.describe()

    @property
    def loop_state(self) -> str:
        return self.read()["bench"]["loop"]["state"]

    def read(self) -> dict[str, Any]:
        return self.lab.read()

    @property
    def status(self) -> str:
        return self.read()["bench"]["status"]

    def ask(self, path: str, json: Any = None, method: str = "POST") -> dict[str, Any]:
        answer = self.lab.client.request(method, self.lab.session + path, json=json)
        assert answer.is_success, answer.text
        return answer.json()

    def expect_rejection(self, path: str, json: Any = None, method: str = "POST") -> str:
        """Send a request that the state of the bench does not permit; return the reason."""
        answer = self.lab.client.request(method, self.lab.session + path, json=json)
        assert answer.status_code == 409, answer.text
        return answer.json()["detail"]

    def read_drives(self) -> list[tuple[int | None, int]]:
        """Return mode and commanded current, mA, of both drives on the rig."""
        drives = self.emulator.control.read_state()["drives"].values()
        return [(drive["mode"], drive["commanded_ma"]) for drive in drives]

    def is_at_zero(self) -> bool:
        return all(mode is None or current == 0 for mode, current in self.read_drives())

    def wait_for(self, status: str) -> None:
        wait_until(lambda: self.status == status, self.describe)

    def describe(self) -> str:
        """Describe the state for an error message."""
        state = self.read()
        return f"{state['fault']} {state['bench']}"

    def make_ready(self) -> None:
        """Arm and home from any state: the rig is set to its marks while OFF."""
        if self.status != "off":
            self.ask("/quick-stop")
            self.wait_for("fault")
            self.ask("/bench/clear")
            self.wait_for("off")
        self.emulator.control.home()
        self.ask("/bench/arm")
        self.wait_for("ready")
        for step in ("link", "motor1", "motor2"):
            self.ask("/bench/home", {"step": step, "by": "a test"})

    def wait_for_ticks(self, ticks: int = 300) -> dict[str, Any]:
        """Return the state after this many more ticks."""
        begin = self.read()["tick"]
        wait_until(lambda: self.read()["tick"] >= begin + ticks, self.describe)
        return self.read()

    @contextlib.contextmanager
    def watched(self) -> Iterator[None]:
        """Read a stream of it, as a viewer."""
        with connect(self.lab.stream_url, proxy=None, max_size=None) as stream:
            stream.recv(timeout=PATIENCE_S)
            thread = threading.Thread(target=read_stream, args=(stream,))
            thread.start()
            yield
        thread.join(PATIENCE_S)

    @contextlib.contextmanager
    def running(self) -> Iterator[None]:
        """In the state READY, with a viewer, and started."""
        self.make_ready()
        with self.watched():
            self.ask("/start")
            self.wait_for("run")
            yield

    def find_process(self, module: str) -> int:
        """Return the process of this lab that runs a module."""
        return find_child(self.lab.process.pid, module)


def read_stream(stream: Any) -> None:
    with contextlib.suppress(ConnectionClosed):
        while True:
            stream.recv()


@contextlib.contextmanager
def run_bench_lab(folder: Path, actuator: str = SVSA) -> Iterator[BenchLab]:
    with (
        start_live_emulator(actuator) as emulator,
        run_lab("--bench", str(write_bench(folder, emulator, actuator=actuator))) as lab,
    ):
        yield BenchLab(lab, emulator)
