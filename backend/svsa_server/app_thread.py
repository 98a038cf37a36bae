"""An ASGI application in a separate thread and event loop.

Sessions compute in the event loop that serves them, so that they do not change while a route reads
them. A session that blocks this event loop does not block the other one: the event loop of the
connections runs in the main thread, and can still answer and end the server.
"""

import asyncio
import contextlib
import threading
import time
from collections.abc import Coroutine
from concurrent.futures import Future
from typing import Any, TypeVar

from starlette.types import ASGIApp, Message, Receive, Scope, Send

T = TypeVar("T")

BEAT_S = 0.1
MAX_BEGINNING = 2
"""Calls that begin in the application at once: no more than these are before a stop."""
STOP_S = 2.0
"""Time in which the thread cancels the remaining tasks and ends, s."""


class CallBridge:
    """The messages of one call of the application, passed from one event loop to the other.

    Created in the event loop of the connection. `has_answered`: whether a message was sent to the
    client.

    Args:
        receive: Receives from the connection.
        send: Sends to the connection.
    """

    def __init__(self, receive: Receive, send: Send) -> None:
        self._receive, self._send = receive, send
        self._outer = asyncio.get_running_loop()
        self._is_over = self.has_answered = False
        self._sending: Future[None] | None = None
        self._start: Message | None = None

    def end(self) -> None:
        """Stop passing messages: another answer replaces that of the application."""
        self._is_over = True

    async def receive(self) -> Message:
        """Return the next message of the client; called by the application."""
        return await asyncio.wrap_future(self._cross(self._receive_outside()))

    async def send(self, message: Message) -> None:
        """Send a message to the client after the previous one was accepted; called by the
        application.

        Waiting for this message, too, would wake the event loop of the application for every
        message.
        """
        await self.finish()
        self._sending = self._cross(self._send_outside(message))

    async def finish(self) -> None:
        """Wait until the last message was taken; raises what its `send` raises."""
        if self._sending is not None:
            sending, self._sending = self._sending, None
            # Usually already done; then no event loop has to wake up. With 20 streams at 30
            # messages per second the server uses 0.11 of a core instead of 0.14.
            if sending.done():
                sending.result()
            else:
                await asyncio.wrap_future(sending)

    def _cross(self, call: Coroutine[Any, Any, T]) -> Future[T]:
        return asyncio.run_coroutine_threadsafe(call, self._outer)

    async def _receive_outside(self) -> Message:
        return {"type": "http.disconnect"} if self._is_over else await self._receive()

    async def _send_outside(self, message: Message) -> None:
        if self._is_over:
            return
        if message["type"] == "http.response.start":
            # Delayed until the body arrives: if sessions blocked in between, an answer that has
            # started could not be replaced by an error.
            self._start = message
            return
        self.has_answered = True
        if self._start is not None:
            start, self._start = self._start, None
            await self._send(start)
        await self._send(message)


class AppThread:
    """Runs an ASGI application from `start` until `stop`."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._loop = asyncio.new_event_loop()
        self._beat_s = time.monotonic()
        self._places = asyncio.Semaphore(MAX_BEGINNING)
        self._thread = threading.Thread(target=self._run, name="sessions", daemon=True)

    @property
    def silence_s(self) -> float:
        """Time since the event loop of the application last ran, s; up to `BEAT_S` when idle."""
        return time.monotonic() - self._beat_s

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()

    async def wait_for_place(self, longest_s: float) -> None:
        """Wait until few calls begin in the application, or it has been silent for `longest_s` s.

        A call has begun, and its place is free, when it waits for the first time.
        """
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(max(0.0, longest_s - self.silence_s)):
                await self._places.acquire()
            outer = asyncio.get_running_loop()

            def free() -> None:
                outer.call_soon_threadsafe(self._places.release)

            def add() -> None:
                self._loop.call_soon(free)

            # `call` follows at once: its event loop adds the first step of the call, then `free`.
            outer.call_soon(lambda: self._loop.call_soon_threadsafe(add))

    def call(self, scope: Scope, bridge: CallBridge) -> asyncio.Future[None]:
        """Call the application in its event loop; cancelling the future cancels the call."""
        call = self._call(scope, bridge)
        return asyncio.wrap_future(asyncio.run_coroutine_threadsafe(call, self._loop))

    async def _call(self, scope: Scope, bridge: CallBridge) -> None:
        await self._app(scope, bridge.receive, bridge.send)
        await bridge.finish()

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        self._beat()
        self._loop.run_forever()

    def _beat(self) -> None:
        # The other event loop only reads this number, so it needs no answer of a loop that may be
        # blocked.
        self._beat_s = time.monotonic()
        self._loop.call_later(BEAT_S, self._beat)

    async def stop(self) -> None:
        """Cancel the remaining calls, and end the thread within `STOP_S`."""
        left = asyncio.run_coroutine_threadsafe(_cancel_others(), self._loop)
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(asyncio.wrap_future(left), STOP_S)
        self._loop.call_soon_threadsafe(self._loop.stop)
        await asyncio.to_thread(self._thread.join, STOP_S)


async def _cancel_others() -> None:
    others = asyncio.all_tasks() - {asyncio.current_task()}
    for task in others:
        task.cancel()
    await asyncio.gather(*others, return_exceptions=True)
