"""Control of a class's shared session: one operator at a time, and a queue.

A request while the lease is free succeeds; later ones wait in their order. Control passes to the
first of them when its holder releases it, passes it, is gone, or has given no command for a while;
an idle holder keeps it while the queue is empty. The instructor can take it from any holder, who is
then first in the queue, and can lock it. Pure functions: all times are arguments, monotonic, s.
"""

from collections.abc import Callable

from svsa.errors import StateError
from svsa_server.leases.lease import ControlLease, EndedLease, HeldError, Holder


class ControlQueue(ControlLease):
    """The lease of a class's session.

    Attributes:
        waiting: The queue, the next user first.
        is_instructor: Whether a client is an instructor, who may command also while control is
            free.
        idle_s: Time without a command after which a holder loses control while others wait, s.
    """

    rests_when_free = True

    def __init__(self, session: str, is_instructor: Callable[[str], bool], idle_s: float) -> None:
        super().__init__(session)
        self.waiting: list[Holder] = []
        self.is_locked = False
        self.idle_s = idle_s
        self._is_instructor = is_instructor
        self._acted = 0.0
        self._waiting_heard: dict[str, float] = {}

    def admits(self, client: str | None) -> bool:
        """Whether this client may command: as the holder, or as an instructor while it is free."""
        if self.holder is None:
            return client is not None and self._is_instructor(client)
        return self.is_held_by(client)

    def check(self, client: str | None) -> None:
        """Raise `HeldError`, which names the holder, unless this client may command."""
        if self.admits(client):
            return
        if self.is_locked and self.holder is None:
            raise HeldError(f"The instructor has locked control of session {self._session}.")
        who = self.holder.name if self.holder else "No user"
        raise HeldError(
            f"{who} is in control of session {self._session}: request control, and wait for your"
            " turn."
        )

    def take(self, holder: Holder, take_over: bool, now: float) -> None:
        """Join the queue, or take the lease at once with `take_over` (instructor only)."""
        if take_over:
            if not self._is_instructor(holder.client):
                raise HeldError(
                    "Only the instructor may take control from another user: request it instead."
                )
            self._leave_queue(holder.client)
            self._set_aside()
            self._give(holder, now)
        elif not self.is_held_by(holder.client) and self.find_place(holder.client) is None:
            self.waiting.append(holder)
            self._waiting_heard[holder.client] = now
            self._pass_control(now)

    def give_back(self, client: str | None, now: float) -> None:
        """Pass the lease to the next user, or leave the queue; no effect for other clients."""
        self._leave_queue(client)
        if self.is_held_by(client):
            self.holder = None
            self._pass_control(now)

    def hand_over(self, client: str | None, to: str, now: float) -> None:
        """Pass the lease to a user in the queue.

        Raises:
            HeldError: If another client is in control.
            StateError: If the user is not in the queue.
        """
        if not self.is_held_by(client) and not (client and self._is_instructor(client)):
            self.check(client)
        chosen = next((user for user in self.waiting if user.client == to), None)
        if chosen is None:
            raise StateError(
                "Control can be passed only to a user in the queue; this one is not in it."
            )
        self.is_locked = False
        self._leave_queue(to)
        self._give(chosen, now)

    def lock(self, is_locked: bool, now: float) -> None:
        """Lock control for the instructor; after unlocking, the previous holder is first."""
        self.is_locked = is_locked
        if is_locked and self.holder is not None and not self._is_instructor(self.holder.client):
            self._set_aside()
        self._pass_control(now)

    def find_place(self, client: str | None) -> int | None:
        """Return the place in the queue, 1 is next; None if the user is not in it."""
        places = (place for place, user in enumerate(self.waiting, 1) if user.client == client)
        return next(places, None)

    def hear(self, client: str | None, now: float) -> None:
        """Note a request or an open stream of a user."""
        super().hear(client, now)
        if client in self._waiting_heard:
            self._waiting_heard[client] = now

    def note_command(self, client: str | None, now: float) -> None:
        """Note a command of the holder."""
        if self.is_held_by(client):
            self._acted = now

    def settle(self, now: float, patience_s: float) -> list[EndedLease]:
        """End the lease of a holder who is gone, or idle while others wait; return the holder."""
        gone = [
            user for user in self.waiting if now - self._waiting_heard[user.client] > patience_s
        ]
        for user in gone:
            self._leave_queue(user.client)
        settled = [EndedLease(user, "gone_from_queue") for user in gone]
        settled += super().settle(now, patience_s)
        is_idle = now - self._acted > self.idle_s
        if self.holder is not None and is_idle and self.waiting and not self.is_locked:
            settled.append(EndedLease(self.holder, "idle"))
            self.holder = None
        self._pass_control(now)
        return settled

    def _set_aside(self) -> None:
        """Take the lease from its holder, who gets it back first."""
        if self.holder is not None:
            self.waiting.insert(0, self.holder)
            self._waiting_heard[self.holder.client] = self._heard
            self.holder = None

    def _leave_queue(self, client: str | None) -> None:
        self.waiting = [user for user in self.waiting if user.client != client]
        if client is not None:
            self._waiting_heard.pop(client, None)

    def _pass_control(self, now: float) -> None:
        if self.holder is None and self.waiting and not self.is_locked:
            first = self.waiting[0]
            self._leave_queue(first.client)
            self._give(first, now)

    def _give(self, holder: Holder, now: float) -> None:
        self.holder = holder
        self._heard = self._acted = now
