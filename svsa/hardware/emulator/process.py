"""The emulator's process: frames in, time on, frames out; against the clock or in lockstep."""

import math
import select
import time
from typing import Any

from svsa.hardware.emulator.control import ControlServer
from svsa.hardware.emulator.emulator import Emulator
from svsa.hardware.emulator.exchange import Exchange
from svsa.hardware.emulator.frame import FrameServer

LONGEST_SLEEP_S = 0.5
GRAIN_S = 0.00025
"""Maximum delay of frames in real time, s, after which they are sent together, as by a USB adapter.
"""


class EmulatorProcess:
    """Serves an emulator to its clients until `stopped`, or idle for `idle_s` (0: indefinitely).

    With `lockstep`, time advances only when a client requests it, and frames have the timestamps of
    the emulator's time; otherwise the time of day, as from adapters. If no client requests time for
    `alone_s`, time advances in real time until one does, as on a machine whose loop has ended.
    """

    def __init__(
        self,
        emulator: Emulator,
        servers: list[FrameServer],
        control: ControlServer,
        lockstep: bool,
        idle_s: float = 0.0,
        alone_s: float = math.inf,
    ) -> None:
        self._rig, self._servers, self._control = emulator, servers, control
        self._lockstep, self._idle_s = lockstep, idle_s
        self._start = time.monotonic()
        self._exchange = Exchange(emulator, servers, lockstep, 0.0 if lockstep else time.time())
        self._last_use = self._start
        self._alone_s, self._asked = alone_s, 0
        self._alone_since, self._left_us = math.inf, 0
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
                self._exchange.advance_to(self._read_clock())
            for server in self._servers:
                self._exchange.serve(server)
            now = time.monotonic()
            if self._lockstep:
                self._advance_alone(now)
            if any(server.listening for server in self._servers):
                self._last_use = now
            elif self._idle_s and now - self._last_use > self._idle_s:
                return

    def _advance_alone(self, now: float) -> None:
        """Continue in real time if no client has requested time for `alone_s`."""
        if self._exchange.asked != self._asked:
            self._asked = self._exchange.asked
            self._alone_since, self._left_us = now + self._alone_s, self._rig.now_us
        elif now > self._alone_since:
            self._exchange.advance_to(self._left_us + int((now - self._alone_since) * 1e6))

    def _choose_sleep(self) -> float:
        waits = [LONGEST_SLEEP_S]
        waits += [wait for server in self._servers if (wait := server.wait_s()) is not None]
        if self._lockstep:
            waits.append(max(GRAIN_S, self._alone_since - time.monotonic()))
        else:
            waits.append(max(GRAIN_S, (self._rig.next_event_us - self._read_clock()) * 1e-6))
        return max(0.0, min(waits))

    def _read_clock(self) -> int:
        return int((time.monotonic() - self._start) * 1e6)
