"""The commands of a bench, from a script."""

from typing import Any, Literal

from svsa.client.connection import Remote, SessionConnection


class RemoteBench(Remote):
    """Commands of a bench; a simulated session raises `StateError`."""

    __slots__ = ("_session",)

    def __init__(self, session: SessionConnection) -> None:
        self._session = session

    @property
    def state(self) -> dict[str, Any] | None:
        """State of the bench; None for a simulated session."""
        return self._session.read_state()["bench"]

    def arm(self) -> None:
        """Reset the drives and bring them to current mode."""
        self._session.call("POST", "/bench/arm")

    def confirm_home(self, step: Literal["link", "motor1", "motor2"], by: str) -> None:
        """Confirm that an axis is at its zero mark; `by` is the name of the observer."""
        self._session.call("POST", "/bench/home", {"step": step, "by": by})

    def clear(self) -> None:
        """Clear a latched fault; it must be armed again."""
        self._session.call("POST", "/bench/clear")

    def restart(self) -> None:
        """Restart loop and supervisor."""
        self._session.call("POST", "/bench/restart")
