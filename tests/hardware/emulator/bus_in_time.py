"""The emulator as a python-can bus in virtual time: waiting for a frame advances the time."""

import copy
import math
from collections import deque
from collections.abc import Callable
from pathlib import Path

import can

from svsa.hardware.bench.settings import BusSettings
from svsa.hardware.emulator.emulator import Emulator
from tests.hardware.emulator.wire_frames import build_message, read_frame

EMULATOR_BENCH = Path(__file__).parents[3] / "svsa" / "hardware" / "emulator" / "bench.toml"


def copy_bench(folder: Path, change: Callable[[str], str] = str) -> Path:
    """Copy the emulator's bench file and record into a folder of the test."""
    for name in ("bench.toml", "bench.calibration.toml"):
        (folder / name).write_text(EMULATOR_BENCH.with_name(name).read_text("utf-8"), "utf-8")
    path = folder / "bench.toml"
    path.write_text(change(path.read_text("utf-8")), "utf-8")
    return path


class EmulatorBus:
    """The interface of `can.BusABC`. sent: every frame of the test, with its time."""

    def __init__(self, emulator: Emulator | None = None) -> None:
        self.emulator = emulator or Emulator()
        self.sent: list[tuple[float, can.Message]] = []
        self.is_open = False
        self.before_send: Callable[[can.Message], None] = lambda _: None
        self._heard: deque[can.Message] = deque()

    def open(self, settings: BusSettings) -> can.BusABC:
        self.is_open = True
        return self  # pyright: ignore[reportReturnType]

    def now(self) -> float:
        return self.emulator.now_us * 1e-6

    def send(self, message: can.Message, timeout: float | None = None) -> None:
        self.before_send(message)
        self.sent.append((self.now(), copy.deepcopy(message)))
        self.emulator.receive(read_frame(message), self)

    def recv(self, timeout: float) -> can.Message | None:
        end_us = self.emulator.now_us + math.ceil(timeout * 1e6)
        while not self._heard and self.emulator.now_us < end_us:
            self._advance_to(min(self.emulator.next_event_us, end_us))
        return self._heard.popleft() if self._heard else None

    def sleep(self, duration_s: float) -> None:
        """A scheduling delay of the test process; the emulator continues."""
        self._advance_to(self.emulator.now_us + round(duration_s * 1e6))

    def _advance_to(self, end_us: int) -> None:
        for time_us, frame, sender in self.emulator.advance_to(end_us):
            if sender is not self:
                self._heard.append(build_message(frame, time_us * 1e-6))

    def shutdown(self) -> None:
        self.is_open = False
