"""A session: a run that people start, pause, change and watch."""

import math
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from svsa.control.gains import Gains
from svsa.errors import StateError
from svsa.observer.disturbance import ObserverBandwidth
from svsa.parameters import ActuatorParameters
from svsa.plant.disturbances import Load, MassLoad, PaperLoad, ScheduledLoad
from svsa.reference.trajectories import PositionReference, StiffnessReference
from svsa.runtime.clock import SimulationClock
from svsa.runtime.configuration import Configuration, Law
from svsa.runtime.history import History
from svsa.runtime.metrics import RunningMetrics
from svsa.runtime.run import Run

HISTORY_TICKS = 32_768
MOST_EVENTS = 200

Status = Literal["running", "paused", "fault"]


@dataclass(frozen=True)
class Event:
    """Something that changed the run: when, of what kind, and in words."""

    tick: int
    time_s: float
    kind: str
    label: str


class Session:
    """A simulated run with a clock, a history and metrics. Not safe across threads."""

    def __init__(self, name: str, configuration: Configuration) -> None:
        self.name = name
        self.run_number = 0
        self.version = 0
        self.history = History(HISTORY_TICKS)
        self.clock = SimulationClock(configuration.sampling.period_s)
        self._running = False
        self.load(configuration)

    @property
    def status(self) -> Status:
        """running, paused, or fault (which only `reset` and `load` leave)."""
        if self.run.fault is not None:
            return "fault"
        return "running" if self._running else "paused"

    def load(self, configuration: Configuration) -> None:
        """Begin a new run of this configuration at t = 0; running or paused as before."""
        self.clock.stop()
        self.clock.stretched_s = 0.0
        self._initial = configuration
        self.run = Run(configuration)
        self.run_number += 1
        self.history.clear()
        self.events: deque[Event] = deque(maxlen=MOST_EVENTS)
        self.since_start = RunningMetrics(self.run.period_s)
        self.since_load: RunningMetrics | None = None
        self.version += 1

    def reset(self) -> None:
        """Begin again at t = 0 with everything as it is set now and no load but planned ones."""
        self.load(self.run.configuration.changed(loads=self._initial.loads))

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

    def set_position(self, reference: PositionReference) -> None:
        """See `Run.set_position`."""
        self._change(lambda: self.run.set_position(reference), "position", "Motion changed")

    def set_stiffness(self, reference: StiffnessReference) -> None:
        """See `Run.set_stiffness`."""
        self._change(lambda: self.run.set_stiffness(reference), "stiffness", "Stiffness changed")

    def set_law(self, law: Law) -> None:
        """See `Run.set_law`."""
        self._change(lambda: self.run.set_law(law), "controller", f"{law.upper()} on")

    def set_gains(self, gains: Gains) -> None:
        """See `Run.set_gains`."""
        self._change(lambda: self.run.set_gains(gains), "gains", "Gains changed")

    def set_observer(self, observer: ObserverBandwidth) -> None:
        """See `Run.set_observer`."""
        self._change(lambda: self.run.set_observer(observer), "observer", "Observer changed")

    def set_actuator(self, actuator: ActuatorParameters) -> None:
        """See `Run.set_actuator`."""
        self._change(lambda: self.run.set_actuator(actuator), "actuator", "Plant changed")

    def set_nominal(self, nominal: ActuatorParameters) -> None:
        """See `Run.set_nominal`."""
        self._change(lambda: self.run.set_nominal(nominal), "nominal", "Nominal model changed")

    def add_load(self, load: Load) -> ScheduledLoad:
        """See `Run.add_load`; the onset is logged and starts the metrics since the load."""
        scheduled = self.run.add_load(load)
        self.version += 1
        return scheduled

    def remove_load(self, number: int) -> None:
        """See `Run.remove_load`."""
        load = self.run.remove_load(number)
        if load.start_tick < self.run.tick <= load.end_tick:
            self._log("load_off", f"{describe_load(load.load)} off")
        self.version += 1

    def clear_loads(self) -> None:
        """Take every load off."""
        for load in self.run.loads:
            self.remove_load(load.number)

    def _change(self, change: Callable[[], None], kind: str, label: str) -> None:
        change()
        self._log(kind, label)

    def _log(self, kind: str, label: str) -> None:
        self.events.append(Event(self.run.tick, self.run.time_s, kind, label))
        self.version += 1

    def _advance(self, ticks: int) -> None:
        """Run `ticks` ticks, in stretches that end where a load comes or goes."""
        end = self.run.tick + ticks
        while self.run.tick < end and self.run.fault is None:
            self._log_loads()
            stretch = min(self._find_next_edge(), end) - self.run.tick
            samples = self.history.get_free_rows(stretch)
            done = self.run.advance(samples)
            self.history.commit(done)
            self.since_start.update(samples[:done])
            if self.since_load is not None:
                self.since_load.update(samples[:done])
            if self.run.fault is not None:
                self.clock.stop()
                self._log("fault", self.run.fault.code)

    def _log_loads(self) -> None:
        for _, load, start, end in self.run.loads:
            if start == self.run.tick:
                self._log("load_on", f"{describe_load(load)} on")
                self.since_load = RunningMetrics(self.run.period_s)
            if end == self.run.tick:
                self._log("load_off", f"{describe_load(load)} off")

    def _find_next_edge(self) -> int:
        edges = [edge for load in self.run.loads for edge in (load.start_tick, load.end_tick)]
        later = [int(edge) for edge in edges if self.run.tick < edge < math.inf]
        return min(later, default=self.run.tick + HISTORY_TICKS)


def describe_load(load: Load) -> str:
    """A load in a few words, for events."""
    match load:
        case PaperLoad():
            return "3 kg load"
        case MassLoad():
            return f"{load.mass_kg:g} kg mass"
        case _:
            return f"{load.kind.capitalize()} torque"
