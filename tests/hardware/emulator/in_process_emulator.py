"""The emulator in lockstep inside this process: the same exchange of frames, no sockets."""

import contextlib
import json
from collections import deque
from collections.abc import Iterator
from typing import Any
from unittest.mock import patch

import can

from svsa.actuators.parameters import SVSA
from svsa.hardware.bench.emulation import Frame
from svsa.hardware.bench.settings import BusSettings
from svsa.hardware.emulator.control import EmulatorControl, EmulatorError, answer
from svsa.hardware.emulator.emulator import Emulator
from svsa.hardware.emulator.exchange import Exchange
from svsa.hardware.emulator.parameters import build_emulator_parameters
from tests.hardware.emulator.wire_frames import build_message, read_frame


class InProcessBus:
    """`can.BusABC` for a plant in lockstep: a frame is processed before `send` returns."""

    def __init__(self, emulator: "InProcessEmulator") -> None:
        self._rig = emulator
        self.heard: deque[can.Message] = deque()

    def send(self, message: can.Message, timeout: float | None = None) -> None:
        self._rig.take(self, read_frame(message))

    def recv(self, timeout: float | None = None) -> can.Message | None:
        return self.heard.popleft() if self.heard else None

    def shutdown(self) -> None:
        self._rig.buses.remove(self)


class InProcessControl(EmulatorControl):
    """The commands of the control port, without the port."""

    def __init__(self, emulator: Emulator) -> None:
        self._rig = emulator

    def ask(self, do: str, **fields: Any) -> dict[str, Any]:
        reported = answer(self._rig, json.dumps({"do": do, **fields}).encode())
        if not reported.pop("ok"):
            raise EmulatorError(reported["message"])
        return json.loads(json.dumps(reported))


class InProcessEmulator:
    """An emulator and its open buses; a `FrameServer` for its exchange of frames."""

    port = 0

    def __init__(self, actuator: str = SVSA) -> None:
        machine = Emulator(build_emulator_parameters(actuator))
        self.parameters = machine.parameters
        self.control = InProcessControl(machine)
        self.buses: list[InProcessBus] = []
        self._exchange = Exchange(machine, [self], lockstep=True)
        self._arrivals: list[InProcessBus] = []
        self._sent: list[tuple[InProcessBus, Frame]] = []

    def open_bus(self, settings: BusSettings) -> can.BusABC:
        bus = InProcessBus(self)
        self.buses.append(bus)
        self._arrivals.append(bus)
        return bus  # pyright: ignore[reportReturnType]

    def take(self, bus: InProcessBus, frame: Frame) -> None:
        self._sent.append((bus, frame))
        self._exchange.serve(self)

    def sources(self) -> list[Any]:
        return []

    def wait_s(self) -> float | None:
        return None

    def poll(self) -> list[tuple[Any, Frame]]:
        sent, self._sent = self._sent, []
        return sent

    def take_arrivals(self) -> list[Any]:
        arrivals, self._arrivals = self._arrivals, []
        return arrivals

    @property
    def listening(self) -> int:
        return len(self.buses)

    def send(self, frame: Frame, time_s: float, to: Any = None, but: Any = None) -> None:
        message = build_message(frame, round(time_s, 6))
        for bus in self.buses if to is None else [to]:
            if bus is not but:
                bus.heard.append(message)

    def flush(self) -> None:
        pass

    def close(self) -> None:
        self.buses.clear()


@contextlib.contextmanager
def start_in_process(actuator: str = SVSA) -> Iterator[InProcessEmulator]:
    """An emulator whose buses replace those that a plant opens."""
    emulator = InProcessEmulator(actuator)
    with patch("svsa.hardware.plant.can_plant.open_bus", emulator.open_bus):
        yield emulator
