"""The supervisor: another process with its own bus stops the drives after the end of the loop."""

import contextlib
import io
import select
import signal
import socket
import subprocess
import sys
import time
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import can
import pytest
import tomli_w

from svsa.hardware.bench.emulation import EMULATED_DATA, EMULATED_ID, Frame
from svsa.hardware.description.file import read_bench
from svsa.hardware.drives.robomodule import Current, encode
from svsa.hardware.emulator.socketcand import SocketcandServer
from svsa.hardware.safety.heartbeat import Heartbeats
from svsa.hardware.safety.supervisor import Supervisor
from tests.hardware.wired_bench import EMULATOR_BENCH

ZERO, RESET = encode(Current(5000, 0)), b"\x55" * 8
STOPPED = {(0x013, ZERO), (0x023, ZERO), (0x000, RESET)}
LONG_S = 240.0
LOOP = """
import sys, time
from svsa.hardware.safety.heartbeat import Heartbeats
beats = Heartbeats.attach(sys.argv[1])
while True:
    beats.beat("loop")
    time.sleep(0.001)
"""


class RecordingBus:
    """Stores sent frames; returns a frame at each call, or none."""

    def __init__(self) -> None:
        self.sent: list[tuple[int, bytes]] = []
        self.talks = True
        self._said = False

    def send(self, message: can.Message) -> None:
        self.sent.append((message.arbitration_id, bytes(message.data)))

    def recv(self, timeout: float) -> can.Message | None:
        self._said = self.talks and not self._said
        return can.Message(arbitration_id=0x700, is_extended_id=False) if self._said else None


class Ages:
    """Heartbeats whose ages a test sets."""

    def __init__(self) -> None:
        self.loop_s = float("inf")
        self.beats: list[str] = []
        self.stops = 0

    def count_stop(self) -> None:
        self.stops += 1

    def beat(self, slot: str) -> None:
        self.beats.append(slot)

    def age_s(self, slot: str) -> float:
        return self.loop_s


@pytest.fixture
def watched() -> tuple[Supervisor, RecordingBus, Ages]:
    bus, ages = RecordingBus(), Ages()
    return Supervisor(read_bench(EMULATOR_BENCH), bus, ages), bus, ages  # pyright: ignore[reportArgumentType]


def test_supervisor_stops_the_drives_after_20_ms_until_the_loop_beats_again(
    watched: tuple[Supervisor, RecordingBus, Ages], capsys: pytest.CaptureFixture[str]
) -> None:
    supervisor, bus, ages = watched
    supervisor.watch()
    assert bus.sent == [], "a loop that has not begun is not missed"
    ages.loop_s = 0.0199
    supervisor.watch()
    assert bus.sent == []
    ages.loop_s = 0.0201
    for times in (1, 2, 3):
        supervisor.watch()
        assert bus.sent == [(0x013, ZERO), (0x023, ZERO), (0x000, RESET)] * times
        assert (ages.stops, ages.beats[-1]) == (1, "stopping"), "once, and reported at each action"
    assert capsys.readouterr().out.count("the loop is silent") == 1
    ages.loop_s = 0.001
    supervisor.watch()
    assert len(bus.sent) == 9
    assert not supervisor.silenced


def test_drives_are_stopped_before_any_output(
    watched: tuple[Supervisor, RecordingBus, Ages], monkeypatch: pytest.MonkeyPatch
) -> None:
    supervisor, bus, ages = watched

    class FullPipe(io.StringIO):
        def write(self, text: str) -> int:
            raise BlockingIOError

    monkeypatch.setattr(sys, "stdout", FullPipe())
    ages.loop_s = 1.0
    with pytest.raises(BlockingIOError):
        supervisor.watch()
    assert bus.sent == [(0x013, ZERO), (0x023, ZERO), (0x000, RESET)]
    assert ages.beats[-1] == "stopping"


def test_bench_file_sets_the_timeout() -> None:
    bench, ages = read_bench(EMULATOR_BENCH), Ages()
    bench = bench.changed(safety=bench.safety.changed(loop_s=0.3))
    supervisor = Supervisor(bench, RecordingBus(), ages)  # pyright: ignore[reportArgumentType]
    ages.loop_s = 0.299
    supervisor.watch()
    assert not supervisor.silenced
    ages.loop_s = 0.301
    supervisor.watch()
    assert supervisor.silenced


def test_supervisor_beats_only_while_it_receives_from_the_bus(
    watched: tuple[Supervisor, RecordingBus, Ages], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A bus can be lost without an error; a supervisor with a dead bus must not appear alive."""
    supervisor, bus, ages = watched
    now = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    bus.talks = False
    supervisor.watch()
    assert ages.beats == []
    bus.talks = True
    supervisor.watch()
    assert ages.beats == ["supervisor"]
    bus.talks = False
    now[0] += 0.2
    supervisor.watch()
    assert len(ages.beats) == 2
    now[0] += 0.1
    supervisor.watch()
    assert len(ages.beats) == 2


def write_bench(folder: Path, port: int) -> Path:
    sections: dict[str, Any] = tomllib.loads(EMULATOR_BENCH.read_text(encoding="utf-8"))
    sections["bus"]["options"]["port"] = port
    path = folder / "bench.toml"
    path.write_text(tomli_w.dumps(sections), encoding="utf-8")
    return path


@contextlib.contextmanager
def run(*arguments: str) -> Iterator[subprocess.Popen[str]]:
    process = subprocess.Popen(
        [sys.executable, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        yield process
    finally:
        process.kill()
        process.wait()
        for pipe in (process.stdout, process.stderr):
            if pipe is not None:
                pipe.close()


class Wire:
    """The bus from the side of the drives: serves the supervisor, and stores its frames."""

    def __init__(self) -> None:
        self.server = SocketcandServer()
        self.heard: list[tuple[int, bytes]] = []

    def serve_until(self, done: Any) -> None:
        end = time.monotonic() + LONG_S
        while not done():
            assert time.monotonic() < end, f"heard {self.heard[-3:]}"
            select.select(self.server.sources(), [], [], 0.01)
            self.heard += [(frame.can_id, frame.data) for _, frame in self.server.poll()]
            self.server.send(Frame(EMULATED_ID, EMULATED_DATA, extended=True), time.monotonic())

    def receives_all(self, since: int) -> bool:
        return set(self.heard[since:]) >= STOPPED


@pytest.fixture
def wire() -> Iterator[Wire]:
    served = Wire()
    yield served
    served.server.close()


@pytest.fixture
def beats() -> Iterator[Heartbeats]:
    made = Heartbeats.create()
    yield made
    made.close()


def test_loop_killed_with_kill_9_leaves_drives_at_zero(
    wire: Wire, beats: Heartbeats, tmp_path: Path
) -> None:
    bench = write_bench(tmp_path, wire.server.port)
    with (
        run("-m", "svsa.hardware.safety.supervisor", str(bench), beats.name) as supervisor,
        run("-c", LOOP, beats.name) as loop,
    ):
        wire.serve_until(lambda: beats.age_s("supervisor") < 0.1 and beats.age_s("loop") < 0.02)
        loop.send_signal(signal.SIGKILL)
        loop.wait()
        since = len(wire.heard)
        wire.serve_until(lambda: wire.receives_all(since))
        again = len(wire.heard)
        wire.serve_until(lambda: wire.receives_all(again))
        supervisor.terminate()
        last = len(wire.heard)
        wire.serve_until(lambda: supervisor.poll() is not None)
        wire.serve_until(lambda: wire.receives_all(last))
        assert supervisor.returncode == 0
        assert supervisor.stdout is not None
        assert "the loop is silent" in supervisor.stdout.read()


def test_supervisor_sends_a_last_zero_when_it_is_ended(
    wire: Wire, beats: Heartbeats, tmp_path: Path
) -> None:
    bench = write_bench(tmp_path, wire.server.port)
    with run("-m", "svsa.hardware.safety.supervisor", str(bench), beats.name) as supervisor:
        wire.serve_until(lambda: beats.age_s("supervisor") < 0.1)
        assert wire.heard == []
        supervisor.terminate()
        wire.serve_until(lambda: supervisor.poll() is not None and wire.receives_all(0))
        assert supervisor.returncode == 0


def test_supervisor_without_a_bus_reports_it_and_fails(beats: Heartbeats, tmp_path: Path) -> None:
    with socket.socket() as silent:
        silent.bind(("127.0.0.1", 0))
        bench = write_bench(tmp_path, silent.getsockname()[1])
        done = subprocess.run(
            [sys.executable, "-m", "svsa.hardware.safety.supervisor", str(bench), beats.name],
            capture_output=True,
            text=True,
            timeout=LONG_S,
        )
    assert done.returncode == 1
    assert "cannot be opened" in done.stderr
    assert "Traceback" not in done.stderr
