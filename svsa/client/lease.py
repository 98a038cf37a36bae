"""The control lease of a session: take, wait, hand over, release."""

import time

from svsa.client.connection import ControlError, SessionConnection
from svsa.errors import ParameterError, Violation

WAIT_S = 0.5


class ControlledConnection(SessionConnection):
    """A session with a control lease."""

    __slots__ = ()

    def take_control(
        self, by: str = "A script", take_over: bool = False, wait_s: float = 600.0
    ) -> None:
        """Take control: only this script may command; every client may pause and stop.

        by: Name that other users see; in a class it is the person whose token the script has.
        Raises `ControlError` where another client is in control, unless `take_over`; in a class,
        where it is not this script's turn within `wait_s`, and then it waits no longer.
        """
        state = self.call("PUT", "/control", {"by": by, "take_over": take_over})
        until = time.monotonic() + wait_s
        while not state["control"]["mine"]:
            if time.monotonic() > until:
                place = state["queue"] and state["queue"]["place"]
                self.give_control_back()
                raise ControlError(
                    f"{state['control']['holder'] or 'No user'} is in control of session"
                    f" {self.name}: place {place} in the queue after {wait_s:g} s."
                )
            time.sleep(WAIT_S)
            state = self.read_state()

    def hand_control_over(self, to: str) -> None:
        """Pass control to a name in `waiting`; raises `ParameterError` for another."""
        ids = {one["name"]: one["id"] for one in self._read_waiting()}
        if to not in ids:
            raise ParameterError(
                Violation("to", to, "", "one of " + (", ".join(ids) or "none: the queue is empty"))
            )
        self.call("POST", "/control/handover", {"to": ids[to]})

    @property
    def waiting(self) -> tuple[str, ...]:
        """The queue for control in a class, the next user first."""
        return tuple(one["name"] for one in self._read_waiting())

    def _read_waiting(self) -> list[dict[str, str]]:
        queue = self.read_state()["queue"]
        return queue["waiting"] if queue else []

    def give_control_back(self) -> None:
        """Release control: to the next in the queue of a class; without control, leave the
        queue.
        """
        self.call("DELETE", "/control")
