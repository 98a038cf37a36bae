"""Commands that control the emulator from outside: JSON lines over TCP on this machine.

    {"do": "load", "load": {"kind": "mass"}, "at_s": 5.0}    {"do": "set_loads", "loads": [...]}
    {"do": "fault", "fault": {"kind": "freeze", "node": "deflection"}}
    {"do": "clear_faults"}    {"do": "home"}                  {"do": "state"}

Each line is answered by one: {"ok": true, ...} or {"ok": false, "message": "..."}.
"""

import contextlib
import json
import socket
from collections.abc import Callable
from typing import Any, Self

from pydantic import TypeAdapter, ValidationError

from svsa.errors import ParameterError, SvsaError, Violation
from svsa.hardware.emulator.emulator import Emulator
from svsa.hardware.emulator.faults import EmulatorFault
from svsa.inputs.explanation import explain
from svsa.simulation.plant.loads import Load

MAX_LINE_BYTES = 1 << 20
_LOAD = TypeAdapter(Load)
_FAULT = TypeAdapter(EmulatorFault)


class EmulatorError(SvsaError):
    """The emulator rejected a command, or is not reachable."""


class ControlServer:
    """The server of an emulator's control port; never blocks."""

    def __init__(self, emulator: Emulator, host: str, port: int) -> None:
        self._rig = emulator
        self._listener = socket.create_server((host, port))
        self._listener.setblocking(False)
        self._clients: dict[socket.socket, bytearray] = {}
        self.port = int(self._listener.getsockname()[1])

    def sources(self) -> list[socket.socket]:
        """Sockets to select on."""
        return [self._listener, *self._clients]

    def poll(self) -> None:
        """Execute the clients' commands."""
        with contextlib.suppress(BlockingIOError):
            client, _ = self._listener.accept()
            client.setblocking(False)
            self._clients[client] = bytearray()
        for client, unread in list(self._clients.items()):
            try:
                self._serve(client, unread)
            except BlockingIOError:
                continue
            except OSError:
                client.close()
                del self._clients[client]

    def _serve(self, client: socket.socket, unread: bytearray) -> None:
        chunk = client.recv(65536)
        if not chunk or len(unread) > MAX_LINE_BYTES:
            raise ConnectionError
        unread += chunk
        while (end := unread.find(b"\n")) >= 0:
            line = bytes(unread[:end])
            del unread[: end + 1]
            client.sendall(json.dumps(answer(self._rig, line)).encode() + b"\n")

    def close(self) -> None:
        """Close every connection."""
        for each in self.sources():
            each.close()
        self._clients.clear()


def answer(emulator: Emulator, line: bytes) -> dict[str, Any]:
    """Execute one line and return its answer; invalid lines have no effect."""
    try:
        request = json.loads(line)
        if not isinstance(request, dict):
            raise ParameterError(Violation("command", request, "", "an object with named fields"))
        return {"ok": True, **_do(emulator, request)}
    except ValidationError as error:
        return {"ok": False, "message": str(ParameterError(*explain(error)))}
    # `json.loads` raises RecursionError for deeply nested brackets.
    except (SvsaError, ValueError, RecursionError) as error:
        return {"ok": False, "message": str(error)}


def _do(emulator: Emulator, request: dict[str, Any]) -> dict[str, Any]:
    at_s = request.get("at_s")
    if at_s is not None and (not isinstance(at_s, int | float) or not 0 <= at_s <= 1e6):
        raise ParameterError(Violation("at_s", at_s, "s", "a time of the emulator from 0 to 1e6 s"))
    at_us = emulator.now_us if at_s is None else round(at_s * 1e6)
    happen: Callable[[], None]
    match request.get("do"):
        case "state":
            return describe(emulator)
        case "load":
            load = _LOAD.validate_python(request.get("load"))
            happen = lambda: emulator.add_load(load)  # noqa: E731
        case "set_loads":
            loads = [_LOAD.validate_python(load) for load in request.get("loads", [])]
            happen = lambda: emulator.set_loads(loads)  # noqa: E731
        case "fault":
            fault = _FAULT.validate_python(request.get("fault"))
            happen = lambda: emulator.inject(fault)  # noqa: E731
        case "clear_faults":
            happen = emulator.clear_faults
        case "home":
            happen = emulator.home
        case other:
            bound = "one of state, load, set_loads, fault, clear_faults, home"
            raise ParameterError(Violation("do", other, "", bound))
    if at_us <= emulator.now_us:
        happen()
    else:
        emulator.schedule(at_us, happen)
    return {"time_s": emulator.now_us * 1e-6}


def describe(emulator: Emulator) -> dict[str, Any]:
    """Return the true state: time, state, torques, drives."""
    made, x = emulator.mechanics.torque, emulator.mechanics.read(emulator.now_us)
    return {
        "time_s": emulator.now_us * 1e-6,
        "time_us": emulator.now_us,
        "frames": emulator.frames,
        "x": x._asdict(),
        "torque_nm": [made.u1, made.u2],
        "loads": emulator.mechanics.load_count,
        "drives": {
            name: {
                "mode": drive.mode,
                "commanded_ma": drive.current_ma,
                "commanded_since_s": drive.since_us * 1e-6,
                "target_nm": drive.target_nm,
                "actual_ma": drive.compute_current_ma(torque),
                "errors": drive.errors,
                "powered": drive.powered,
                "stalled": drive.stalled,
            }
            for (name, drive), torque in zip(emulator.drives.items(), made, strict=True)
        },
    }


class EmulatorControl:
    """A client of an emulator's control port. Raises `EmulatorError` if it refuses or is gone."""

    def __init__(self, port: int, timeout_s: float = 5.0) -> None:
        try:
            self._socket = socket.create_connection(("127.0.0.1", port), timeout_s)
        except OSError as error:
            raise EmulatorError(f"There is no emulator at control port {port}: {error}.") from None
        self._file = self._socket.makefile("rwb")

    def ask(self, do: str, **fields: Any) -> dict[str, Any]:
        """Send a command and return its answer."""
        try:
            self._file.write(json.dumps({"do": do, **fields}).encode() + b"\n")
            self._file.flush()
            line = self._file.readline()
            answer = json.loads(line)
        except (OSError, ValueError) as error:
            raise EmulatorError(f"The emulator does not answer: {error}.") from None
        if not answer.pop("ok"):
            raise EmulatorError(answer["message"])
        return answer

    def set_loads(self, loads: tuple[Load, ...]) -> None:
        """Replace all loads of the emulator by these."""
        self.ask("set_loads", loads=[_LOAD.dump_python(load, mode="json") for load in loads])

    def load(self, load: Load, at_s: float | None = None) -> None:
        """Apply a load, now or at an emulator time."""
        self.ask("load", load=_LOAD.dump_python(load, mode="json"), at_s=at_s)

    def fault(self, fault: EmulatorFault, at_s: float | None = None) -> None:
        """Inject a fault, now or at an emulator time."""
        self.ask("fault", fault=fault.model_dump(mode="json"), at_s=at_s)

    def clear_faults(self) -> None:
        """Remove all faults."""
        self.ask("clear_faults")

    def home(self) -> None:
        """Move the mechanism to its zero marks, as by hand."""
        self.ask("home")

    def read_state(self) -> dict[str, Any]:
        """Read the state, see `describe`."""
        return self.ask("state")

    def close(self) -> None:
        """Disconnect."""
        self._file.close()
        self._socket.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
