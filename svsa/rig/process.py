"""The rig's process: frames in, time on, frames out; against the clock or in lockstep."""

import select
import time
from typing import Any

from svsa.hardware.emulation import ADVANCE_ID, EMULATED_DATA, EMULATED_ID, decode_time, encode_time
from svsa.rig.control import ControlServer
from svsa.rig.frame import Frame, FrameServer
from svsa.rig.rig import Rig

LONGEST_STEP_US = 10_000_000
LONGEST_SLEEP_S = 0.5


class RigProcess:
    """Serves a rig to its clients until told to stop, or idle for `idle_s` (0: for ever).

    lockstep: time goes on only when a client asks for it with `ADVANCE_ID`. Frames are stamped
    with the rig's time then, and with the time of day against the clock, as adapters do.
    """

    def __init__(
        self,
        rig: Rig,
        servers: list[FrameServer],
        control: ControlServer,
        lockstep: bool,
        idle_s: float = 0.0,
    ) -> None:
        self._rig, self._servers, self._control = rig, servers, control
        self._lockstep, self._idle_s = lockstep, idle_s
        self._start = time.monotonic()
        self._origin_s = 0.0 if lockstep else time.time()
        self._last_use = self._start
        self.stopped = False

    def run(self) -> None:
        """Serve until `stopped`, or idle for too long."""
        while not self.stopped:
            sources: list[Any] = [*self._control.sources()]
            for server in self._servers:
                sources += server.sources()
            select.select(sources, [], [], self._choose_sleep())
            self._control.poll()
            if not self._lockstep:
                self._say(self._rig.advance_to(self._read_clock()))
            for server in self._servers:
                self._serve(server)
            now = time.monotonic()
            if any(server.listening for server in self._servers):
                self._last_use = now
            elif self._idle_s and now - self._last_use > self._idle_s:
                return

    def _serve(self, server: FrameServer) -> None:
        """Do what has come; who is new is greeted before the first frame of theirs acts."""
        heard = server.poll()
        for client in server.take_arrivals():
            greeting = Frame(EMULATED_ID, EMULATED_DATA, extended=True)
            server.send(greeting, self._stamp(self._rig.now_us), to=client)
        for client, frame in heard:
            self._take(server, client, frame)

    def _choose_sleep(self) -> float:
        waits = [LONGEST_SLEEP_S]
        waits += [wait for server in self._servers if (wait := server.wait_s()) is not None]
        if not self._lockstep:
            waits.append((self._rig.next_event_us - self._read_clock()) * 1e-6)
        return max(0.0, min(waits))

    def _read_clock(self) -> int:
        return int((time.monotonic() - self._start) * 1e6)

    def _stamp(self, time_us: int) -> float:
        return self._origin_s + time_us * 1e-6

    def _take(self, server: FrameServer, client: Any, frame: Frame) -> None:
        """A client's frame: a command to a drive, or the request to let time go on."""
        if not (frame.extended and frame.can_id == ADVANCE_ID):
            self._rig.receive(frame, client)
            return
        if self._lockstep:
            until = min(decode_time(frame.data), self._rig.now_us + LONGEST_STEP_US)
            self._say(self._rig.advance_to(until))
        now_us = self._rig.now_us
        echo = Frame(ADVANCE_ID, encode_time(now_us), extended=True)
        server.send(echo, self._stamp(now_us), to=client)

    def _say(self, said: list[tuple[int, Frame, Any]]) -> None:
        for time_us, frame, sender in said:
            for server in self._servers:
                server.send(frame, self._stamp(time_us), but=sender)
