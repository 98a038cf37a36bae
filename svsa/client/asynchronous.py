"""Asynchronous client of a running lab: the blocking client's methods, each in a thread.

    async with svsa.connect_async("http://127.0.0.1:8000") as lab:
        session = lab.session
        await session.set(position=svsa.SinePosition(amplitude_rad=0.5, frequency_hz=0.2))
        async with session.record("3 kg") as recording:
            await session.loads.add(svsa.PaperLoad())
            async for block in session.stream("position_rad", duration_s=5.0):
                print(block.time_s[-1], block["position_rad"][-1])
        result = await recording.read_result()

Every method has the name and the arguments of the blocking one; a context manager there is one for
`async with` here. Read a property of the lab by `await session.get("law")` and set it by `await
session.set(law="fl")`. If a task is cancelled while it awaits a call, the lab may still execute the
call.
"""

import asyncio
from collections.abc import AsyncIterator, Callable, Generator
from contextlib import ExitStack
from functools import partial
from typing import Any, Generic, TypeVar

from svsa.client.bench import RemoteBench
from svsa.client.connection import is_settable
from svsa.client.lab import Lab, connect
from svsa.client.loads import Loads
from svsa.client.runs import Recording, RemoteRuns, RemoteStudies
from svsa.client.session import RemoteSession

T = TypeVar("T")
IMMEDIATE = frozenset({"open_session", "stream"})
"""Methods that send no request: they are not awaited."""


def connect_async(
    url: str = "http://127.0.0.1:8000", token: str | None = None, **options: Any
) -> "Pending[AsyncLab]":
    """Connect to a running lab, with `async with` or `await`.

    Args:
        url: Address of the lab.
        token: Token of a class, or the lab's shared secret.
        **options: The other arguments of `svsa.connect`.

    Returns:
        An awaitable for the lab.

    Raises:
        LabError: When it is awaited, if no lab answers at this address.
    """
    return Pending(partial(connect, url, token, **options))


class Pending(Generic[T]):
    """A call of the blocking client, executed when awaited or entered with `async with`."""

    def __init__(self, call: Callable[[], Any]) -> None:
        self._call = call
        self._opened = ExitStack()

    def __await__(self) -> Generator[Any, None, T]:
        return self._wait().__await__()

    async def _wait(self) -> Any:
        return wrap(await asyncio.to_thread(self._call))

    async def __aenter__(self) -> T:
        context = await asyncio.to_thread(self._call)
        entered: Any = wrap(await asyncio.to_thread(self._opened.enter_context, context))
        return entered

    async def __aexit__(self, *_: object) -> None:
        await asyncio.to_thread(self._opened.close)


class _Awaited:
    """A wrapper of a blocking object, whose methods become awaitable."""

    def __init__(self, blocking: Any) -> None:
        object.__setattr__(self, "_blocking", blocking)

    def __getattr__(self, name: str) -> Any:
        kind = type(self._blocking)
        attribute = getattr(kind, name, None)
        if name.startswith("_") or not hasattr(kind, name):
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}.", name=name)
        if isinstance(attribute, property):
            message = f"{name!r} is asked of the lab: await it, as {_describe_read(kind, name)}."
            raise AttributeError(message, name=name)
        value = getattr(self._blocking, name)
        if not callable(value):
            return wrap(value)
        if name in IMMEDIATE:
            return lambda *arguments, **named: wrap(value(*arguments, **named))
        return lambda *arguments, **named: Pending(partial(value, *arguments, **named))

    def __setattr__(self, name: str, value: Any) -> None:
        """Raise `AttributeError`: attributes cannot be set without await."""
        hint = ""
        if is_settable(type(self._blocking), name):
            hint = f" Set it with: await session.set({name}=…)."
        message = f"{name!r} of {type(self).__name__} cannot be set.{hint}"
        raise AttributeError(message, name=name, obj=self)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *dir(self._blocking)})

    async def __aenter__(self) -> Any:
        return self

    async def __aexit__(self, *_: object) -> None:
        await asyncio.to_thread(self._blocking.__exit__, None, None, None)

    async def __aiter__(self) -> AsyncIterator[Any]:
        for element in await asyncio.to_thread(list, self._blocking):
            yield wrap(element)


def _describe_read(kind: type, name: str) -> str:
    return f"session.get({name!r})" if kind is RemoteSession else f"a method that reads {name!r}"


class AsyncLab(_Awaited):
    """`Lab` with awaitable methods."""


class AsyncSession(_Awaited):
    """`RemoteSession` with awaitable methods, including `loads` and `bench`."""


class AsyncRecording(_Awaited):
    """`Recording` with awaitable methods."""


class AsyncCollection(_Awaited):
    """Loads, runs, studies or the bench with awaitable methods; `async for` lists them."""


_KINDS: dict[type, type[_Awaited]] = {
    Lab: AsyncLab,
    RemoteSession: AsyncSession,
    Recording: AsyncRecording,
    Loads: AsyncCollection,
    RemoteBench: AsyncCollection,
    RemoteRuns: AsyncCollection,
    RemoteStudies: AsyncCollection,
}


def wrap(value: Any) -> Any:
    """Wrap an object of the blocking client; return any other value unchanged."""
    kind = _KINDS.get(type(value))
    return value if kind is None else kind(value)
