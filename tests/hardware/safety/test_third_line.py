"""The third line of safety: it acts if loop and supervisor are both lost, and reports it."""

import threading
import time
import types
from collections.abc import Iterator
from typing import Any

import pytest

from svsa.hardware.description.file import read_bench
from svsa.hardware.drives.bus import BusError
from svsa.hardware.realtime.loss import find_loss
from svsa.hardware.safety import third_line
from svsa.hardware.safety.heartbeat import Heartbeats
from svsa.hardware.safety.third_line import LOOKS, ThirdLine
from tests.hardware.wired_bench import EMULATOR_BENCH
from tests.waiting import wait_until

PATIENCE_S = 60.0


class Bus:
    """Stores sent frames."""

    def __init__(self) -> None:
        self.sent: list[int] = []
        self.is_open = True

    def send(self, message: Any) -> None:
        self.sent.append(message.arbitration_id)

    def recv(self, timeout: float) -> None:
        return None

    def shutdown(self) -> None:
        self.is_open = False


class Process:
    """A process that exists until it is killed."""

    def __init__(self) -> None:
        self.returncode: int | None = None

    def poll(self) -> int | None:
        return self.returncode

    def kill(self) -> None:
        self.returncode = -9


class Watched:
    """A third line, with its processes and its bus."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.bus, self.refusals = Bus(), 0
        self.loop, self.supervisor = Process(), Process()
        self.beats = Heartbeats.create()
        monkeypatch.setattr(third_line, "open_bus", self._open)
        monkeypatch.setattr(third_line, "request_priority", lambda _: "")
        self.line = ThirdLine(read_bench(EMULATOR_BENCH), self.beats, self.loop, self.supervisor)  # pyright: ignore[reportArgumentType]

    def _open(self, _: Any) -> Bus:
        if self.refusals:
            self.refusals -= 1
            raise BusError("The adapter is held.")
        return self.bus

    def find_loss(self) -> Any:
        gone = self.loop.returncode is not None
        return find_loss(
            types.SimpleNamespace(  # pyright: ignore[reportArgumentType]
                listens=not gone,
                failure=None,
                alive=not gone,
                supervisor_alive=self.supervisor.returncode is None,
                beats=self.beats,
                third_line=self.line,
            )
        )


@pytest.fixture
def watched(monkeypatch: pytest.MonkeyPatch) -> Iterator[Watched]:
    made = Watched(monkeypatch)
    yield made
    made.line.stop()
    made.beats.close()


def test_third_line_is_passive_while_one_process_is_left_or_none_has_started(
    watched: Watched, monkeypatch: pytest.MonkeyPatch
) -> None:
    watched.loop.kill()
    watched.supervisor.kill()
    time.sleep(0.1)
    assert watched.line.intervention is None, "a loop that has not begun is not missed"
    watched.supervisor.returncode = None
    ages_s, looks = {"loop": 10.0, "supervisor": 0.0}, list[str]()

    def look(slot: str) -> float:
        looks.append(slot)
        return ages_s[slot]

    monkeypatch.setattr(watched.beats, "age_s", look)
    wait_until(lambda: looks.count("supervisor") > 2 * LOOKS)
    assert watched.line.intervention is None
    assert watched.bus.sent == []


def test_third_line_stops_the_drives_after_the_end_of_both(watched: Watched) -> None:
    watched.beats.beat("loop")
    watched.loop.kill()
    watched.supervisor.kill()
    wait_until(lambda: watched.bus.sent.count(0x000) >= 3)
    assert set(watched.bus.sent) == {0x013, 0x023, 0x000}
    intervention = watched.line.intervention
    assert intervention is not None
    assert intervention.problem is None
    assert intervention.after_s is not None
    assert intervention.after_s > 0.02
    loss = watched.find_loss()
    assert (loss.code, loss.stopped_by) == ("loop_and_supervisor_lost", "server")
    watched.line.stop()
    assert not watched.bus.is_open


def test_third_line_first_ends_suspended_processes(watched: Watched) -> None:
    watched.beats.beat("supervisor")
    watched.beats.beat("loop")
    wait_until(lambda: watched.bus.sent)
    assert (watched.loop.returncode, watched.supervisor.returncode) == (-9, -9)


def test_failed_opening_of_the_bus_is_reported_and_repeated(watched: Watched) -> None:
    watched.refusals = 10**9
    watched.beats.beat("loop")
    watched.loop.kill()
    watched.supervisor.kill()
    wait_until(lambda: watched.line.intervention is not None)
    loss = watched.find_loss()
    assert loss.stopped_by is None
    assert "disconnect the motors' supply. The adapter is held." in loss.message
    watched.refusals = 0
    wait_until(lambda: watched.bus.sent)
    wait_until(lambda: watched.find_loss().stopped_by == "server")
    assert watched.find_loss().problem is None


def test_loop_that_ended_regularly_is_lost_and_leaves_nothing(watched: Watched) -> None:
    """As if the bench could not be opened again."""
    watched.beats.beat("loop")
    watched.beats.end("loop")
    watched.loop.kill()
    watched.supervisor.kill()
    loss = watched.find_loss()
    assert (loss.code, loss.stopped_by) == ("loop_lost", None)
    assert "regularly" in loss.message
    assert "not stopped" not in loss.message


def test_blocked_opening_of_the_bus_is_not_waited_for(
    watched: Watched, monkeypatch: pytest.MonkeyPatch
) -> None:
    opening, released = threading.Event(), threading.Event()

    def open_later(_: Any) -> Bus:
        opening.set()
        released.wait(PATIENCE_S)
        return watched.bus

    monkeypatch.setattr(third_line, "open_bus", open_later)
    monkeypatch.setattr(third_line, "STOP_S", 0.05)
    watched.beats.beat("loop")
    watched.loop.kill()
    watched.supervisor.kill()
    assert opening.wait(PATIENCE_S)
    watched.line.stop()
    assert watched.line._thread.is_alive()
    released.set()
    watched.line._thread.join(PATIENCE_S)
    assert not watched.bus.is_open
