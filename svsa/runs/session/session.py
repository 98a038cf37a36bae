"""The interface of a session, simulated or on a bench."""

from collections.abc import Callable
from typing import Literal, Protocol

from svsa.errors import Fault
from svsa.runs.definition.command import Command, JointNumber, RemoveLoad
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from svsa.runs.records.header import PlantKind
from svsa.runs.records.recorder import Recorder
from svsa.runs.session.clock import Pace
from svsa.runs.session.journal import Journal
from svsa.simulation.plant.loads import Load

PROGRAM_ERROR = "an error of the program"

Status = Literal["running", "paused", "fault"]


class Session(Protocol):
    """A run with its journal. Not thread-safe.

    Attributes:
        name: Name of the session.
        journal: The run and its history.
        watched: Whether any client watches it, set by its host.
        closed: Whether it has ended for good.
    """

    name: str
    journal: Journal
    watched: bool
    closed: bool

    @property
    def run(self) -> Run:
        """The current run."""
        ...

    @property
    def version(self) -> int:
        """A number that grows with every change, not with time."""
        ...

    @property
    def plant(self) -> PlantKind:
        """The plant of lane 1."""
        ...

    @property
    def status(self) -> Status:
        """running, paused, or fault, which only a command leaves."""
        ...

    @property
    def fault(self) -> Fault | None:
        """The fault that ended the run or stopped the bench; None without."""
        ...

    @property
    def pace(self) -> Pace:
        """Session time relative to wall time."""
        ...

    def load(self, configuration: Configuration) -> None:
        """Start a new run of this configuration at t = 0; a recording ends with its run."""
        ...

    def reset(self) -> None:
        """Restart at t = 0 with the current settings and the planned loads."""
        ...

    def start(self) -> None:
        """Start the run.

        Raises:
            StateError: If it is not allowed.
        """
        ...

    def pause(self) -> None:
        """Bring the run to rest."""
        ...

    def halt(self, why: str = PROGRAM_ERROR) -> None:
        """Pause at once, without waiting for completion."""
        ...

    def quick_stop(self) -> None:
        """Stop at once; a bench latches it."""
        ...

    def stop_from_keyboard(self) -> None:
        """Quick stop from any thread."""
        ...

    def note_operator_beat(self) -> None:
        """Note a message of the watching client, which holds the dead-man's switch."""
        ...

    def step(self, ticks: int) -> None:
        """Run this number of ticks at once.

        Raises:
            StateError: Unless the session is paused.
        """
        ...

    def set_speed(self, factor: float) -> None:
        """Set session seconds per wall second; infinite: full speed."""
        ...

    def wake(self, now: float) -> None:
        """Advance the run to `now` (monotonic wall time, s); does not block."""
        ...

    def burst(self, now: float) -> None:
        """Run some ticks before they are due, if the speed is infinite."""
        ...

    def change(self, command: Command) -> Command:
        """Apply a command at the current tick, not at its own; if rejected, nothing changes.

        A reference that is already followed is restarted with a blend.

        Returns:
            The command with the tick at whose beginning it takes effect.

        Raises:
            ParameterError: If the value is invalid.
            StateError: If the state of the run does not permit it.
        """
        ...

    def set(self, command: Command) -> None:
        """Apply a command unless nothing would change: then no transition, event or window."""
        ...

    def patch(
        self,
        build: Callable[[Configuration], Command],
        joint: JointNumber | None = None,
        again: bool = False,
    ) -> None:
        """Apply `set` with the command that `build` derives from the current configuration.

        Args:
            build: Builds the command; for an arm it is called with each of these joints.
            joint: Joint of an arm; None: both.
            again: Apply it also if nothing would change.

        Raises:
            ParameterError: If the value is invalid for one of the joints; then none is changed.
        """
        ...

    def prepare_recording(self) -> None:
        """Raise `StateError` if the session cannot be recorded.

        For a bench at rest the next run is recorded: the ended one is discarded.
        """
        ...

    def start_recording(self, recorder: Recorder) -> None:
        """Pass all commands so far to the recorder, and every sample from now on."""
        ...

    def stop_recording(self) -> None:
        """End the recording, if there is one; its file is finished in the background."""
        ...

    def close(self) -> None:
        """End the session permanently, its recording first, and notify its clients."""
        ...


def remove_loads(session: Session) -> None:
    """Remove all loads."""
    for load in session.run.loads:
        session.change(RemoveLoad(argument=load.number))


class Operator:
    """The operator of a bench, who gets no commands; a simulated operator follows them."""

    def hang(self, loads: tuple[Load, ...]) -> None:
        """Replace all loads of the run by these."""

    def set_to_marks(self) -> None:
        """Set the mechanism to its zero marks, before it is armed."""
