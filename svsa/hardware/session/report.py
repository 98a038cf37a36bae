"""Reports of a bench's loop: its latched fault, and heat as events of the run."""

from collections.abc import Iterable
from typing import Any

from svsa.errors import Fault
from svsa.hardware.bench.homing import STEPS, Axis
from svsa.hardware.safety.faults import FaultLatch
from svsa.hardware.safety.heat import describe_heat
from svsa.hardware.safety.machine import MOVING, BenchStatus
from svsa.hardware.session.supervised_loop import SupervisedLoop
from svsa.runs.session.journal import Journal


class HeatEvents:
    """Which motors heat limited at the last report; none before the first report of a loop."""

    def __init__(self) -> None:
        self._axes: frozenset[str] = frozenset()

    def log(self, axes: Iterable[str], moving: bool, journal: Journal) -> None:
        """Log changes of the reduction by heat; at rest no torque is demanded, so that none ends.

        `axes` are those that are limited now.
        """
        held = frozenset(axes)
        for axis in sorted(held ^ self._axes):
            is_on = axis in held
            if is_on or moving:
                kind = "heat_limit_began" if is_on else "heat_limit_ended"
                journal.report(kind, describe_heat(axis, is_on))
        self._axes = held


class BenchReport:
    """Applies each state report once, keeps the latched fault, and logs events in the journal.

    Attributes:
        loop_status: Status reported by the loop.
        problems: Unknown or wrong properties of the bench.
        homing_step: Axis whose mark is next, None if all were confirmed.
    """

    def __init__(self, loop: SupervisedLoop, journal: Journal, problems: list[str]) -> None:
        self._loop, self._journal = loop, journal
        self.problems = problems
        self.begin()

    def begin(self) -> None:
        """Reset for a restarted loop."""
        self.loop_status = BenchStatus.OFF
        self.homing_step: Axis | None = STEPS[0].name
        self._heat = HeatEvents()
        self._latch = FaultLatch()

    def clear(self) -> None:
        """Clear the fault."""
        self._latch.clear()

    @property
    def fault(self) -> Fault | None:
        """The bench's latched fault."""
        return self._latch.fault

    @property
    def status(self) -> BenchStatus:
        """State reported by the loop; FAULT if the report is outdated."""
        return self.loop_status if self.fault is None else BenchStatus.FAULT

    def check_for_stop(self, states: list[dict[str, Any]]) -> None:
        """Start a window at a ramp, before its first sample is read."""
        ramps = any(state["status"] == BenchStatus.RAMP for state in states)
        if ramps and self.loop_status is BenchStatus.RUN:
            self._journal.begin_stop()

    def take(self, states: list[dict[str, Any]]) -> None:
        """Apply the reports of the loop in order."""
        for state in states:
            self.problems, self.homing_step = state["problems"], state["homing_step"]
            self._heat.log(
                state["limited_by_heat"],
                BenchStatus(state["status"]) in MOVING,
                self._journal,
            )
            if state["fault"] is None:
                self._latch.clear_reported()
            elif self._latch.take(Fault(**state["fault"])):
                self._log_fault()
            self.loop_status = BenchStatus(state["status"])
            self._journal.version += 1

    def check_for_loss(self) -> None:
        """Latch the known loss of a loop that does not tick."""
        loss, run = self._loop.find_lasting_loss(), self._journal.run
        if loss is None:
            return
        held = self.fault
        if self._latch.take(Fault(loss.code, 0, run.tick, run.time_s, loss.message)):
            self._log_fault()
        elif self.fault is not None and self.fault is not held:
            self._journal.refine_fault(self.fault)

    def _log_fault(self) -> None:
        if self.fault is not None:
            self._journal.log_fault(self.fault, ends_run=self.loop_status in MOVING)
