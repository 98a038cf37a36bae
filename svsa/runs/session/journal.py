"""The current run of a session with its samples, events, lanes, metrics and record."""

import math
from collections import deque
from collections.abc import Callable

from svsa.actuators.faults import label_fault
from svsa.errors import Fault, StateError
from svsa.runs.definition.command import ApplyLoad, Command, RemoveLoad, Stop
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import MAX_LANES
from svsa.runs.execution.run import Run
from svsa.runs.metrics.window_metrics import WindowMetrics
from svsa.runs.records.header import BranchPoint
from svsa.runs.records.recorder import Recorder
from svsa.runs.session.history import History
from svsa.runs.timeline.events import (
    Event,
    describe_change,
    describe_end,
    describe_onset,
    list_laws,
)
from svsa.runs.timeline.timeline import Timeline
from svsa.simulation.plant.load_table import ScheduledLoad
from svsa.simulation.plant.loads import Load

HISTORY_TICKS = 32_768
KEPT_S = 60.0
MAX_EVENTS = 200
MAX_COMMANDS = 100_000

ApplyLoads = Callable[[tuple[Load, ...]], None]
"""Called with the active loads whenever they change."""


def apply_no_loads(loads: tuple[Load, ...]) -> None:
    """Do nothing: a simulation needs no operator for its loads."""


class Journal:
    """The current run of a session, advanced and changed only here, with its history.

    Attributes:
        initial: Configuration at tick 0; with `commands` it determines the run's samples.
        version: Incremented with every change, not with time.
        timeline: Controllers of the lanes over time, and the current window.
        metrics: Metrics of the lanes.
        on_recorded: Called for each recording that ends.
        branch_of: The recorded run that this one continues.
    """

    def __init__(self, run: Run, is_bench: bool = False, hang: ApplyLoads = apply_no_loads) -> None:
        self.recorder: Recorder | None = None
        self.on_recorded: Callable[[Recorder], None] = lambda _: None
        self.run_number = 0
        self.version = 0
        self.history = History(MAX_LANES, HISTORY_TICKS)
        self._is_bench, self._hang = is_bench, hang
        self.begin(run)

    def begin(self, run: Run) -> None:
        """Replace the run, at its first tick."""
        self.initial = run.configuration
        self.commands: list[Command] = []
        self.branch_of: BranchPoint | None = None
        self.run = run
        self.run_number += 1
        self.history.clear(len(run.lanes))
        self.events: deque[Event] = deque(maxlen=MAX_EVENTS)
        self._reported: deque[Event] = deque(maxlen=MAX_EVENTS)
        self.timeline = Timeline(run.configuration, self._is_bench, KEPT_S / run.period_s)
        self.metrics = WindowMetrics(len(run.lanes), run.period_s)
        self.version += 1

    def build_restart(self) -> Configuration:
        """Build the run restarted with the current settings and the initially planned loads."""
        return self.run.configuration.with_loads_of(self.initial)

    def check_recordable(self) -> None:
        """Raise `StateError` if the run is already being recorded."""
        if self.recorder is not None:
            raise StateError("The session is being recorded already: stop that recording first.")

    def start_recording(self, recorder: Recorder) -> None:
        """Pass commands and events so far to the recorder, and every sample from now on."""
        self.check_recordable()
        for command in self.commands:
            recorder.write_command(command.tick, command.to_json())
        for event in self._reported:
            recorder.write_event(event)
        self.recorder = recorder
        self.version += 1

    def stop_recording(self) -> None:
        """End the recording, if there is one; its file is finished in the background."""
        if self.recorder is not None:
            recorder, self.recorder = self.recorder, None
            recorder.close(wait_s=0.0)
            self.on_recorded(recorder)
            self.version += 1

    def check(self, command: Command) -> None:
        """Raise `StateError` if the command is not allowed now."""
        if len(self.commands) >= MAX_COMMANDS:
            raise StateError(f"{MAX_COMMANDS} changes were made to this run: reset it first.")
        if command.kind == "comparisons" and self.recorder is not None:
            raise StateError("A recording has the same lanes throughout: stop it first.")

    def enter(self, command: Command) -> Command:
        """Apply a command to the run at its tick, and return it; if rejected, nothing changes."""
        loads = {load.number: load for load in self.run.loads}
        before = self.run.configuration
        answer = self.run.change(command)
        self.commands.append(command)
        if self.recorder is not None:
            self.recorder.write_command(command.tick, command.to_json())
        self._follow(command)
        match command:
            case ApplyLoad():
                if isinstance(answer, ScheduledLoad) and answer.start_tick < self.run.tick:
                    self._hang_loads()
                self.version += 1
            case RemoveLoad():
                taken = loads[command.argument]
                if taken.is_on(self.run.tick - 1):
                    self._end_load(taken.load)
                    self.timeline.remove_load(taken.load, self.run.tick)
                    self.metrics.begin_window(self.run.tick)
                self.version += 1
            case _:
                self.log(command.kind, describe_change(command, list_laws(before)))
        return command

    def _follow(self, command: Command) -> None:
        """Give lanes the past that they continue; in a new window metrics restart."""
        window = self.timeline.window
        origins = self.timeline.take(command)
        if origins is not None:
            self.history.rearrange(origins)
            self.metrics.rearrange(origins, is_fresh=self.run.tick == 0)
        if self.timeline.window is not window:
            self.metrics.begin_window(self.run.tick)

    def log(self, kind: str, label: str) -> None:
        """Log an event at the current tick."""
        self.events.append(Event(self.run.tick, self.run.time_s, kind, label))
        self.version += 1

    def report(self, kind: str, label: str) -> None:
        """Log a bench's own event at the current tick, also in a record."""
        self.log(kind, label)
        self._reported.append(self.events[-1])
        if self.recorder is not None:
            self.recorder.write_event(self.events[-1])

    def begin_stop(self) -> None:
        """Start a window for a bench's ramp to zero, whose error belongs to no other window."""
        if self.timeline.window.kind != "stop":
            self.enter(Stop(tick=self.run.tick))

    def log_fault(self, fault: Fault, ends_run: bool = True) -> None:
        """Log a fault; a fault that ends the run also ends its recording.

        A fault of a bench at rest is at the run's last tick. If an event of the fault already
        exists, such as of the fault that ended the run, its name stays.
        """
        self.version += 1
        if ends_run and self.recorder is not None:
            self.recorder.write_fault(fault)
        last = self.events[-1] if self.events else None
        if ends_run or last is None or (last.kind, last.tick) != ("fault", self.run.tick):
            self.log("fault", label_fault(fault.code))

    def refine_fault(self, fault: Fault) -> None:
        """Extend the description of the current fault, also in a record."""
        written = self.recorder.fault if self.recorder is not None else None
        if self.recorder is not None and written is not None and written.code == fault.code:
            self.recorder.write_fault(fault)
        self.version += 1

    def advance(self, ticks: int) -> None:
        """Advance by `ticks` ticks, in slices that end at the start or end of a load.

        A bench may have fewer samples than expected: the run then stays at its last one.
        """
        end = self.run.tick + ticks
        while self.run.tick < end and self.run.fault is None:
            self._log_loads()
            stretch = min(self._find_next_edge(), end) - self.run.tick
            samples = self.history.get_free_rows(len(self.run.lanes), stretch)
            first, done = self.run.tick, self.run.advance(samples)
            if not done and self.run.fault is None:
                return
            self.history.commit(done)
            if self.recorder is not None:
                self.recorder.write_samples(first, samples[:, :done].transpose(1, 0, 2))
            self.metrics.update(samples[:, :done])
            if self.run.fault is not None:
                self.log_fault(self.run.fault)

    def _log_loads(self) -> None:
        for _, load, start, end, _ in self.run.loads:
            if start == self.run.tick:
                self._begin_load(load)
            if end == self.run.tick:
                self._end_load(load)

    def _begin_load(self, load: Load) -> None:
        self.log("load_on", describe_onset(load))
        self.timeline.begin_load(load, self.run.tick)
        self.metrics.begin_load(self.run.tick)
        self._hang_loads()

    def _end_load(self, load: Load) -> None:
        self.log("load_off", describe_end(load))
        self._hang_loads()

    def _hang_loads(self) -> None:
        on = (held for held in self.run.loads if held.is_on(self.run.tick))
        self._hang(tuple(held.load for held in on))

    def _find_next_edge(self) -> int:
        edges = [edge for load in self.run.loads for edge in (load.start_tick, load.end_tick)]
        later = [int(edge) for edge in edges if self.run.tick < edge < math.inf]
        return min(later, default=self.run.tick + HISTORY_TICKS)
