"""A session: a run that people start, pause, change, watch and record."""

import math
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal, Self

from svsa.errors import Fault, StateError
from svsa.fault_labels import label_fault
from svsa.plant.disturbances import Load, ScheduledLoad
from svsa.records.header import BranchPoint, PlantKind
from svsa.records.recorder import Recorder
from svsa.run.command import Command, build_command
from svsa.run.configuration import MOST_LANES, Configuration
from svsa.run.run import Run
from svsa.run.timeline import Timeline, describe_change, describe_load
from svsa.run.window_metrics import WindowMetrics
from svsa.session.clock import SimulationClock
from svsa.session.history import History

HISTORY_TICKS = 32_768
KEPT_S = 60.0
BURST_TICKS = 2_000
MOST_EVENTS = 200
MOST_COMMANDS = 100_000

Status = Literal["running", "paused", "fault"]


@dataclass(frozen=True)
class Event:
    """Something that changed the run: when, of what kind, and in words."""

    tick: int
    time_s: float
    kind: str
    label: str


class Session:
    """A simulated run with a clock, a history and metrics. Not safe across threads.

    `initial` and `commands` say everything that decides the run's samples. `version` grows
    with every change, not with time. `timeline` says who controlled which lane from when on, and
    which window this is, `metrics` how well the lanes do. `on_recorded` is told of every recording
    that ends. `watched`: told by its host, whether anybody looks at it. `branch_of` is the
    recorded run that its run goes on from, until a new one begins.
    """

    def __init__(self, name: str, configuration: Configuration) -> None:
        self.name = name
        self.closed = False
        self.watched = False
        self.recorder: Recorder | None = None
        self.on_recorded: Callable[[Recorder], None] = lambda _: None
        self.run_number = 0
        self.version = 0
        self.history = History(MOST_LANES, HISTORY_TICKS)
        self.clock = SimulationClock(configuration.sampling.period_s)
        self._running = False
        self._begin(self._build_first_run(configuration))

    def _build_first_run(self, configuration: Configuration) -> Run:
        return Run(configuration)

    @property
    def plant(self) -> PlantKind:
        """What lane 1 runs on."""
        return "simulated"

    @property
    def fault(self) -> Fault | None:
        """Why the run has ended, or None."""
        return self.run.fault

    @property
    def status(self) -> Status:
        """running, paused, or fault (which only `reset` and `load` leave)."""
        if self.run.fault is not None:
            return "fault"
        return "running" if self._running else "paused"

    def load(self, configuration: Configuration) -> None:
        """Begin a new run of this configuration at t = 0; running or paused as before.

        A recording ends with the run that it recorded.
        """
        self.stop_recording()
        self._begin(Run(configuration))

    def _begin(self, run: Run) -> None:
        """Watch this run from now on, from its first tick."""
        self.clock.stop()
        self.clock.stretched_s = 0.0
        self.initial = run.configuration
        self.commands: list[Command] = []
        self.branch_of: BranchPoint | None = None
        self.run = run
        self.run_number += 1
        self.history.clear()
        self.events: deque[Event] = deque(maxlen=MOST_EVENTS)
        kept_ticks = KEPT_S / run.period_s
        self.timeline = Timeline(run.configuration, self.plant != "simulated", kept_ticks)
        self.metrics = WindowMetrics(len(run.lanes), run.period_s)
        self.version += 1

    @classmethod
    def branch(
        cls,
        name: str,
        configuration: Configuration,
        commands: Iterable[Command],
        tick: int,
        run_id: str | None = None,
    ) -> Self:
        """A session, paused, that goes on from a recorded run as it stood at `tick`.

        The run is simulated again from its start. run_id: which run it is, for whoever asks
        where the session comes from. Raises `StateError` where it had ended before.
        """
        session = cls(name, configuration)
        for command in commands:
            if command.tick < tick:
                session._advance(command.tick - session.run.tick)
                session.change(command.kind, command.argument)
        session._advance(tick - session.run.tick)
        if session.run.tick < tick:
            ended = session.run.tick
            raise StateError(f"That run ended at tick {ended}, before tick {tick}.")
        session.branch_of = None if run_id is None else BranchPoint(run_id, tick)
        return session

    def start_recording(self, recorder: Recorder) -> None:
        """Give the recorder all commands so far, and every sample from now on."""
        if self.recorder is not None:
            raise StateError("The session is being recorded already: stop that recording first.")
        for command in self.commands:
            recorder.write_command(command.tick, command.to_json())
        self.recorder = recorder
        self.version += 1

    def stop_recording(self) -> None:
        """End the recording, if there is one; its file is finished in the background."""
        if self.recorder is not None:
            recorder, self.recorder = self.recorder, None
            recorder.close(wait_s=0.0)
            self.on_recorded(recorder)
            self.version += 1

    def reset(self) -> None:
        """Begin again at t = 0 with everything as it is set now and no load but planned ones."""
        self.load(self.run.configuration.changed(loads=self.initial.loads))

    def start(self) -> None:
        """Run from now on; raises `StateError` after a fault."""
        if self.run.fault is not None:
            raise StateError(f"The run ended in a fault; reset it first. {self.run.fault.message}")
        self._running = True
        self.version += 1

    def pause(self) -> None:
        """Stop after the present tick; the state stays."""
        self._running = False
        self.clock.stop()
        self.version += 1

    def halt(self) -> None:
        """Pause at once, whatever else goes on: after an error of the program."""
        self.pause()

    def quick_stop(self) -> None:
        """The quick stop: a simulation pauses, and says that it was stopped."""
        if self.status == "running":
            self.pause()
            self._log("quick_stop", "Quick stop")

    def hear_operator(self) -> None:
        """Whoever watches holds the dead-man's switch, which a simulation does not have."""

    def stop_from_keyboard(self) -> None:
        """The quick stop from another thread: a simulation has none to guard against."""

    def close(self) -> None:
        """End the session for good; whoever watches it is told."""
        self.stop_recording()
        self.pause()
        self.closed = True

    def step(self, ticks: int) -> None:
        """Run so many ticks at once; only while paused, else `StateError`."""
        if self.status != "paused":
            raise StateError(f"The session is {self.status}: pause it to go by single ticks.")
        self._advance(ticks)
        self.version += 1

    def set_speed(self, factor: float) -> None:
        """Session seconds a wall second."""
        self.clock.speed = factor
        self.version += 1

    def wake(self, now: float) -> None:
        """Run the ticks that are due at `now` (monotonic wall time, s)."""
        if self.status == "running":
            self._advance(self.clock.take_due_ticks(now))

    def burst(self, now: float) -> None:
        """Run some ticks without waiting for them to be due: as fast as it goes."""
        if self.status == "running":
            self._advance(BURST_TICKS)
            self.clock.count_burst(BURST_TICKS, now)

    def change(self, kind: str, argument: Any) -> None:
        """Give the run a command of `KINDS` now; refused, it changes nothing.

        Raises `ParameterError` or `StateError` as the run does.
        """
        if len(self.commands) >= MOST_COMMANDS:
            raise StateError(f"{MOST_COMMANDS} changes were made to this run: reset it first.")
        if kind == "rivals" and self.recorder is not None:
            raise StateError("A recording has the same lanes throughout: stop it first.")
        command = self._take(build_command(self.run.tick, kind, argument))
        loads = {load.number: load for load in self.run.loads}
        before = self.run.configuration
        answer = command.apply(self.run)
        self.commands.append(command)
        if self.recorder is not None:
            self.recorder.write_command(command.tick, command.to_json())
        self._follow(command)
        match kind:
            case "load":
                if isinstance(answer, ScheduledLoad) and answer.start_tick < self.run.tick:
                    self._hang_loads()
                self.version += 1
            case "unload":
                taken = loads[argument]
                if taken.start_tick < self.run.tick <= taken.end_tick:
                    self._end_load(taken.load)
                    self.timeline.take_off(taken.load, self.run.tick)
                    self.metrics.begin_window()
                self.version += 1
            case _:
                self._log(kind, describe_change(command, before))

    def patch(self, kind: str, build: Callable[[Configuration], Any]) -> None:
        """`change` to what `build` makes of the configuration as it is then."""
        self.change(kind, build(self.run.configuration))

    def _take(self, command: Command) -> Command:
        """The command with the tick at which it holds: here, at once."""
        return command

    def clear_loads(self) -> None:
        """Take every load off."""
        for load in self.run.loads:
            self.change("unload", load.number)

    def _follow(self, command: Command) -> None:
        """Lanes have the past of those that they continue; in a new window metrics begin anew."""
        window = self.timeline.window
        origins = self.timeline.take(command)
        if origins is not None:
            self.history.rearrange(origins)
            self.metrics.rearrange(origins, is_fresh=self.run.tick == 0)
        if self.timeline.window is not window:
            self.metrics.begin_window()

    def _log(self, kind: str, label: str) -> None:
        self.events.append(Event(self.run.tick, self.run.time_s, kind, label))
        self.version += 1

    def _tell_fault(self, fault: Fault, ends_run: bool = True) -> None:
        """A fault is an event, and the end of the recording of a run that it ends."""
        if ends_run and self.recorder is not None:
            self.recorder.write_fault(fault)
        self._log("fault", label_fault(fault.code))

    def _advance(self, ticks: int) -> None:
        """Run `ticks` ticks, in stretches that end where a load comes or goes."""
        end = self.run.tick + ticks
        while self.run.tick < end and self.run.fault is None:
            self._log_loads()
            stretch = min(self._find_next_edge(), end) - self.run.tick
            samples = self.history.get_free_rows(len(self.run.lanes), stretch)
            first, done = self.run.tick, self.run.advance(samples)
            self.history.commit(done)
            if self.recorder is not None:
                self.recorder.write_samples(first, samples[:, :done].transpose(1, 0, 2))
            self.metrics.update(samples[:, :done])
            if self.run.fault is not None:
                self.clock.stop()
                self._tell_fault(self.run.fault)

    def _log_loads(self) -> None:
        for _, load, start, end in self.run.loads:
            if start == self.run.tick:
                self._begin_load(load)
            if end == self.run.tick:
                self._end_load(load)

    def _begin_load(self, load: Load) -> None:
        self._log("load_on", f"{describe_load(load)} on")
        self.timeline.begin_load(load, self.run.tick)
        self.metrics.begin_load()

    def _end_load(self, load: Load) -> None:
        self._log("load_off", f"{describe_load(load)} off")

    def _hang_loads(self) -> None:
        """Tell whoever hangs the loads of a bench; a simulation needs nobody to."""

    def _find_next_edge(self) -> int:
        edges = [edge for load in self.run.loads for edge in (load.start_tick, load.end_tick)]
        later = [int(edge) for edge in edges if self.run.tick < edge < math.inf]
        return min(later, default=self.run.tick + HISTORY_TICKS)
