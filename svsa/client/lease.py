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

        Args:
            by: Name that other users see; in a class it is replaced by the user of the token.
            take_over: Take control even if another client has it.
            wait_s: Maximum time in the queue of a class, s.

        Raises:
            ControlError: If another client is in control and `take_over` is false, or if the wait
                in the queue exceeds `wait_s`; the script then leaves the queue.
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
        """Pass control to a user in the queue.

        Args:
            to: A name in `waiting`.

        Raises:
            ParameterError: If no user of this name is in the queue.
        """
        ids = {client["name"]: client["id"] for client in self._read_waiting()}
        if to not in ids:
            raise ParameterError(
                Violation("to", to, "", "one of " + (", ".join(ids) or "none: the queue is empty"))
            )
        self.call("POST", "/control/handover", {"to": ids[to]})

    @property
    def waiting(self) -> tuple[str, ...]:
        """The queue for control in a class, the next user first."""
        return tuple(client["name"] for client in self._read_waiting())

    def _read_waiting(self) -> list[dict[str, str]]:
        queue = self.read_state()["queue"]
        return queue["waiting"] if queue else []

    def give_control_back(self) -> None:
        """Release control: to the next in the queue of a class; without control, leave the
        queue.
        """
        self.call("DELETE", "/control")
