"""The session of a simulated run."""

from collections.abc import Callable, Iterable, Sequence
from typing import Self

from svsa.errors import Fault, StateError
from svsa.runs.definition.command import Command, JointNumber, fold, is_held, list_joint_commands
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.arm_run import build_run
from svsa.runs.execution.run import Run
from svsa.runs.records.header import BranchPoint, PlantKind
from svsa.runs.records.recorder import Recorder
from svsa.runs.session.clock import Pace, SimulationClock
from svsa.runs.session.journal import Journal
from svsa.runs.session.session import PROGRAM_ERROR, Status

BURST_TICKS = 2_000
Prepare = Callable[[Configuration, Sequence[Command]], None]
BuildCommands = Callable[[Configuration], list[Command]]


def prepare_nothing(configuration: Configuration, commands: Sequence[Command]) -> None:
    """Do nothing: code is compiled and loaded by the change that needs it."""


class SimulatedSession:
    """A `Session` of a simulated run: a clock determines the due ticks.

    `prepare`: Called with the configuration and the commands before they change it, and with a new
    configuration before its run starts. It may let time pass, in which the session continues.
    """

    def __init__(self, name: str, configuration: Configuration) -> None:
        self.name = name
        self.watched = self.closed = False
        self.journal = Journal(build_run(configuration))
        self.clock = SimulationClock(configuration.sampling.period_s)
        self._running = False
        self.prepare: Prepare = prepare_nothing

    @classmethod
    def branch(
        cls,
        name: str,
        configuration: Configuration,
        commands: Iterable[Command],
        tick: int,
        run_id: str | None = None,
    ) -> Self:
        """Create a paused session that continues a recorded run from `tick`.

        The run is simulated again from its start. `run_id` is the id of the run, which clients can
        query.

        Raises:
            StateError: If the run had ended before `tick`.
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
        """The current run."""
        return self.journal.run

    @property
    def version(self) -> int:
        """Version of the journal."""
        return self.journal.version

    @property
    def plant(self) -> PlantKind:
        """Simulated."""
        return "simulated"

    @property
    def fault(self) -> Fault | None:
        """The fault that ended the run, or None."""
        return self.run.fault

    @property
    def status(self) -> Status:
        """running, paused, or fault (which only `reset` and `load` leave)."""
        if self.run.fault is not None:
            return "fault"
        return "running" if self._running else "paused"

    @property
    def pace(self) -> Pace:
        """Pace of the clock."""
        return self.clock.pace

    def load(self, configuration: Configuration) -> None:
        """Start a new run of this configuration at t = 0; running or paused as before."""
        self.prepare(configuration, ())
        run = build_run(configuration)
        self.journal.stop_recording()
        self.clock.begin()
        self.journal.begin(run)

    def reset(self) -> None:
        """Restart at t = 0 with the current settings and the planned loads."""
        self.load(self.journal.build_restart())

    def start(self) -> None:
        """Start the run.

        Raises:
            StateError: After a fault.
        """
        if self.run.fault is not None:
            raise StateError(f"The run ended in a fault; reset it first. {self.run.fault.message}")
        self._running = True
        self.journal.version += 1

    def pause(self) -> None:
        """Pause after the current tick; the state is kept."""
        self._running = False
        self.clock.stop()
        self.journal.version += 1

    def halt(self, why: str = PROGRAM_ERROR) -> None:
        """Pause."""
        self.pause()

    def quick_stop(self) -> None:
        """Pause, and report the stop."""
        if self.status == "running":
            self.pause()
            self.journal.log("quick_stop", "Quick stop")

    def stop_from_keyboard(self) -> None:
        """Do nothing: a simulation needs no guard."""

    def note_operator_beat(self) -> None:
        """Do nothing: a simulation has no dead-man's switch."""

    def step(self, ticks: int) -> None:
        """Run this number of ticks at once.

        Raises:
            StateError: Unless the session is paused.
        """
        if self.status != "paused":
            raise StateError(f"The session is {self.status}: pause it to run single ticks.")
        self._advance(ticks)
        self.journal.version += 1

    def set_speed(self, factor: float) -> None:
        """Set session seconds per wall second."""
        self.clock.speed = factor
        self.journal.version += 1

    def wake(self, now: float) -> None:
        """Run the ticks that are due at `now` (monotonic wall time, s)."""
        if self.status == "running":
            self._advance(self.clock.take_due_ticks(now))

    def burst(self, now: float) -> None:
        """Run some ticks before they are due, at full speed."""
        if self.status == "running":
            self._advance(BURST_TICKS)
            self.clock.count_burst(BURST_TICKS, now)

    def _advance(self, ticks: int) -> None:
        self.journal.advance(ticks)
        if self.run.fault is not None:
            self.clock.stop()

    def change(self, command: Command) -> Command:
        """Apply a command at the current tick, and return it with this tick."""
        (command,) = self._prepare(lambda _: [command])
        return self._enter(command)

    def set(self, command: Command) -> None:
        """Apply a command unless nothing would change."""
        self._set(lambda _: [command])

    def patch(
        self,
        build: Callable[[Configuration], Command],
        joint: JointNumber | None = None,
        again: bool = False,
    ) -> None:
        """Apply `set` with the command that `build` derives from each joint's configuration."""
        self._set(lambda present: list_joint_commands(present, build, joint), again)

    def _set(self, build: BuildCommands, again: bool = False) -> None:
        commands, after = self._prepare(build), self.run.configuration
        present = after
        for command in commands:
            after = fold(after, command)
        for command in commands:
            if again or not is_held(present, command):
                self._enter(command)

    def _prepare(self, build: BuildCommands) -> list[Command]:
        """Prepare the commands for the present configuration, which may change meanwhile."""
        while True:
            present = self.run.configuration
            commands = build(present)
            self.prepare(present, commands)
            if self.run.configuration is present:
                return commands

    def _enter(self, command: Command) -> Command:
        self.journal.check(command)
        return self.journal.enter(command.at(self.run.tick))

    def prepare_recording(self) -> None:
        """Check as `Journal.check_recordable`."""
        self.journal.check_recordable()

    def start_recording(self, recorder: Recorder) -> None:
        """As `Journal.start_recording`."""
        self.journal.start_recording(recorder)

    def stop_recording(self) -> None:
        """As `Journal.stop_recording`."""
        self.journal.stop_recording()

    def close(self) -> None:
        """End the session permanently."""
        self.journal.stop_recording()
        self.pause()
        self.closed = True
