"""A slow link to a lab: a TCP proxy with a rate that all connections share, and a delay."""

import asyncio
import contextlib
import math
import socket
import threading
from collections.abc import Iterator

from tests.lab_in_process import run_loop

PACKET_BYTES = 2048
BUFFER_BYTES = 16 * 1024


class SlowLink:
    """A proxy on loopback, as slow as it is set.

    Attributes:
        url: Address of the lab over this link.
        rate_bps: Rate of the data to the clients, bytes per second, of all connections together.
        received: Bytes that the proxy has read from the lab.
        delivered: Bytes that the clients were sent.
        is_open: Cleared while the link passes nothing to the clients.
    """

    def __init__(
        self,
        lab_url: str,
        rate_bps: float,
        round_trip_s: float,
        loop: asyncio.AbstractEventLoop,
    ) -> None:
        self._port = int(lab_url.rpartition(":")[2])
        self.rate_bps, self._delay_s = rate_bps, round_trip_s / 2.0
        self.received = self.delivered = 0
        self.is_open = threading.Event()
        self.is_open.set()
        self.url = ""
        self._free_s = 0.0
        self._writers: set[asyncio.StreamWriter] = set()
        self._tasks: set[asyncio.Task[object]] = set()
        self._loop = loop

    async def serve(self) -> None:
        """Listen on a free port."""
        self._server = await asyncio.start_server(self._connect, "127.0.0.1", 0)
        self.url = f"http://127.0.0.1:{self._server.sockets[0].getsockname()[1]}"

    async def close(self) -> None:
        """End all connections."""
        self._server.close()
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    def cut(self) -> None:
        """Break all connections."""
        for writer in list(self._writers):
            self._loop.call_soon_threadsafe(writer.transport.abort)

    async def _connect(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.current_task()
        assert task is not None
        self._tasks.add(task)
        upstream = socket.create_connection(("127.0.0.1", self._port))
        upstream.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER_BYTES)
        from_lab, to_lab = await asyncio.open_connection(sock=upstream, limit=BUFFER_BYTES)
        self._writers |= {writer, to_lab}
        try:
            # asyncio logs a cancelled connection of a server as an error.
            with contextlib.suppress(asyncio.CancelledError):
                await self._relay(reader, writer, from_lab, to_lab)
        finally:
            self._tasks.discard(task)
            self._writers -= {writer, to_lab}
            for end in (writer, to_lab):
                end.transport.abort()

    async def _relay(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        from_lab: asyncio.StreamReader,
        to_lab: asyncio.StreamWriter,
    ) -> None:
        async with asyncio.TaskGroup() as group:
            for read_from, write_to in ((reader, to_lab), (from_lab, writer)):
                on_the_way: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue()
                group.create_task(self._read(read_from, on_the_way, write_to is writer))
                group.create_task(self._deliver(on_the_way, write_to, write_to is writer))

    async def _read(
        self,
        reader: asyncio.StreamReader,
        on_the_way: "asyncio.Queue[tuple[float, bytes]]",
        is_down: bool,
    ) -> None:
        data = b"-"
        while data:
            try:
                data = await reader.read(PACKET_BYTES)
            except ConnectionError:
                data = b""
            if is_down:
                self.received += len(data)
                await self._wait_for_rate(len(data))
            on_the_way.put_nowait((self._loop.time() + self._delay_s, data))

    async def _wait_for_rate(self, size: int) -> None:
        now = self._loop.time()
        self._free_s = max(now, self._free_s) + size / self.rate_bps
        await asyncio.sleep(self._free_s - now)

    async def _deliver(
        self,
        on_the_way: "asyncio.Queue[tuple[float, bytes]]",
        writer: asyncio.StreamWriter,
        is_down: bool,
    ) -> None:
        while True:
            due_s, data = await on_the_way.get()
            await asyncio.sleep(due_s - self._loop.time())
            while is_down and not self.is_open.is_set():
                await asyncio.sleep(0.01)
            if writer.is_closing() or not data:
                break
            writer.write(data)
            with contextlib.suppress(ConnectionError):
                await writer.drain()
            self.delivered += len(data) if is_down else 0
        with contextlib.suppress(OSError):
            writer.write_eof()


@contextlib.contextmanager
def open_slow_link(
    lab_url: str, rate_bps: float = math.inf, round_trip_s: float = 0.0
) -> Iterator[SlowLink]:
    """Serve a link to a lab until the block ends."""
    with run_loop() as loop:
        link = SlowLink(lab_url, rate_bps, round_trip_s, loop)
        asyncio.run_coroutine_threadsafe(link.serve(), loop).result(60.0)
        try:
            yield link
        finally:
            asyncio.run_coroutine_threadsafe(link.close(), loop).result(60.0)
