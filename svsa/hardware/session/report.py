"""What the loop of a bench has told of itself, and what becomes known of it where it is silent."""

from typing import Any

from svsa.errors import Fault
from svsa.hardware.homing import STEPS, Axis
from svsa.hardware.safety.machine import MOVING, BenchStatus
from svsa.hardware.session.fault_latch import FaultLatch
from svsa.hardware.session.heat_events import HeatEvents
from svsa.hardware.session.supervised_loop import SupervisedLoop
from svsa.runs.session.journal import Journal


class BenchReport:
    """States, each taken in once, and the fault that is latched; what they say enters the journal.

    `told_status`: the loop's own word. `problems`: what is not known yet of the bench or not right
    with it. `homing_step`: the axis whose mark is next, None where all were confirmed.
    """

    def __init__(self, loop: SupervisedLoop, journal: Journal, problems: list[str]) -> None:
        self._loop, self._journal = loop, journal
        self.problems = problems
        self.begin()

    def begin(self) -> None:
        """The loop was started anew: nothing has been told yet."""
        self.told_status = BenchStatus.OFF
        self.homing_step: Axis | None = STEPS[0].name
        self._heat = HeatEvents()
        self._latch = FaultLatch()

    def clear(self) -> None:
        """Hold no fault any more."""
        self._latch = FaultLatch()

    @property
    def fault(self) -> Fault | None:
        """The bench's latched fault."""
        return self._latch.fault

    @property
    def status(self) -> BenchStatus:
        """As the loop says; FAULT where it cannot be believed any more."""
        return self.told_status if self.fault is None else BenchStatus.FAULT

    def look_for_stop(self, states: list[dict[str, Any]]) -> None:
        """A ramp begins a window before its first sample is taken in."""
        ramps = any(told["status"] == BenchStatus.RAMP for told in states)
        if ramps and self.told_status is BenchStatus.RUN:
            self._journal.begin_stop()

    def take(self, states: list[dict[str, Any]]) -> None:
        """What the loop has told, in its order."""
        for told in states:
            self.problems, self.homing_step = told["problems"], told["homing_step"]
            self._heat.log(told["held_back"], BenchStatus(told["status"]) in MOVING, self._journal)
            if self._latch.take_own(Fault(**told["fault"]) if told["fault"] else None):
                self._log_fault()
            self.told_status = BenchStatus(told["status"])
            self._journal.version += 1

    def look_for_loss(self) -> None:
        """Latch what has become of a loop that does not tick, as far as it is known."""
        loss, run = self._loop.find_settled_loss(), self._journal.run
        if loss is None:
            return
        held = self.fault
        if self._latch.take_loss(Fault(loss.code, 0, run.tick, run.time_s, loss.message)):
            self._log_fault()
        elif self.fault is not None and self.fault is not held:
            self._journal.refine_fault(self.fault)

    def _log_fault(self) -> None:
        if self.fault is not None:
            self._journal.log_fault(self.fault, ends_run=self.told_status in MOVING)
