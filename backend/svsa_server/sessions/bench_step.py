"""An experiment of the course on a bench, which keeps what it is."""

from svsa.errors import StateError
from svsa.hardware.session.session import BenchSession
from svsa.runs.command import Set, is_held
from svsa.teaching.course.steps import Experiment


def check_for_step(session: BenchSession, step: Experiment) -> None:
    """Raise `StateError` where this bench cannot be set to the step, now or at all."""
    if step.bench is None:
        raise StateError(
            f"Step {step.name!r} is simulated and nothing else, and a bench has its own plant and"
            " effects: set up a simulated session."
        )
    session.loop.check_started()
    if session.status == "running":
        raise StateError("The bench is moving: stop it, and wait until it stands.")


def set_up_bench(session: BenchSession, step: Experiment) -> None:
    """Law, references, loads, gains, parameters and observer of the step, for the next start."""
    asked = step.bench_configuration
    session.load(asked)
    for command in (
        Set("gains", asked.gains),
        Set("parameters", asked.parameters),
        Set("observer", asked.observer),
    ):
        if not is_held(session.run.configuration, command):
            session.change(command)
