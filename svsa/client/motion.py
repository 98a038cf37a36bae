"""Start, pause and reset of a session."""

import time
from dataclasses import fields
from typing import Any, Literal

from svsa.client.lease import ControlledConnection
from svsa.errors import Fault, FaultError, StateError

MAX_STEP_TICKS = 10_000
POLL_S = 0.05


class RunningConnection(ControlledConnection):
    """A session whose time advances on command: a simulation, or a bench in real time."""

    __slots__ = ()

    @property
    def fault(self) -> Fault | None:
        """The fault that ended the run or stopped the bench."""
        return _read_fault(self.read_state())

    def start(self) -> None:
        """Start or continue the session."""
        self.call("POST", "/start")

    def pause(self) -> None:
        """Stop time; on a bench, ramp down."""
        self.call("POST", "/pause")

    def come_to_rest(self) -> None:
        """Pause, and on a bench wait until the ramp has ended."""
        self.pause()
        while self.read_state()["status"] == "running":
            time.sleep(POLL_S)

    def quick_stop(self) -> None:
        """Set zero current at once on a bench, latched until cleared; a simulation pauses."""
        self.call("POST", "/quick-stop")

    def reset(self) -> None:
        """Restart at t = 0 with the current settings."""
        self.call("POST", "/reset")

    def set_speed(self, speed: float | Literal["max"]) -> None:
        """Set the speed of the session.

        Args:
            speed: Session seconds per wall-clock second, or "max".
        """
        self.call("PUT", "/speed", {"speed": speed})

    def run_until(self, time_s: float) -> None:
        """Run to a session time: a paused simulation at full speed, a bench in real time.

        A bench at t = 0 is started, and continues to run afterwards.

        Args:
            time_s: Session time, s.

        Raises:
            FaultError: If the run ends in a fault before.
            StateError: If a bench is stopped before.
        """
        state = self.read_state()
        end = round(time_s * state["rate_hz"])
        if state["bench"] is not None:
            state = self._wait_for(state, end)
        while state["tick"] < end and state["fault"] is None:
            ticks = min(MAX_STEP_TICKS, end - state["tick"])
            state = self.call("POST", "/step", {"ticks": ticks})
        if fault := _read_fault(state):
            raise FaultError(fault)

    def _wait_for(self, state: dict[str, Any], end: int) -> dict[str, Any]:
        """Return the state of a bench once it has reached this tick, or has a fault."""
        if state["tick"] == 0 and end > 0 and state["status"] == "paused":
            state = self.call("POST", "/start")
        while state["tick"] < end and state["fault"] is None:
            if state["status"] != "running":
                raise StateError(
                    f"The bench of session {self.name} was stopped at {state['time_s']:.3f} s."
                )
            time.sleep(POLL_S)
            state = self.read_state()
        return state


def _read_fault(state: dict[str, Any]) -> Fault | None:
    """Read the fault from a session's state, without label and advice."""
    if (fault := state["fault"]) is None:
        return None
    return Fault(**{field.name: fault[field.name] for field in fields(Fault)})
