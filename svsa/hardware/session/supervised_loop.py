"""The loop of a bench and its supervisor, as used by a session."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from svsa.errors import StateError
from svsa.hardware.bench.emulation import EMULATED_PERIOD_S
from svsa.hardware.description.file import BenchFile
from svsa.hardware.realtime.launch import (
    COLD,
    PATIENCE_S,
    BenchProcesses,
    ReportProgress,
    Rest,
    ignore_progress,
)
from svsa.hardware.realtime.loss import Loss, find_loss, is_supervised
from svsa.hardware.realtime.prepared_laws import UnpreparedLawError, compute_constants
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import MAX_LANES

UNKNOWN_S = 0.25
"""Time after the last tick for which the process that stops the drives may be unknown, s."""
SILENT = 2.0
"""Multiple of `loop_s` after which the loop counts as silent: the supervisor acts before the
server.
"""
LISTENED_S = 3.0 * EMULATED_PERIOD_S
"""Time without frames of an emulator after which a bench counts as real, s."""


class SupervisedLoop:
    """Both processes, started and restarted by `launch`.

    Attributes:
        starting: Whether they reject commands, until `open` returns.
        memory: See `LoopMemory`.

    Args:
        path: Path of the bench file.
        bench: The bench file.
        rest: Lets time pass while a command waits.
    """

    def __init__(self, path: Path, bench: BenchFile, rest: Rest = time.sleep) -> None:
        self._path, self._timing, self._rest = path, bench.timing, rest
        self._patience_s = max(PATIENCE_S, SILENT * bench.safety.loop_s)
        self.starting = True
        self._heat = COLD

    def launch(self, configuration: Configuration) -> None:
        """Start both processes; `open` waits for them."""
        self.processes = BenchProcesses(
            self._path, configuration, self._rest, self._heat, self._patience_s
        )
        self.memory = self.processes.memory

    def open(self, report: ReportProgress = ignore_progress) -> None:
        """Wait until the bench may be armed; `report` receives the activity of the loop.

        Raises:
            BenchError: If it cannot be opened.
        """
        try:
            self.processes.wait_until_ready(self._timing.start_silence_s, report)
        finally:
            self.starting = False

    def restart(self, launch: Callable[[], None]) -> None:
        """End both processes, by force if they do not respond, start them, and open.

        The heat of the motors is that at the end of the previous loop: the cooling time is unknown.
        """
        self.starting = True
        try:
            before = self.processes
            before.end()
            first, second = before.memory.fields["heat"]
            self._heat = float(first), float(second)
            launch()
            before.free()
            self.open()
        finally:
            self.starting = False

    def close(self) -> None:
        """Ramp to zero, and end both."""
        self.processes.end()
        self.processes.free()

    @property
    def loss(self) -> Loss | None:
        """Loss of a loop that does not tick, and the process that stopped the drives."""
        return None if self.starting else find_loss(self.processes)

    @property
    def emulated(self) -> bool | None:
        """Whether the bus reported an emulator; None before it was read."""
        if self.memory.fields["emulated"]:
            return True
        listened_s = int(self.memory.fields["ticks"]) * self._timing.period_s
        return False if listened_s > LISTENED_S else None

    @property
    def supervised(self) -> bool:
        """Whether the supervisor runs and its heartbeat is recent."""
        return is_supervised(self.processes)

    def find_lasting_loss(self) -> Loss | None:
        """Return `loss` once the process that stops the drives is known."""
        loss = self.loss
        is_unknown = loss is not None and loss.stopped_by is None
        return None if is_unknown and 0.0 < self.processes.silence_s < UNKNOWN_S else loss

    def check_started(self) -> None:
        """Raise `StateError` while they are being started."""
        if self.starting:
            raise StateError(
                f"The bench is being started ({self.processes.step},"
                f" {self.processes.age_s:.0f} s): repeat the request when it is ready."
            )

    def ask(self, action: str, argument: object = None) -> dict[str, Any]:
        """Send a request to the loop, and wait for its answer.

        Constants of a law that the loop lacks are computed here, because the loop has no time for
        it.
        """
        self.check_started()
        # The constants of several lanes' laws may be missing; the loop reports one at a time.
        for _ in range(MAX_LANES):
            try:
                return self.processes.request(action, argument)
            except UnpreparedLawError as lacking:
                self.processes.request("prepare", compute_constants(lacking.arguments))
        return self.processes.request(action, argument)

    def take_states(self) -> list[dict[str, Any]]:
        """Return the states reported since the last call."""
        events = self.processes.take_events()
        return [event for event in events if event["event"] == "state"]

    def request_quick_stop(self) -> None:
        """Request a quick stop from any thread, through shared memory alone."""
        self.memory.fields["quick_stop"] = 1
