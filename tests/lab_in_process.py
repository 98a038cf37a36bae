"""A lab inside this process, for what is asked over REST, by httpx's ASGI transport.

What is about streams, signals or the end of a process needs a real one: `tests.lab.run_lab`.
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

from svsa.runs.records.catalogue.runs import DATA_VARIABLE
from svsa.teaching.course.file import FOLDER_VARIABLE
from svsa_server.app import build_app
from tests.lab import Lab

ADDRESS = "http://127.0.0.1"
LONGEST_S = 300.0
FOLDERS = {DATA_VARIABLE, FOLDER_VARIABLE}
"""Looked up whenever a file is; the rest is read once."""


class LoopTransport(httpx.BaseTransport):
    """Requests of this thread, answered by an application in the event loop of another."""

    def __init__(self, transport: httpx.ASGITransport, loop: asyncio.AbstractEventLoop) -> None:
        self._transport, self._loop = transport, loop

    def handle_request(self, request: httpx.Request) -> httpx.Response:
        request.read()
        asked = asyncio.run_coroutine_threadsafe(self._ask(request), self._loop)
        return asked.result(LONGEST_S)

    async def _ask(self, request: httpx.Request) -> httpx.Response:
        answer = await self._transport.handle_async_request(request)
        content = await answer.aread()
        return httpx.Response(answer.status_code, headers=answer.headers, content=content)


@contextlib.contextmanager
def run_loop() -> Iterator[asyncio.AbstractEventLoop]:
    """An event loop in a thread of its own."""
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

    It alone has them: a lab that another test starts meanwhile, as a process, reads only its own.
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
