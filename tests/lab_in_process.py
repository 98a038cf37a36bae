"""A lab inside this process, for what is asked over REST, by httpx's ASGI transport.

Tests of streams, of signals or of the end of a process need a real process: `tests.lab.run_lab`.
"""

import asyncio
import contextlib
import os
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import patch

import httpx

from svsa.inputs.data_folder import DATA_VARIABLE
from svsa.teaching.course.file import FOLDER_VARIABLE
from svsa_server.app import build_app
from tests.lab import Lab

ADDRESS = "http://127.0.0.1"
LONGEST_S = 300.0
FOLDERS = {DATA_VARIABLE, FOLDER_VARIABLE}
"""Variables that are read at each file access; all others are read once."""


class LoopTransport(httpx.BaseTransport):
    """Passes requests of this thread to an application in the event loop of another thread."""

    def __init__(self, transport: httpx.ASGITransport, loop: asyncio.AbstractEventLoop) -> None:
        self._transport, self._loop = transport, loop

    def handle_request(self, request: httpx.Request) -> httpx.Response:
        request.read()
        future = asyncio.run_coroutine_threadsafe(self._send(request), self._loop)
        return future.result(LONGEST_S)

    async def _send(self, request: httpx.Request) -> httpx.Response:
        answer = await self._transport.handle_async_request(request)
        content = b"".join([part async for part in answer.aiter_raw()])
        return httpx.Response(answer.status_code, headers=answer.headers, content=content)


@contextlib.contextmanager
def run_loop() -> Iterator[asyncio.AbstractEventLoop]:
    """Run an event loop in a thread of its own."""
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever, daemon=True)
    thread.start()
    try:
        yield loop
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join()
        loop.close()


@contextlib.contextmanager
def run_lab_in_process(**settings: str) -> Iterator[Lab]:
    """Start a lab, and end it. settings: as those of `tests.lab.run_lab`.

    Only this lab has the settings: a lab that another test starts as a process at the same time
    reads only its own.
    """
    if "data" not in settings:
        with (
            tempfile.TemporaryDirectory(prefix="svsa-test-") as folder,
            run_lab_in_process(data=folder, **settings) as lab,
        ):
            yield lab
        return
    variables = {f"SVSA_{name.upper()}": value for name, value in settings.items()}
    folders = {name: variables[name] for name in variables.keys() & FOLDERS}
    with run_loop() as loop, patch.dict(os.environ, folders):
        with patch.dict(os.environ, variables):
            os.environ.pop("SVSA_SECRET", None)
            app = build_app()
        life = app.router.lifespan_context(app)
        asyncio.run_coroutine_threadsafe(life.__aenter__(), loop).result(LONGEST_S)
        try:
            transport = LoopTransport(httpx.ASGITransport(app, raise_app_exceptions=False), loop)
            with httpx.Client(transport=transport, base_url=ADDRESS, trust_env=False) as client:
                yield Lab(ADDRESS, client, None, Path(settings["data"]))
        finally:
            ending = life.__aexit__(None, None, None)
            asyncio.run_coroutine_threadsafe(ending, loop).result(LONGEST_S)
