"""The bench of a lab: opened with progress on the console, set up for a step of the course."""

from collections.abc import Callable

from rich.console import Console

from svsa.errors import StateError, SvsaError
from svsa.hardware.session.session import BenchSession
from svsa.runs.definition.command import Set, is_held
from svsa.runs.definition.configuration import Configuration
from svsa.runs.session.session import Session
from svsa.teaching.course.steps import Experiment
from svsa_server.sessions.waiting import run_waiting

REPEAT_S = 10.0
_RECOVERY_HINT = (
    "The lab is served without its bench. Fix the cause, then press Restart loop on the"
    " page, or POST /api/v1/sessions/{}/bench/restart."
)


async def open_bench(session: Session, console: Console | None = None) -> None:
    """Open the bench of a session, if it has one, and report progress on the console."""
    if not isinstance(session, BenchSession):
        return
    console = console or Console(stderr=True, soft_wrap=True)
    report = show_steps(console)
    try:
        await run_waiting(session.open, report)
    except SvsaError as error:
        console.print(str(error), style="bold red", markup=False, highlight=False)
        console.print(_RECOVERY_HINT.format(session.name), markup=False, highlight=False)
    else:
        console.print("The bench is ready: you can arm it.", highlight=False)


def show_steps(console: Console) -> Callable[[str, float], None]:
    """Build a function that prints the progress of a bench's loop every ten seconds."""
    reported_s = 0.0

    def report(step: str, seconds: float) -> None:
        nonlocal reported_s
        if seconds - reported_s >= REPEAT_S:
            reported_s = seconds
            text = f"The bench is {step} ({seconds:.0f} s) …"
            console.print(text, highlight=False, markup=False)

    return report


def check_for_step(session: BenchSession, step: Experiment) -> None:
    """Raise `StateError` if this bench cannot be set to the step, now or at all."""
    if step.bench is None:
        raise StateError(
            f"Step {step.name!r} can only be simulated, because a bench has its own plant and"
            " effects: set up a simulated session."
        )
    check_at_rest(session)


def check_at_rest(session: BenchSession) -> None:
    """Raise `StateError` if the loop is not started, or the bench moves."""
    session.loop.check_started()
    if session.status == "running":
        raise StateError("The bench is moving: stop it, and wait until its speed is zero.")


def set_up_bench(session: BenchSession, asked: Configuration) -> None:
    """Set law, references, loads and the settings of law and observers, for the next start."""
    session.load(asked)
    for command in (
        Set("gains", asked.gains),
        Set("parameters", asked.parameters),
        Set("observer", asked.observer),
        Set("spring", asked.spring),
    ):
        if not is_held(session.run.configuration, command):
            session.change(command)
