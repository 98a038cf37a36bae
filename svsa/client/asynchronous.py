"""A running lab for a program that awaits: the calls of the blocking client, each in a thread.

    async with await svsa.connect_async("http://127.0.0.1:8000") as lab:
        await lab.session.set(position=svsa.SinePosition(amplitude_rad=0.5, frequency_hz=0.2))
        async with lab.session.record("3 kg") as recording:
            await lab.session.add_load(svsa.PaperLoad())
            async for block in lab.session.stream("position_rad", duration_s=5.0):
                print(block.time_s[-1], block["position_rad"][-1])
        result = await recording.read_result()

If a task is cancelled while it awaits a call, the lab may still carry the call out.
"""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import AbstractContextManager, ExitStack, asynccontextmanager
from functools import partial
from typing import Any, Self, TypeVar

from svsa.client.connection import Acted
from svsa.client.lab import SHARED, Lab, connect
from svsa.client.loads import AppliedLoad
from svsa.client.runs import Recording
from svsa.client.session import RemoteBench, RemoteSession
from svsa.client.stream import BlockStream
from svsa.runs.result.result import Result
from svsa.simulation.plant.loads import Load

T = TypeVar("T")
SETTINGS = frozenset(
    name for name, one in vars(RemoteSession).items() if isinstance(one, property) and one.fset
)
"""What `AsyncSession.set` takes: the properties of a session that can be set."""


async def connect_async(
    url: str = "http://127.0.0.1:8000", token: str | None = None, **options: Any
) -> "AsyncLab":
    """A running lab; options: those of `svsa.connect`. Raises `LabError` where none answers."""
    return AsyncLab(await asyncio.to_thread(connect, url, token, **options))


class _Awaited:
    """An object whose methods block; here each of them, by its own name, is awaited."""

    def __init__(self, blocking: object) -> None:
        self._blocking = blocking

    def __getattr__(self, name: str) -> Callable[..., Awaitable[Any]]:
        if name.startswith("_") or not callable(getattr(type(self._blocking), name, None)):
            raise AttributeError(f"{type(self).__name__} has no call {name!r}.", name=name)
        return partial(asyncio.to_thread, getattr(self._blocking, name))

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *dir(self._blocking)})


class AsyncLab(_Awaited):
    """A running lab: awaits each method of `Lab`, such as `run`. lab: the blocking client."""

    def __init__(self, lab: Lab) -> None:
        super().__init__(lab)
        self.lab = lab
        self.session = self.open_session(SHARED)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    def open_session(self, name: str) -> "AsyncSession":
        """The session of this name; the first call fails if the lab has none."""
        return AsyncSession(self.lab.open_session(name))

    async def create_session(self, *args: Any, **settings: Any) -> "AsyncSession":
        """Create a private session; arguments: those of `Lab.create_session`."""
        return AsyncSession(await asyncio.to_thread(self.lab.create_session, *args, **settings))

    @asynccontextmanager
    async def private(
        self, figure: str = "4a", law: str = "ndobc", **settings: Any
    ) -> "AsyncIterator[AsyncSession]":
        """A private session that ends with the block."""
        async with _enter(self.lab.private(figure, law, **settings)) as session:
            yield AsyncSession(session)

    async def open_run(self, run_id: str) -> Result:
        """The result of a recorded run."""
        return await asyncio.to_thread(self.lab.runs.__getitem__, run_id)


class AsyncSession(_Awaited):
    """A session: awaits each method of `RemoteSession`. session: the blocking one.

    Its properties are read together by `read_state` and set by `set`.
    """

    def __init__(self, session: RemoteSession) -> None:
        super().__init__(session)
        self.session = session

    @property
    def acted(self) -> Acted | None:
        """When the last command acted; None before the first."""
        return self.session.acted

    async def set(self, **settings: Any) -> None:
        """Set properties of the session, in the order given; returns when the last one holds.

        Args:
            **settings: any of `SETTINGS`, with the value that the property takes.

        Raises:
            ParameterError, StateError: the lab rejects a value; what was set before it stays.
            TypeError: there is no such setting; nothing is set.
        """
        if unknown := settings.keys() - SETTINGS:
            raise TypeError(f"No setting of a session: {', '.join(sorted(unknown))}.")
        for name, value in settings.items():
            await asyncio.to_thread(setattr, self.session, name, value)

    async def add_load(self, load: Load) -> AppliedLoad:
        """Apply a load, now or at its `start_s`."""
        return await asyncio.to_thread(self.session.loads.add, load)

    async def remove_load(self, load: AppliedLoad | int) -> None:
        """Remove a load."""
        await asyncio.to_thread(self.session.loads.remove, load)

    async def report_bench(self, call: Callable[[RemoteBench], None]) -> None:
        """A call of the bench, as `await session.report_bench(RemoteBench.arm)`."""
        await asyncio.to_thread(call, self.session.bench)

    @asynccontextmanager
    async def record(self, *args: Any, **options: Any) -> "AsyncIterator[AsyncRecording]":
        """Record every sample and command within the block; arguments: `RemoteSession.record`."""
        recording = await asyncio.to_thread(self.session.record, *args, **options)
        async with _enter(recording):
            yield AsyncRecording(recording)

    def stream(self, *channels: Any, **options: Any) -> BlockStream:
        """Samples for `async for`; arguments: those of `RemoteSession.stream`."""
        return self.session.stream(*channels, **options)


class AsyncRecording:
    """A recording, in the lab's list. run_id: its id there."""

    def __init__(self, recording: Recording) -> None:
        self._recording = recording
        self.run_id = recording.run_id

    async def read_result(self) -> Result:
        """The run as `svsa.simulate` would have returned it, once it has ended."""
        return await asyncio.to_thread(lambda: self._recording.result)


@asynccontextmanager
async def _enter(context: AbstractContextManager[T]) -> AsyncIterator[T]:
    """A blocking context whose two ends run in a thread."""
    opened = ExitStack()
    inside = await asyncio.to_thread(opened.enter_context, context)
    try:
        yield inside
    finally:
        await asyncio.to_thread(opened.close)
