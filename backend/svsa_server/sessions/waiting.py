"""Commands that wait for a bench while the server serves other requests.

Sessions consist of plain functions: a command of a bench sends a request to its loop and lets time
pass until the answer. Such a function runs as a greenlet in the thread of the event loop, which
continues while the function lets time pass, as at an `await`. It runs in no other thread.
"""

import asyncio
import contextvars
import functools
import inspect
import time
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

from greenlet import getcurrent, greenlet

from svsa_server.routing import OwnedRoute

P = ParamSpec("P")
T = TypeVar("T")


class WaitingCall(greenlet):
    """A running function that yields to other tasks whenever it lets time pass."""


async def run_waiting(do: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
    """Run `do` and return its result; other tasks run while it lets time pass."""
    call = WaitingCall(do)
    # A greenlet starts with an empty context, which lacks the identity of the caller.
    call.gr_context = contextvars.copy_context()
    seconds = call.switch(*args, **kwargs)
    while not call.dead:
        try:
            await asyncio.sleep(seconds)
        except BaseException as error:
            # A cancelled request ends the function at its waiting point and runs its `finally`
            # blocks.
            seconds = call.throw(type(error), error, error.__traceback__)
        else:
            seconds = call.switch()
    return seconds


def pause(seconds: float) -> None:
    """Let time pass: within a `WaitingCall` other tasks run; elsewhere the thread sleeps."""
    call = getcurrent()
    if isinstance(call, WaitingCall) and call.parent is not None:
        call.parent.switch(seconds)
    else:
        time.sleep(seconds)


class WaitingRoute(OwnedRoute):
    """A route whose synchronous function runs as a `WaitingCall`: it may wait for a bench."""

    def __init__(self, path: str, endpoint: Callable[..., Any], **settings: Any) -> None:
        if not inspect.iscoroutinefunction(endpoint):
            endpoint = _build_waiting_call(endpoint)
        super().__init__(path, endpoint, **settings)


def _build_waiting_call(do: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(do)
    async def call(**arguments: Any) -> Any:
        return await run_waiting(do, **arguments)

    return call
