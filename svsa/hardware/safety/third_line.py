"""The last stop: the process that started loop and supervisor stops the drives if both are lost.

Without a supervisor the loop stops the drives, and without the loop the supervisor does. Without
both the drives would hold their last current indefinitely: the process that started them opens the
bus and does the same as the supervisor. Many adapters serve one program only: a blocked process
that holds the bus is killed first.
"""

import math
import subprocess
import threading
import time
from collections.abc import Callable
from typing import NamedTuple

from svsa.errors import SvsaError
from svsa.hardware.description.file import BenchFile
from svsa.hardware.drives.bus import BUS_TROUBLE, open_bus, prepare_bus
from svsa.hardware.safety.heartbeat import Heartbeats
from svsa.hardware.safety.supervisor import PERIOD_S, Supervisor
from svsa.hardware.schedule import SUPERVISOR_PRIORITY, request_priority

STILL = 5.0
"""Multiple of `loop_s` after which a working supervisor would have acted."""
LOOKS = 5
"""Number of consecutive checks in which both must be silent, so that this process was awake."""
RETRY_S = 0.05
STOP_S = 10.0
"""Maximum time that `stop` waits for a bus that is being opened, which cannot be interrupted, s."""


class Intervention(NamedTuple):
    """An intervention of the third line.

    Attributes:
        after_s: Time from the loop's last tick to the first frame, s; None before a frame.
        problem: Why the drives cannot be reached now, or None.
    """

    after_s: float | None
    problem: str | None


class ThirdLine:
    """A thread that monitors both processes until `stop`. intervention: None if not needed."""

    def __init__(
        self,
        bench: BenchFile,
        beats: Heartbeats,
        loop: subprocess.Popen[bytes],
        supervisor: subprocess.Popen[bytes],
    ) -> None:
        self._bench, self._beats = bench, beats
        self._loop, self._supervisor = loop, supervisor
        self._loop_s = bench.safety.loop_s
        self._ended = threading.Event()
        self._looks = 0
        self.intervention: Intervention | None = None
        prepare_bus(bench.bus)
        self._thread = threading.Thread(target=self._watch, name="third line", daemon=True)
        self._thread.start()

    def stop(self, rest: Callable[[float], None] = time.sleep) -> None:
        """Stop monitoring, and release the bus; `rest` lets time pass meanwhile."""
        self._ended.set()
        end = time.monotonic() + STOP_S
        while self._thread.is_alive() and time.monotonic() < end:
            rest(PERIOD_S)

    def _watch(self) -> None:
        # For this thread alone; the rest of the server keeps its priority.
        request_priority(SUPERVISOR_PRIORITY)
        while not self._ended.wait(PERIOD_S):
            if self._is_needed():
                self._intervene()

    def _is_needed(self) -> bool:
        """Whether both are lost. A loop that has not started, or ended regularly, is not."""
        silent_s = self._beats.age_s("loop")
        if math.isinf(silent_s) or silent_s <= self._loop_s:
            self._looks = 0
            return False
        if self._loop.poll() is not None and self._supervisor.poll() is not None:
            return True
        longest_s = STILL * self._loop_s
        still = silent_s > longest_s and self._beats.age_s("supervisor") > longest_s
        self._looks = self._looks + 1 if still else 0
        return self._looks >= LOOKS

    def _intervene(self) -> None:
        """Kill both processes, and stop the drives until `stop`.

        A process that is being killed may still hold the bus for some time: then opening is
        retried.
        """
        # Many adapters serve one program only, and a blocked process may still hold the bus.
        for process in (self._loop, self._supervisor):
            process.kill()
        while not self._ended.is_set():
            try:
                self._stop_drives()
            except (SvsaError, *BUS_TROUBLE) as error:
                self._note(str(error))
            self._ended.wait(RETRY_S)

    def _stop_drives(self) -> None:
        """Send the supervisor's frames on the loop's own path to the bus; raises on failure."""
        bus = open_bus(self._bench.bus)
        try:
            supervisor = Supervisor(self._bench.changed(supervisor_bus=None), bus, self._beats)
            while not self._ended.is_set():
                supervisor.listen()
                supervisor.stop_drives()
                self._note(None)
                self._ended.wait(PERIOD_S)
        finally:
            bus.shutdown()

    def _note(self, problem: str | None) -> None:
        after_s = self.intervention.after_s if self.intervention else None
        if after_s is None and problem is None:
            after_s = self._beats.age_s("loop")
        self.intervention = Intervention(after_s, problem)
