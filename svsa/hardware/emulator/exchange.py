"""Exchange between an emulator and its clients: frames in both directions, and lockstep time."""

from typing import Any

from svsa.hardware.bench.emulation import (
    ADVANCE_ID,
    EMULATED_DATA,
    EMULATED_ID,
    Frame,
    decode_time,
    encode_time,
)
from svsa.hardware.emulator.emulator import Emulator
from svsa.hardware.emulator.frame import FrameServer

LONGEST_STEP_US = 10_000_000


class Exchange:
    """Transfers frames between an emulator and the clients of its servers.

    Attributes:
        lockstep: Whether time advances only when a client requests it with `ADVANCE_ID`.
        origin_s: Origin of the frames' timestamps in the emulator's time, s.
        asked: Number of requests for time.
    """

    def __init__(
        self, emulator: Emulator, servers: list[FrameServer], lockstep: bool, origin_s: float = 0.0
    ) -> None:
        self._rig, self._servers = emulator, servers
        self._lockstep, self._origin_s = lockstep, origin_s
        self.asked = 0

    def serve(self, server: FrameServer) -> None:
        """Process waiting input; new clients are greeted before their first frame acts."""
        heard = server.poll()
        for client in server.take_arrivals():
            greeting = Frame(EMULATED_ID, EMULATED_DATA, extended=True)
            server.send(greeting, self._stamp(self._rig.now_us), to=client)
        for client, frame in heard:
            self._take(server, client, frame)
        self._flush()

    def advance_to(self, time_us: int) -> None:
        """Advance the emulator to this time, and send its frames."""
        self._advance_to(time_us)
        self._flush()

    def _advance_to(self, time_us: int) -> None:
        for said_us, frame, sender in self._rig.advance_to(time_us):
            for server in self._servers:
                server.send(frame, self._stamp(said_us), but=sender)

    def _flush(self) -> None:
        """Send all frames of a client in one write, which wakes it up once."""
        for server in self._servers:
            server.flush()

    def _stamp(self, time_us: int) -> float:
        return self._origin_s + time_us * 1e-6

    def _take(self, server: FrameServer, client: Any, frame: Frame) -> None:
        """Process a client's frame: a command to a drive, or a request to advance time."""
        if not (frame.extended and frame.can_id == ADVANCE_ID):
            self._rig.receive(frame, client)
            return
        self.asked += 1
        if self._lockstep:
            self._advance_to(min(decode_time(frame.data), self._rig.now_us + LONGEST_STEP_US))
        now_us = self._rig.now_us
        echo = Frame(ADVANCE_ID, encode_time(now_us), extended=True)
        server.send(echo, self._stamp(now_us), to=client)
