"""Commands that wait for a bench while the server serves other requests.

A session is plain functions: a command of a bench asks its loop and lets time pass until it
answers. Taken as a turn, such a function runs as a greenlet on the event loop's own thread, and
where it lets time pass the event loop goes on, as at an `await`. It runs in no other thread.
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


class Turn(greenlet):
    """A running function that yields to other tasks whenever it lets time pass."""


async def take_turn(do: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
    """Run `do` and return its result; other tasks run while it lets time pass."""
    turn = Turn(do)
    # A greenlet begins with an empty context, in which the caller of the request is missing.
    turn.gr_context = contextvars.copy_context()
    seconds = turn.switch(*args, **kwargs)
    while not turn.dead:
        try:
            await asyncio.sleep(seconds)
        except BaseException as error:
            # A cancelled request ends the function where it waits, with its `finally` blocks.
            seconds = turn.throw(type(error), error, error.__traceback__)
        else:
            seconds = turn.switch()
    return seconds


def let_pass(seconds: float) -> None:
    """Let time pass: within a turn other tasks run; elsewhere the thread sleeps."""
    turn = getcurrent()
    if isinstance(turn, Turn) and turn.parent is not None:
        turn.parent.switch(seconds)
    else:
        time.sleep(seconds)


class TurnRoute(OwnedRoute):
    """A route whose synchronous function runs as a turn: it may wait for a bench."""

    def __init__(self, path: str, endpoint: Callable[..., Any], **settings: Any) -> None:
        if not inspect.iscoroutinefunction(endpoint):
            endpoint = _build_turn(endpoint)
        super().__init__(path, endpoint, **settings)


def _build_turn(do: Callable[..., Any]) -> Callable[..., Any]:
    @functools.wraps(do)
    async def turn(**arguments: Any) -> Any:
        return await take_turn(do, **arguments)

    return turn
