"""The server around the application: it answers and ends even if a session blocks.

While the sessions respond, every call is passed to them. If they do not respond, this event loop
answers: health and the quick stop almost at once, everything else with 503.
"""

import asyncio
import logging
import math
import time

from fastapi import FastAPI
from fastapi.responses import JSONResponse, Response
from starlette.types import Message, Receive, Scope, Send

import svsa
from svsa.hardware.session.session import BenchSession
from svsa.runs.session.session import Session
from svsa_server.access.admission import HEALTH
from svsa_server.access.guard import AccessGuard, find_path
from svsa_server.access.owned import Kind, Owner
from svsa_server.access.rates import is_stop
from svsa_server.app_thread import AppThread, CallBridge
from svsa_server.problems import answer_problem
from svsa_server.routing import API
from svsa_server.schemas.lab.lab import Health
from svsa_server.sessions.laboratory import SHARED_SESSION

POLL_S = 0.1
STOP_SILENT_S = 0.5
"""Time for which health and the quick stop wait for sessions that do not respond, s."""
SILENT_S = 10.0
"""The same for every other request, s: compiling a law blocks the sessions for seconds."""
END_SILENT_S = 5.0
LONGEST_END_S = 60.0
"""Time after which the server ends even if its sessions are not closed, s."""

_LAB_STOP = f"{API}/quick-stop"
_STOPS = {_LAB_STOP, f"{API}/sessions/{SHARED_SESSION}/quick-stop"}
_log = logging.getLogger("svsa")


class ResponsiveApp:
    """The application of a lab in a separate thread, with fallback answers.

    `is_stuck`: whether the server has ended without closing its sessions, because they did not
    respond.

    Args:
        app: The lab, from `build_app`.
        shared: Its shared session; the quick stop reaches a bench through shared memory.
    """

    def __init__(self, app: FastAPI, shared: Session) -> None:
        self._thread, self._shared = AppThread(app), shared
        self._guard = AccessGuard(
            self._answer,
            app.state.authentication,
            app.state.permissions,
            app.state.config.host_names,
            _find_owner,
        )
        self.is_stuck = False

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one call of the ASGI server."""
        serve = self._live if scope["type"] == "lifespan" else self._serve
        await serve(scope, receive, send)

    async def _serve(self, scope: Scope, receive: Receive, send: Send) -> None:
        if not is_stop(scope.get("method", ""), find_path(scope)):
            await self._thread.wait_for_place(SILENT_S)
        bridge = CallBridge(receive, send)
        asked = self._thread.call(scope, bridge)
        longest_s = STOP_SILENT_S if _is_urgent(scope) else SILENT_S
        try:
            while not asked.done():
                await asyncio.wait({asked}, timeout=POLL_S)
                # An answer that has started cannot be replaced by another one; a stream can be
                # closed at any time.
                is_stream = scope["type"] == "websocket"
                is_silent = self._thread.silence_s > longest_s
                if is_silent and not asked.done() and (is_stream or not bridge.has_answered):
                    break
        except asyncio.CancelledError:
            asked.cancel()
            raise
        if asked.done():
            asked.result()
            return
        bridge.end()
        if bridge.has_answered:
            asked.cancel()
            await send({"type": "websocket.close", "code": 1013, "reason": "not responding"})
        elif _is_urgent(scope):
            # Answered here and not in the application, so the guard must be applied here, too.
            await self._guard(scope, receive, send)
        else:
            await self._answer(scope, receive, send)

    async def _answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        await self._choose_answer(find_path(scope))(scope, receive, send)

    def _choose_answer(self, path: str) -> Response:
        silent_s = self._thread.silence_s
        if path == HEALTH:
            health = Health(version=svsa.__version__, sessions_silent_s=round(silent_s, 1))
            return JSONResponse(health.model_dump(mode="json"))
        detail = (
            f"The sessions of this lab have not responded for {silent_s:.1f} s: one of them blocks"
            " all others. It is not known whether the request has an effect. Restart the server"
            " if this persists."
        )
        if path in _STOPS and isinstance(self._shared, BenchSession):
            # Through shared memory, which works without the thread of the sessions.
            self._shared.stop_from_keyboard()
            _log.warning("A quick stop was passed to the loop of the bench. %s", detail)
            if path == _LAB_STOP:
                return Response(status_code=204)
            detail = f"The quick stop was passed to the loop of the bench. {detail}"
        headers = {"Retry-After": str(math.ceil(SILENT_S))}
        return answer_problem(503, "silent", detail, headers)

    async def _live(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Start the application; end it within `LONGEST_END_S`, even if it is blocked."""
        ending_s = math.inf

        async def receive_ending() -> Message:
            nonlocal ending_s
            message = await receive()
            if message["type"] == "lifespan.shutdown":
                ending_s = time.monotonic()
            return message

        self._thread.start()
        lived = self._thread.call(scope, CallBridge(receive_ending, send))
        while not lived.done():
            await asyncio.wait({lived}, timeout=POLL_S)
            ends_for_s = time.monotonic() - ending_s
            is_silent = ends_for_s > 0.0 and self._thread.silence_s > END_SILENT_S
            if not lived.done() and (is_silent or ends_for_s > LONGEST_END_S):
                self.is_stuck = True
                message = (
                    "The server ends without closing its sessions: they have not responded for"
                    f" {self._thread.silence_s:.1f} s. A bench ramps to zero torque."
                )
                await send({"type": "lifespan.shutdown.failed", "message": message})
                return
        lived.result()
        await self._thread.stop()


def _is_urgent(scope: Scope) -> bool:
    """Whether the application gets only a short time: for health and the quick stop."""
    path, method = find_path(scope), scope.get("method")
    if path == HEALTH:
        return method in ("GET", "HEAD")
    return method == "POST" and path in _STOPS


async def _find_owner(scope: Scope, kind: Kind, name: str) -> Owner:
    """Return the owner for a quick stop: of the shared session, which all users see."""
    return Owner("", is_shown=True)
