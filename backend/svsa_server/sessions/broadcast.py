"""Messages of a session to its streams; equal messages are built once.

The past is sent once: a message contains it only from the tick up to which its stream knows it, so
that its size does not depend on the number of earlier changes.
"""

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from svsa_server.runs.lanes import list_kept_segments
from svsa_server.schemas.lab.session import SessionProgress
from svsa_server.schemas.lab.stream import StateMessage
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.state import build_control, build_progress, build_queue, build_state

FRESH_S = 3.0


@dataclass(frozen=True, eq=False)
class SentPast:
    """The past that a stream has received: run, lanes and names."""

    run_number: int
    tick: int
    lane_ids: tuple[int, ...]
    names: Mapping[int, str]

    @classmethod
    def all_of(cls, hosted: HostedSession) -> "SentPast":
        """Return the past of a session up to now: run, lanes and names."""
        session = hosted.session
        timeline = session.journal.timeline
        names = timeline.name_segments(list_kept_segments(session))
        lane_ids = tuple(timeline.lane_ids)
        return cls(session.journal.run_number, session.run.tick, lane_ids, names)

    def find_since(self, now: "SentPast") -> int:
        """Return the tick from which the past has to be sent; 0, all of it, if it has changed."""
        if (self.run_number, self.lane_ids) != (now.run_number, now.lane_ids):
            return 0
        if self.names is not now.names and any(
            now.names.get(number, name) != name for number, name in self.names.items()
        ):
            return 0
        return self.tick


class Broadcast(NamedTuple):
    """A message, and what its client has received with it."""

    text: str
    sent: SentPast


def write_broadcast(hosted: HostedSession, sent: SentPast) -> Broadcast:
    """Build the message after a change, once for all clients that need the same.

    Its continuous values are those at the time of the first client.
    """
    control, queue = build_control(hosted), build_queue(hosted.lease)
    key = (sent, control.mine, queue and queue.place)
    return hosted.broadcast.get(hosted.version, key, lambda: _write(hosted, sent, build_state))


def write_progress(hosted: HostedSession, sent: SentPast, period: Hashable) -> Broadcast:
    """Build the continuous values for an up-to-date stream, once in each period."""
    version = (hosted.version, period)
    return hosted.progress.get(version, sent, lambda: _write(hosted, sent, build_progress))


def is_fresh(hosted: HostedSession) -> bool:
    """Return whether the window started less than `FRESH_S` ago: its metrics change quickly."""
    run, window = hosted.session.run, hosted.session.journal.timeline.window
    return (run.tick - window.first_tick) * run.period_s < FRESH_S


def _write(
    hosted: HostedSession,
    sent: SentPast,
    build: Callable[[HostedSession, int], SessionProgress],
) -> Broadcast:
    version = (hosted.version, hosted.session.run.tick)
    now = hosted.past.get(version, None, lambda: SentPast.all_of(hosted))
    since = sent.find_since(now)
    message = StateMessage(since_tick=since, state=build(hosted, since))
    return Broadcast(message.model_dump_json(), now)
