"""The 3D views of the sessions; each starts with its first viewer."""

import asyncio
import logging
import time
from typing import TYPE_CHECKING

from svsa.runs.session.session import Session
from svsa_server.scene.poses import read_pose
from svsa_server.sessions.laboratory import SHARED_SESSION, Laboratory

if TYPE_CHECKING:
    from svsa_server.scene.bridge import SceneBridge

UPDATE_PERIOD_S = 1.0 / 30.0
IDLE_S = 60.0

_log = logging.getLogger("svsa")


class View:
    """A session and its view; `seen` is when it last had a viewer."""

    def __init__(self, session: Session, bridge: "SceneBridge") -> None:
        self.session, self.bridge, self.seen = session, bridge, time.monotonic()

    def update(self, now: float) -> None:
        """Send the current pose; nothing without a viewer or a pose."""
        if not self.bridge.viewers:
            return
        self.seen = now
        pose = read_pose(self.session)
        if pose is not None:
            self.bridge.show(pose)

    def is_over(self, now: float) -> bool:
        """Whether the view ends: its session has ended, or it had no viewer for a minute."""
        is_left = not self.bridge.viewers and now - self.seen > IDLE_S
        return self.session.closed or (is_left and self.session.name != SHARED_SESSION)


class Scenes:
    """One viser for each session that has a viewer; views: by the session's name."""

    def __init__(self, laboratory: Laboratory) -> None:
        self._laboratory = laboratory
        self.views: dict[str, View] = {}
        self._is_viewed = asyncio.Event()
        self._starting = asyncio.Lock()
        self._ending: set[asyncio.Task[None]] = set()

    async def open(self, name: str) -> int:
        """Return the loopback port of the session's viser, started if there is none.

        Raises:
            UnknownError: If there is no such session.
        """
        session = self._laboratory.get(name).session
        async with self._starting:
            if name not in self.views:
                # Under the lock, so that two simultaneous viewers do not start two servers for one
                # session.
                self.views[name] = View(session, await asyncio.to_thread(_start_viser, session))
        view = self.views[name]
        self._is_viewed.set()
        view.seen = time.monotonic()
        return view.bridge.port

    async def run(self) -> None:
        """Update every view 30 times a second until cancelled; without views, wait for one."""
        while True:
            await self._is_viewed.wait()
            begin = time.monotonic()
            for name, view in list(self.views.items()):
                if view.is_over(begin):
                    self._end(name)
                else:
                    _update(view, begin)
            if not self.views:
                self._is_viewed.clear()
            await asyncio.sleep(max(0.001, begin + UPDATE_PERIOD_S - time.monotonic()))

    def _end(self, name: str) -> None:
        """End a view in the background; it takes up to a second."""
        ending = asyncio.create_task(asyncio.to_thread(self.views.pop(name).bridge.stop))
        self._ending.add(ending)
        ending.add_done_callback(self._ending.discard)

    async def close(self) -> None:
        """End every view."""
        for name in list(self.views):
            self._end(name)
        await asyncio.gather(*self._ending, return_exceptions=True)


def _start_viser(session: Session) -> "SceneBridge":
    """Start viser; imported here, at the first viewer: it is a quarter of a server's start."""
    from svsa_server.scene.bridge import SceneBridge

    return SceneBridge(session.run.configuration)


def _update(view: View, now: float) -> None:
    """Update a view; an error in one does not stop the others."""
    try:
        view.update(now)
    except Exception:
        _log.exception("The 3D view of session %s was not moved", view.session.name)
