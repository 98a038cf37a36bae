"""A bench without hardware: the page's calls and stream are patched between page and lab."""

import copy
import json
from itertools import pairwise
from typing import Any

from playwright.sync_api import Page, Route, WebSocketRoute

from svsa.errors import Fault
from svsa_server.schemas.runs.fault import build_session_fault

BENCH: dict[str, Any] = {
    "name": "emulated bench",
    "emulated": True,
    "status": "off",
    "interface": "socketcand 127.0.0.1:29536 can0, 1 Mbit/s",
    "calibrated_by": "Ada Lovelace",
    "calibrated_on": "2026-11-20T09:30:00+00:00",
    "problems": [],
    "homing": {
        "done": ["link"],
        "next_step": "motor1",
        "instruction": "Turn the principal motor until its pointer stands at the scribed line.",
    },
    "current_a": [0.42, -0.07],
    "motors": [
        {
            "heat": 0.12,
            "lasting_torque_nm": 16.04,
            "allowed_torque_nm": 15.0,
            "limited_by_heat": False,
        },
        {
            "heat": 0.31,
            "lasting_torque_nm": 1.22,
            "allowed_torque_nm": 5.0,
            "limited_by_heat": False,
        },
    ],
    "ages_s": [0.0012, 0.0011, 0.0009],
    "stale_zero_s": 0.005,
    "stale_fault_s": 0.02,
    "supervised": True,
    "operator_required": False,
    "dead_man": False,
    "loop": {
        "alive": True,
        "state": "ticking",
        "silent_s": None,
        "stopped_by": None,
        "unreachable": None,
        "step": None,
        "starting_s": None,
        "rate_hz": 1000.0,
        "ticks": 182_341,
        "skipped_ticks": 41,
        "skipped_in_run": 3,
        "lateness_p50_s": 24e-6,
        "lateness_p99_s": 71e-6,
        "lateness_p999_s": 148e-6,
        "lateness_worst_s": 1.9e-3,
        "cost_p99_s": 182e-6,
        "lateness_edges_s": [1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3],
        "lateness_counts": [4210, 61_904, 109_877, 5902, 411, 29, 6, 2, 0],
        "notes": ["SCHED_FIFO 80", "memory locked", "no isolated CPU: expect late ticks"],
    },
}
HOMED = {"done": ["link", "motor1", "motor2"], "next_step": None, "instruction": ""}


def describe_fault(
    code: str,
    message: str,
    *,
    lane: int = 0,
    tick: int = 4200,
    values: dict[str, float] | None = None,
) -> dict[str, Any]:
    """Return a session's fault as the server reports it."""
    fault = Fault(code, lane, tick, tick / 1000, message, values or {})
    return build_session_fault(fault).model_dump(mode="json")


FAULT = describe_fault("quick_stop", "Stopped by a client at 4.20 s.", lane=1)
STOP = "quick-stop"
STATUS = {"run": "running", "ramp": "running", "fault": "fault"}


class PatchedBench:
    """Answers the page's bench calls and puts `bench` into every state that the page gets.

    fault: the fault of a bench whose status is "fault".
    """

    def __init__(self, page: Page, fault: dict[str, Any] | None = None, **change: Any) -> None:
        self.bench = copy.deepcopy(BENCH) | change
        self.calls: list[tuple[str, Any]] = []
        self.endurance: dict[str, Any] | None = None
        self._fault = fault
        self._version = 0
        self._stream: WebSocketRoute | None = None
        self.page = page
        page.route("**/api/v1/sessions/lab/**", self._answer)
        page.route_web_socket("**/api/v1/sessions/lab/stream**", self._patch_stream)

    @property
    def commands(self) -> list[str]:
        """Return the calls except those that only read, and a quick stop that is repeated."""
        calls = [call for call, _ in self.calls if call != "bench/endurance"]
        return [call for before, call in pairwise(["", *calls]) if not before == call == STOP]

    def become(self, fault: dict[str, Any] | None = None, **change: Any) -> None:
        """Become another bench in the same page, without earlier calls."""
        self.calls.clear()
        self._fault = fault
        self.change(**copy.deepcopy(BENCH) | change)

    def change(self, **change: Any) -> None:
        """Change the bench, and notify the page on its stream.

        With the lab's present state: the page ignores one that is older than another it knows.
        """
        self.bench |= change
        if self._stream is None:
            return
        address = self._stream.url.partition("/stream")[0].replace("ws", "http", 1)
        state = self._patch(self.page.request.get(address).json())
        self._stream.send(json.dumps({"type": "state", "state": state}))

    def drop(self) -> None:
        """Disconnect the page: it loses its stream, and no call is answered."""
        self.page.route("**/api/v1/**", lambda route: route.abort())
        self.page.route_web_socket("**/stream**", lambda socket: socket.close())
        if self._stream is not None:
            self._stream.close()

    def _patch(self, state: dict) -> dict:
        status = STATUS.get(self.bench["status"], "paused")
        fault = self._fault if self.bench["status"] == "fault" else None
        return state | {"bench": self.bench, "status": status, "fault": fault}

    def _patch_stream(self, socket: WebSocketRoute) -> None:
        server = socket.connect_to_server()
        self._stream = socket

        def forward(message: str | bytes) -> None:
            if isinstance(message, str):
                content = json.loads(message)
                if "state" in content:
                    content["state"] = self._patch(content["state"])
                message = json.dumps(content)
            socket.send(message)

        server.on_message(forward)

    def _answer(self, route: Route) -> None:
        call = route.request.url.rpartition("/sessions/lab/")[2]
        if call.startswith("stream"):
            route.continue_()
            return
        if call == "bench/endurance":
            self.calls.append((call, route.request.post_data_json))
            route.fulfill(json=self.endurance)
            return
        self.calls.append((call, route.request.post_data_json))
        step = {
            "bench/arm": {"status": "ready"},
            "bench/clear": {"status": "off"},
            "bench/home": {"homing": HOMED},
            "start": {"status": "run"},
            "pause": {"status": "ready"},
            STOP: {"status": "fault"},
        }.get(call)
        if call == STOP:
            self._fault = FAULT
        self.bench |= step or {}
        if step is None:
            answer = route.fetch()
            state = answer.json()
        else:
            state = route.fetch(url=route.request.url.rpartition("/lab/")[0] + "/lab", method="GET")
            state = state.json()
        route.fulfill(json=self._patch(state) if "status" in state else state)
