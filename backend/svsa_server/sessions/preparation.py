"""Code that a change needs is compiled and loaded in a thread, while all sessions continue.

A change of law, lanes, effects or arm may need code that this process has not loaded yet, or that
no process has compiled. The change is first made in a run of its own, which loads that code; the
session then waits neither for the compiler nor for the disk.
"""

import re
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from contextvars import ContextVar
from typing import NamedTuple

from greenlet import getcurrent

from svsa.actuators.faults import FAULT_CODES
from svsa.runs.definition.command import Command, fold
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.arm_run import build_run
from svsa.runs.execution.fault import build_fault
from svsa.runs.session.journal import Journal
from svsa_server.sessions.waiting import WaitingCall, pause

POLL_S = 0.005
MAX_FORMS = 10_000
_FLOAT = re.compile(r"(?<![\w.])-?(\d+\.\d+(e[+-]?\d+)?|\d+e[+-]?\d+|inf|nan)\b")
_WITHOUT_CODE = {"arm", "other_joints", "loads", "position", "sampling", "seed", "stiffness"}
"""Fields whose values the same code reads; those of an arm and of its other joints are listed
separately."""

_prepared: set[tuple[str, str]] = set()


class Conditions(NamedTuple):
    """What must still be true of a request after it has waited.

    Attributes:
        check: Raises an error if the caller may no longer change the session.
        check_revision: Receives the revision before the wait; raises `ChangedError` if it differs.
        read_revision: Returns the revision; None if the request does not depend on it.
    """

    check: Callable[[], object]
    check_revision: Callable[[str], None]
    read_revision: Callable[[], str] | None = None


conditions: ContextVar[Conditions | None] = ContextVar("conditions", default=None)


def rehearse(configuration: Configuration, commands: Sequence[Command] = ()) -> None:
    """Load the code of a configuration, of the changes by these commands, and of faults.

    Raises:
        SvsaError: If the configuration or a command is rejected.
    """
    journal = Journal(build_run(configuration))
    journal.advance(1)
    for command in commands:
        journal.enter(command)
    journal.advance(1)
    run = journal.run
    for code in FAULT_CODES:
        for lane, (blocks, state) in enumerate(zip(run.blocks, run.lanes, strict=True)):
            build_fault(code, lane, run.tick, blocks, state.x)
    if len(_prepared) >= MAX_FORMS:
        _prepared.clear()
    _prepared.add(_describe_form(configuration, commands))


def start_rehearsal(configuration: Configuration, commands: Sequence[Command] = ()) -> Future[None]:
    """Start `rehearse` in a thread for which the end of the server does not wait, if needed."""
    work: Future[None] = Future()
    if _describe_form(configuration, commands) in _prepared:
        work.set_result(None)
        return work
    work.set_running_or_notify_cancel()  # a caller that no longer waits cannot cancel it

    def run() -> None:
        try:
            rehearse(configuration, commands)
        except Exception as error:
            work.set_exception(error)
        else:
            work.set_result(None)

    threading.Thread(target=run, name="preparation", daemon=True).start()
    return work


def prepare_change(configuration: Configuration, commands: Sequence[Command]) -> None:
    """Load the code of a change; other tasks run meanwhile. Outside of a request, do nothing.

    Args:
        configuration: The configuration before.
        commands: The changes; none for the start of a run.

    Raises:
        UnknownError: If the session has ended meanwhile.
        HeldError: If another client has taken control meanwhile.
        ChangedError: If the session was changed meanwhile, and the request depends on it.
    """
    before, after = form = _describe_form(configuration, commands)
    if form in _prepared or (commands and before == after):
        return
    if not isinstance(getcurrent(), WaitingCall):
        return
    request = conditions.get()
    is_bound = request is not None and request.read_revision is not None
    revision = request.read_revision() if request and request.read_revision else ""
    work = start_rehearsal(configuration, commands)
    while not work.done():
        pause(POLL_S)
    # The change itself reports an error.
    if request is not None:
        request.check()
        if is_bound:
            request.check_revision(revision)


def _describe_form(configuration: Configuration, commands: Sequence[Command]) -> tuple[str, str]:
    """Describe what code a change needs: settings before and after, without their numbers."""
    after = configuration
    for command in commands:
        after = fold(after, command)
    return _describe_settings(configuration), _describe_settings(after)


def _describe_settings(configuration: Configuration) -> str:
    parts = [*configuration.joints, *([configuration.arm] if configuration.arm else [])]
    fields = [(name, value) for part in parts for name, value in part if name not in _WITHOUT_CODE]
    return _FLOAT.sub("#", repr(fields))
