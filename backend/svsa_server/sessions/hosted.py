"""A session with the server's own data: control lease, open streams, last use."""

import asyncio
import contextlib
import math
import secrets
import time
from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from svsa.errors import StateError
from svsa.runs.definition.configuration import Configuration
from svsa.runs.session.session import Session
from svsa_server.access.audit import AuditLog
from svsa_server.leases.lease import ControlLease, EndedLease, Holder
from svsa_server.leases.queue import ControlQueue
from svsa_server.sessions.cursor import Versioned
from svsa_server.sessions.excitation import Excitation, check_excitable


class Round:
    """A wake-up of the streams: all of them send right after the session was woken.

    `number`: number of wake-ups.
    """

    def __init__(self) -> None:
        self._begun = asyncio.Event()
        self.number = 0

    def begin(self) -> None:
        """Wake every waiting stream."""
        self.number += 1
        # `set` wakes all waiting tasks; after `clear` the next ones wait for the next round.
        self._begun.set()
        self._begun.clear()

    def end(self) -> None:
        """Wake the streams for the last time, also a stream that waits only later."""
        self.number += 1
        self._begun.set()

    async def wait(self) -> None:
        """Wait until the next wake-up; return at once after the last."""
        await self._begun.wait()


class BeforeExercise(NamedTuple):
    """The settings before an exercise, whether the session ran, and the exercise's name."""

    configuration: Configuration
    was_running: bool
    exercise: str


class HostedSession:
    """A session with the server's own data. Times are monotonic, s.

    Attributes:
        session: The session.
        lease: Its control lease.
        excitation: The excitation in progress, or None.
        last_use: Time of the last request; infinite for a session that does not end when idle.
        owner: Id of its user; empty for all users.
        note: Message for the user for whom it was opened.
        instance: Unique among all sessions, also of the same name.
        before_exercise: Settings that an exercise replaced, or None.

    `broadcast`, `progress`, `reported` and `batches` are messages to its streams in each `round`,
    built once for all. `log_ended_lease` is called when the lease ends without a request of its
    holder.
    """

    def __init__(
        self,
        session: Session,
        last_use: float = math.inf,
        owner: str = "",
        lease: ControlLease | None = None,
        log_ended_lease: "LogEndedLease" = lambda hosted, settled: None,
    ) -> None:
        self.session, self.owner, self.note = session, owner, ""
        self.instance = secrets.token_hex(4)
        self._note_settled = log_ended_lease
        self.lease = lease or ControlLease(session.name)
        self.excitation: Excitation | None = None
        self.before_exercise: BeforeExercise | None = None
        self.last_use = last_use
        self.broadcast, self.progress, self.past = (
            Versioned[Any](),
            Versioned[Any](),
            Versioned[Any](),
        )
        self.batches = Versioned[bytes]()
        self.round = Round()
        self._streams: Counter[str | None] = Counter()
        self._changes = 0
        self._playing: asyncio.Task[None] | None = None

    @property
    def version(self) -> int:
        """A number that grows with every change of the session or of the server's data of it."""
        return self.session.version + self._changes

    @property
    def revision(self) -> str:
        """A tag that changes with settings or loads, for `If-Match`.

        It is unique among all sessions, also of the same name after a restart of the server.
        """
        journal = self.session.journal
        return f"{self.instance}.{journal.run_number}.{len(journal.commands)}"

    def close(self) -> None:
        """End the session permanently, and wake its streams."""
        self.session.close()
        self.round.end()

    @property
    def streams(self) -> int:
        """Number of open streams."""
        return self._streams.total()

    def touch(self) -> None:
        """Note a request."""
        self.last_use = max(self.last_use, time.monotonic())

    def is_idle(self, now: float, idle_s: float) -> bool:
        """Return whether the session was unused for longer than `idle_s`, s."""
        return not self.streams and now - self.last_use > idle_s

    @contextlib.contextmanager
    def streamed_to(self, client: str | None) -> Iterator[None]:
        """Count a stream of this client as open within the context."""
        self._count_stream(client, 1)
        try:
            yield
        finally:
            self._count_stream(client, -1)

    def _count_stream(self, client: str | None, change: int) -> None:
        self._streams[client] += change
        if not self._streams[client]:
            del self._streams[client]
        self.session.watched = self.streams > 0
        self._changes += 1
        self.touch()

    def read_instant(self) -> dict[str, int | str | None]:
        """Return the current run and tick, and the client in control."""
        holder = self.lease.holder
        return {
            "run": self.session.journal.run_number,
            "tick": self.session.run.tick,
            "in_control": holder.client if holder else None,
        }

    def list_viewers(self) -> set[str]:
        """List the clients with an open stream that send an id."""
        return {client for client in self._streams if client is not None}

    def take_control(self, holder: Holder, take_over: bool) -> None:
        """Give this holder the control lease now; see `ControlLease.take`."""
        with self._changing_lease():
            self.lease.take(holder, take_over, time.monotonic())

    def give_control_back(self, client: str | None) -> None:
        """Return the control lease of a client; see `ControlLease.give_back`."""
        with self._changing_lease():
            self.lease.give_back(client, time.monotonic())

    def hand_control_over(self, client: str | None, to: str) -> None:
        """Pass the control lease to a user in the queue; see `ControlQueue.hand_over`.

        Raises:
            StateError: If there is no queue.
        """
        with self._changing_lease():
            self.find_queue().hand_over(client, to, time.monotonic())

    def lock_control(self, is_locked: bool) -> None:
        """Lock or unlock the control lease; see `ControlQueue.lock`.

        Raises:
            StateError: If there is no queue.
        """
        with self._changing_lease():
            self.find_queue().lock(is_locked, time.monotonic())

    def find_queue(self) -> ControlQueue:
        """Return the queue of a class's session.

        Raises:
            StateError: If it has none.
        """
        if not isinstance(self.lease, ControlQueue):
            raise StateError(f"The queue for control of session {self.session.name} is empty.")
        return self.lease

    def release_if_left(self, now: float, patience_s: float) -> None:
        """Release the lease of a holder that, without an open stream, is silent for patience_s."""
        for client in self.list_viewers():
            self.lease.hear(client, now)
        holder = self.lease.holder
        settled = self.lease.settle(now, patience_s)
        if settled:
            self._changes += 1
            self._rest_after(holder)
        for ended in settled:
            self._note_settled(self, ended)

    def release_lease_of(self, client: str) -> None:
        """Remove a client that has left the class from lease and queue."""
        if self.lease.is_held_by(client) or isinstance(self.lease, ControlQueue):
            self.give_control_back(client)

    @contextlib.contextmanager
    def _changing_lease(self) -> Iterator[None]:
        holder = self.lease.holder
        yield
        self._changes += 1
        self._rest_after(holder)

    def _rest_after(self, before: Holder | None) -> None:
        """Ramp a bench down before its lease passes on; it does not start before it is at rest."""
        now = self.lease.holder
        if before is None or (now is not None and now.client == before.client):
            return
        if now is None and not self.lease.rests_when_free:
            return
        if self.session.plant != "simulated" and self.session.status == "running":
            self.session.halt("control was handed over")

    def keep_before_exercise(self, before: BeforeExercise | None) -> None:
        """Store the settings to restore after an exercise; None: there is no exercise."""
        self.before_exercise = before
        self._changes += 1

    def check_excitable(self) -> None:
        """Raise `StateError` if the excitation could not be used for an identification."""
        if self.excitation is not None:
            raise StateError("The excitation is already being played.")
        check_excitable(self.session)

    def begin_excitation(self) -> None:
        """Play the excitation in the background; the session runs and is recorded."""
        self.excitation = Excitation(self.session)
        self._changes += 1
        self._playing = asyncio.get_running_loop().create_task(self._play(self.excitation))

    async def _play(self, excitation: Excitation) -> None:
        await excitation.play()
        if self.excitation is excitation:
            self.end_excitation()

    def end_excitation(self) -> None:
        """Interrupt the excitation; the recording ends, the references stay."""
        if self.excitation is not None:
            self.excitation.is_interrupted, self.excitation = True, None
            self.session.stop_recording()
            self._changes += 1


LogEndedLease = Callable[[HostedSession, EndedLease], None]


def log_ended_lease(log: AuditLog, hosted: HostedSession, settled: EndedLease) -> None:
    """Log the holder and the reason of an ended lease, its tick, and the current holder."""
    log.write(
        event="control",
        why=settled.why,
        person=settled.who.client,
        name=settled.who.name,
        session=hosted.session.name,
        **hosted.read_instant(),
    )
