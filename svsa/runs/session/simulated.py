"""A simulated run that people start, pause, change, watch and record."""

from collections.abc import Callable, Iterable
from typing import Self

from svsa.errors import Fault, StateError
from svsa.runs.command import Command, is_held
from svsa.runs.configuration import Configuration
from svsa.runs.records.header import BranchPoint, PlantKind
from svsa.runs.records.recorder import Recorder
from svsa.runs.run import Run
from svsa.runs.session.clock import Pace, SimulationClock
from svsa.runs.session.journal import Journal
from svsa.runs.session.session import PROGRAM_ERROR, Status

BURST_TICKS = 2_000


class SimulatedSession:
    """A `Session` of a simulated run: a clock says which ticks are due."""

    def __init__(self, name: str, configuration: Configuration) -> None:
        self.name = name
        self.watched = self.closed = False
        self.journal = Journal(Run(configuration))
        self.clock = SimulationClock(configuration.sampling.period_s)
        self._running = False

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

        The run is simulated again from its start. run_id: id of the run, for clients that ask
        where the session comes from. Raises `StateError` where it had ended before.
        """
        session = cls(name, configuration)
        for command in commands:
            if command.tick < tick:
                session._advance(command.tick - session.run.tick)
                session.change(command)
        session._advance(tick - session.run.tick)
        if session.run.tick < tick:
            ended = session.run.tick
            raise StateError(f"That run ended at tick {ended}, before tick {tick}.")
        session.journal.branch_of = None if run_id is None else BranchPoint(run_id, tick)
        return session

    @property
    def run(self) -> Run:
        """The present run."""
        return self.journal.run

    @property
    def version(self) -> int:
        """That of the journal."""
        return self.journal.version

    @property
    def plant(self) -> PlantKind:
        """Simulated."""
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

    @property
    def pace(self) -> Pace:
        """That of the clock."""
        return self.clock.pace

    def load(self, configuration: Configuration) -> None:
        """Begin a new run of this configuration at t = 0; running or paused as before."""
        run = Run(configuration)
        self.journal.stop_recording()
        self.clock.begin()
        self.journal.begin(run)

    def reset(self) -> None:
        """Begin again at t = 0 with everything as it is set now and no load but planned ones."""
        self.load(self.journal.build_restart())

    def start(self) -> None:
        """Run from now on; raises `StateError` after a fault."""
        if self.run.fault is not None:
            raise StateError(f"The run ended in a fault; reset it first. {self.run.fault.message}")
        self._running = True
        self.journal.version += 1

    def pause(self) -> None:
        """Stop after the present tick; the state stays."""
        self._running = False
        self.clock.stop()
        self.journal.version += 1

    def halt(self, why: str = PROGRAM_ERROR) -> None:
        """As `pause`, which waits for nothing."""
        self.pause()

    def quick_stop(self) -> None:
        """A simulation pauses, and says that it was stopped."""
        if self.status == "running":
            self.pause()
            self.journal.log("quick_stop", "Quick stop")

    def stop_from_keyboard(self) -> None:
        """A simulation has nothing to guard against."""

    def hear_operator(self) -> None:
        """A simulation has no dead-man's switch."""

    def step(self, ticks: int) -> None:
        """Run so many ticks at once; only while paused, else `StateError`."""
        if self.status != "paused":
            raise StateError(f"The session is {self.status}: pause it to go by single ticks.")
        self._advance(ticks)
        self.journal.version += 1

    def set_speed(self, factor: float) -> None:
        """Session seconds a wall second."""
        self.clock.speed = factor
        self.journal.version += 1

    def wake(self, now: float) -> None:
        """Run the ticks that are due at `now` (monotonic wall time, s)."""
        if self.status == "running":
            self._advance(self.clock.take_due_ticks(now))

    def burst(self, now: float) -> None:
        """Run some ticks without waiting for them to be due: as fast as it goes."""
        if self.status == "running":
            self._advance(BURST_TICKS)
            self.clock.count_burst(BURST_TICKS, now)

    def _advance(self, ticks: int) -> None:
        self.journal.advance(ticks)
        if self.run.fault is not None:
            self.clock.stop()

    def change(self, command: Command) -> None:
        """Give the run a command at its present tick."""
        self.journal.check(command)
        self.journal.enter(command.at(self.run.tick))

    def set(self, command: Command) -> None:
        """`change`, unless everything is so already."""
        self.patch(lambda _: command)

    def patch(self, build: Callable[[Configuration], Command]) -> None:
        """`set` by what `build` makes of the present configuration."""
        command = build(self.run.configuration)
        if not is_held(self.run.configuration, command):
            self.change(command)

    def prepare_recording(self) -> None:
        """As `Journal.check_recordable`."""
        self.journal.check_recordable()

    def start_recording(self, recorder: Recorder) -> None:
        """As `Journal.start_recording`."""
        self.journal.start_recording(recorder)

    def stop_recording(self) -> None:
        """As `Journal.stop_recording`."""
        self.journal.stop_recording()

    def close(self) -> None:
        """End the session for good."""
        self.journal.stop_recording()
        self.pause()
        self.closed = True
