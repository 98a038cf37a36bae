"""The 3D views of the sessions: each begins when somebody looks and ends with its session."""

import asyncio
import logging
import time
from typing import TYPE_CHECKING

from svsa.runs.session.session import Session
from svsa_server.sessions.laboratory import SHARED_SESSION, Laboratory
from svsa_server.sessions.pose import read_pose

if TYPE_CHECKING:
    from svsa_server.scene.bridge import SceneBridge

UPDATE_PERIOD_S = 1.0 / 30.0
IDLE_S = 60.0

_log = logging.getLogger("svsa")


class View:
    """A session and its view; `seen` is when somebody last looked at it."""

    def __init__(self, session: Session, bridge: "SceneBridge") -> None:
        self.session, self.bridge, self.seen = session, bridge, time.monotonic()

    def update(self, now: float) -> None:
        """Nothing is read or sent while nobody watches, nor while there is no pose."""
        if not self.bridge.viewers:
            return
        self.seen = now
        pose = read_pose(self.session)
        if pose is not None:
            self.bridge.show(pose)

    def is_over(self, now: float) -> bool:
        """Whether it may go: its session has ended, or nobody has looked for a minute."""
        is_left = self.session.name != SHARED_SESSION and now - self.seen > IDLE_S
        return self.session.closed or is_left


class Scenes:
    """One viser for each session that somebody looks at; views: by the session's name."""

    def __init__(self, laboratory: Laboratory) -> None:
        self._laboratory = laboratory
        self.views: dict[str, View] = {}
        self._starting = asyncio.Lock()
        self._ending: set[asyncio.Task[None]] = set()

    async def open(self, name: str) -> int:
        """The loopback port of the session's viser, started where there is none.

        Raises `UnknownError` where there is no such session.
        """
        session = self._laboratory.get(name).session
        async with self._starting:
            if name not in self.views:
                self.views[name] = View(session, await asyncio.to_thread(_start_viser))
        view = self.views[name]
        view.seen = time.monotonic()
        return view.bridge.port

    async def run(self) -> None:
        """Show every session 30 times a second until cancelled."""
        while True:
            begin = time.monotonic()
            for name, view in list(self.views.items()):
                if view.is_over(begin):
                    self._end(name)
                else:
                    _update(view, begin)
            await asyncio.sleep(max(0.001, begin + UPDATE_PERIOD_S - time.monotonic()))

    def _end(self, name: str) -> None:
        """Stopping takes up to a second, which no other view waits for."""
        ending = asyncio.create_task(asyncio.to_thread(self.views.pop(name).bridge.stop))
        self._ending.add(ending)
        ending.add_done_callback(self._ending.discard)

    async def close(self) -> None:
        """End every view."""
        for name in list(self.views):
            self._end(name)
        await asyncio.gather(*self._ending, return_exceptions=True)


def _start_viser() -> "SceneBridge":
    """Loaded here, when somebody looks: it would be a quarter of a server's start."""
    from svsa_server.scene.bridge import SceneBridge

    return SceneBridge()


def _update(view: View, now: float) -> None:
    """An error in one view stops no other."""
    try:
        view.update(now)
    except Exception:
        _log.exception("The 3D view of session %s was not moved", view.session.name)
