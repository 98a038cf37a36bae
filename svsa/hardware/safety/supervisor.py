"""The supervisor: a process with its own bus that stops the drives if the loop fails.

    python -m svsa.hardware.safety.supervisor BENCH HEARTBEATS

The drives hold their last current indefinitely. If the loop, after its first beat, has not beaten
for `loop_s` (20 ms), the supervisor sends zero current to both drives and resets every drive, and
repeats that until the loop beats. It ends at SIGTERM, or if its parent has ended and the loop is
silent.
"""

import math
import os
import signal
import sys
import time

import can

from svsa.errors import SvsaError
from svsa.hardware.description.file import BenchFile, read_bench
from svsa.hardware.drives.bus import DELIVERY_S, open_bus, take_waiting
from svsa.hardware.drives.drive import merge_stops
from svsa.hardware.drives.installed import build_stop
from svsa.hardware.safety.heartbeat import Heartbeats
from svsa.hardware.schedule import SUPERVISOR_PRIORITY, request_real_time

DEAF_S = 0.25
PERIOD_S = 0.005
ORPHANED_S = 2.0
_MAX_FRAMES = 500


class Supervisor:
    """Monitors the loop's heartbeat. silenced: whether it has taken over."""

    def __init__(self, bench: BenchFile, bus: can.BusABC, beats: Heartbeats) -> None:
        self._bus, self._beats = bus, beats
        self._settings = bench.supervisor_bus or bench.bus
        self._frames = merge_stops(build_stop(bench.motor1), build_stop(bench.motor2))
        self._loop_s = bench.safety.loop_s
        self._heard_s = -math.inf
        self.silenced = False

    def watch(self) -> None:
        """Check once: stop the drives if the loop is silent; beat while the bus works.

        A bus can be lost without an error: a supervisor that receives nothing cannot act.
        """
        now = time.monotonic()
        if self.listen():
            self._heard_s = now
        if now - self._heard_s <= DEAF_S:
            # Beats only while the bus works: without beats the loop ends a run that the supervisor
            # could not stop.
            self._beats.beat("supervisor")
        age = self._beats.age_s("loop")
        if age == math.inf or age <= self._loop_s:
            self.silenced = False
            return
        is_first, self.silenced = not self.silenced, True
        if is_first:
            # Counted before the first frame, so that a loop that resumes in between can attribute
            # the frames to the supervisor.
            self._beats.count_stop()
        self.stop_drives()
        self._beats.beat("stopping")
        if is_first:
            # After the frames: printing blocks if no process reads the standard output.
            print(f"Supervisor: the loop is silent, the drives are stopped ({age:.3f} s).")
            sys.stdout.flush()

    def listen(self) -> bool:
        """Read waiting frames; return whether there were any."""
        return bool(list(take_waiting(self._bus, self._settings, _MAX_FRAMES)))

    def stop_drives(self) -> None:
        """Send zero current to both drives, and reset all."""
        for frame in self._frames:
            self._bus.send(frame)

    def is_orphaned(self, parent: int) -> bool:
        """Whether the parent has ended and the loop was silent for long."""
        age = self._beats.age_s("loop")
        return os.getppid() != parent and age > ORPHANED_S


def main(arguments: list[str]) -> int:
    """Monitor until SIGTERM; return 1 if the bus cannot be opened or is lost."""
    path, name = arguments
    parent = os.getppid()
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    try:
        bench, beats = read_bench(path), Heartbeats.attach(name)
        bus = open_bus(bench.supervisor_bus or bench.bus)
    except (SvsaError, OSError) as error:
        print(f"Supervisor: {error}", file=sys.stderr)
        return 1
    supervisor = Supervisor(bench, bus, beats)
    request_real_time(SUPERVISOR_PRIORITY)
    try:
        while not ended and not supervisor.is_orphaned(parent):
            supervisor.watch()
            time.sleep(PERIOD_S)
        beats.end("supervisor")
        supervisor.stop_drives()
        time.sleep(DELIVERY_S)
    except (can.CanError, OSError) as error:
        print(f"Supervisor: the bus is lost: {error}", file=sys.stderr)
        return 1
    finally:
        bus.shutdown()
        beats.close()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
