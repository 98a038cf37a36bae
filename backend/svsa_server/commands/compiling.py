"""Compile in child processes: at the start what every session needs, in the background what users
may select, the laws and the loop of other actuators.
"""

import signal
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from svsa.actuators.installed import list_mechanism_names
from svsa.actuators.parameters import SVSA
from svsa.cli import prepare
from svsa.control.installed import PAPERS_LAW, get_law, is_usable, list_law_names
from svsa.numerics.compilation import is_compiled_before
from svsa.numerics.separate_compilation import (
    build_child,
    can_store,
    compile_in_children,
    describe_end,
    end_children,
)
from svsa.simulation.loop.loop import advance
from svsa_server.compiled_loops import LOWEST_PRIORITY, is_compiled_for

OTHER = next(name for name in list_mechanism_names() if name != SVSA)
"""An actuator with the loop that all but the SVSA share."""
PREPARE = (
    f"import os; os.nice({LOWEST_PRIORITY}); from svsa.cli import prepare;"
    f" prepare(); prepare([{PAPERS_LAW!r}], {OTHER!r})"
)
COMPILE_FIRST = "from svsa.cli import main; main()"
END_S = 2.0


class _TerminatedError(BaseException):
    """SIGTERM was received."""


@contextmanager
def finish_before_sigterm() -> Iterator[None]:
    """Leave the block by an exception on SIGTERM, then end the process by that signal.

    The signal would end it at once, also when uvicorn repeats it after the shutdown, and compiling
    processes would write to the cache after the server has ended.
    """

    def leave(number: int, frame: FrameType | None) -> None:
        raise _TerminatedError

    before = signal.signal(signal.SIGTERM, leave)
    try:
        yield
    except _TerminatedError:
        signal.signal(signal.SIGTERM, before)
        signal.raise_signal(signal.SIGTERM)
    finally:
        signal.signal(signal.SIGTERM, before)


@finish_before_sigterm()
def prepare_apart(
    report: Callable[[str], None], laws: tuple[str, ...] = (), actuator: str = SVSA
) -> None:
    """Load the loop and laws, compiled in a child process before if the cache does not have them.

    Args:
        report: Receives the reason if a child fails now or later; this process compiles then.
        laws: Names of laws; none: all installed laws.
        actuator: The actuator, as for `prepare`.
    """
    code, names = 0, laws or tuple(filter(is_usable, list_law_names()))
    is_stored = is_compiled_before(advance) and is_compiled_for(actuator, names[0])
    is_stored = is_stored and all(_is_compiled(get_law(name).control) for name in names)
    if not is_stored and can_store(advance):
        # It writes to the console of this process, as `prepare` does.
        command = [*build_child(COMPILE_FIRST), "compile", *laws, "--actuator", actuator]
        code = subprocess.run(command, stdin=subprocess.DEVNULL, check=False).returncode  # noqa: S603
    if code == 0:
        compile_in_children(report)
    else:
        report(
            f"The process that compiles the control loop has failed: {describe_end(code, '')}."
            " The server compiles it, and keeps the memory of the compiler, up to 0.5 GB."
        )
    prepare(laws or None, actuator)
    compile_in_children(report)


def _is_compiled(control: Any) -> bool:
    return not hasattr(control, "py_func") or is_compiled_before(control)


@contextmanager
def compile_laws() -> Iterator[None]:
    """Compile every installed law and the loop of other actuators, in a separate process.

    It has the lowest priority. It and all other compiling processes end with the block at the
    latest, before SIGTERM ends this process.
    """
    with finish_before_sigterm():
        try:
            with _compile_others():
                yield
        finally:
            end_children()


@contextmanager
def _compile_others() -> Iterator[None]:
    laws = [get_law(name).control for name in filter(is_usable, list_law_names())]
    is_stored = all(map(_is_compiled, laws)) and is_compiled_for(OTHER, PAPERS_LAW)
    if is_stored or not can_store(advance):
        yield
        return
    process = subprocess.Popen(  # noqa: S603  this program itself
        build_child(PREPARE),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        yield
    finally:
        process.terminate()
        try:
            process.wait(END_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
