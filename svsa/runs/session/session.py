"""What people start, pause, change, watch and record: a simulated session or a bench."""

from collections.abc import Callable
from typing import Literal, Protocol

from svsa.errors import Fault
from svsa.runs.command import Command, RemoveLoad
from svsa.runs.configuration import Configuration
from svsa.runs.records.header import PlantKind
from svsa.runs.records.recorder import Recorder
from svsa.runs.run import Run
from svsa.runs.session.clock import Pace
from svsa.runs.session.journal import Journal
from svsa.simulation.plant.loads import Load

PROGRAM_ERROR = "an error of the program"

Status = Literal["running", "paused", "fault"]


class Session(Protocol):
    """A run with a journal of it. Not safe across threads.

    `journal`: what is kept of the run. `watched`: set by its host, whether any client watches it.
    `closed`: ended for good.
    """

    name: str
    journal: Journal
    watched: bool
    closed: bool

    @property
    def run(self) -> Run:
        """The present run, of the journal."""
        ...

    @property
    def version(self) -> int:
        """Grows with every change, not with time."""
        ...

    @property
    def plant(self) -> PlantKind:
        """What lane 1 runs on."""
        ...

    @property
    def status(self) -> Status:
        """running, paused, or fault, which it leaves only by a command."""
        ...

    @property
    def fault(self) -> Fault | None:
        """Why the run has ended, or what has stopped the bench; None while it is sound."""
        ...

    @property
    def pace(self) -> Pace:
        """How session time goes against that of the wall."""
        ...

    def load(self, configuration: Configuration) -> None:
        """Begin a new run of this configuration at t = 0; a recording ends with its run."""
        ...

    def reset(self) -> None:
        """Begin again at t = 0 with everything as it is set now and no load but planned ones."""
        ...

    def start(self) -> None:
        """Run from now on; raises `StateError` where it may not."""
        ...

    def pause(self) -> None:
        """Bring the run to rest."""
        ...

    def halt(self, why: str = PROGRAM_ERROR) -> None:
        """As `pause`, at once, whatever else goes on, without waiting for it."""
        ...

    def quick_stop(self) -> None:
        """Stop at once; a bench latches it."""
        ...

    def stop_from_keyboard(self) -> None:
        """The quick stop, from any thread."""
        ...

    def hear_operator(self) -> None:
        """The watching client holds the dead-man's switch."""
        ...

    def step(self, ticks: int) -> None:
        """Run so many ticks at once; `StateError` unless paused."""
        ...

    def set_speed(self, factor: float) -> None:
        """Session seconds a wall second, infinite for as fast as it goes."""
        ...

    def wake(self, now: float) -> None:
        """Take the run to `now` (monotonic wall time, s); waits for nothing."""
        ...

    def burst(self, now: float) -> None:
        """Run some ticks without waiting for them to be due, where the speed is infinite."""
        ...

    def change(self, command: Command) -> None:
        """Give the run a command now, whatever tick it names; refused, it changes nothing.

        A reference that is followed already begins again, faded over.
        Raises `ParameterError` or `StateError` as the run does.
        """
        ...

    def set(self, command: Command) -> None:
        """`change`, but nothing at all where everything is so already: no fade, event or window."""
        ...

    def patch(self, build: Callable[[Configuration], Command]) -> None:
        """`set` by what `build` makes of the configuration as it is then."""
        ...

    def prepare_recording(self) -> None:
        """Before a record is made: raises `StateError` where the session cannot be recorded.

        Of a bench that stands its next run is recorded: the one that has ended is forgotten.
        """
        ...

    def start_recording(self, recorder: Recorder) -> None:
        """Give the recorder all commands so far, and every sample from now on."""
        ...

    def stop_recording(self) -> None:
        """End the recording, if there is one; its file is finished in the background."""
        ...

    def close(self) -> None:
        """End it permanently, its recording first, and notify its clients."""
        ...


def take_loads_off(session: Session) -> None:
    """Take every load off."""
    for load in session.run.loads:
        session.change(RemoveLoad(argument=load.number))


class Hands:
    """An operator, who gets no commands; a simulated one follows them."""

    def hang(self, loads: tuple[Load, ...]) -> None:
        """These loads and no others are on."""

    def set_to_marks(self) -> None:
        """Set the mechanism to its zero marks, before it is armed."""
