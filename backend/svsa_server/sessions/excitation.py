"""The identification excitation of a session: timed references, recorded."""

import asyncio
import logging
from collections import deque

from svsa.actuators.installed import find_mechanism
from svsa.actuators.parameters import SVSA
from svsa.analysis.identification.excitation import EXCITATION_DURATION_S, build_commands
from svsa.errors import StateError, SvsaError
from svsa.runs.session.session import Session
from svsa_server.schemas.runs.run import ExcitationState
from svsa_server.sessions.waiting import run_waiting

FASTEST_SPEED = 10.0
TAG = "identification"
_BREAKS_OFF = ("position", "stiffness", "stop")
_PERIOD_S = 1.0 / 60.0
_log = logging.getLogger("svsa")


class Excitation:
    """The excitation from this tick of a session's run on.

    It ends with the recording: when it is complete, or earlier if the run ends, a user sets another
    reference, or the run rejects one. `is_interrupted`: whether it was interrupted.
    """

    def __init__(self, session: Session) -> None:
        self._session, self._run_number = session, session.journal.run_number
        self._first_tick = session.run.tick
        self._waiting = deque(build_commands(session.run.period_s, self._first_tick))
        self._seen = len(session.journal.commands)
        self.is_interrupted = False

    @property
    def elapsed_s(self) -> float:
        """Time played so far, s."""
        return (self._session.run.tick - self._first_tick) * self._session.run.period_s

    @property
    def over(self) -> bool:
        """Whether the excitation has ended or was interrupted."""
        session = self._session
        return (
            session.journal.recorder is None
            or session.journal.run_number != self._run_number
            or session.status == "fault"
            or self.elapsed_s >= EXCITATION_DURATION_S
            or any(
                command.kind in _BREAKS_OFF for command in session.journal.commands[self._seen :]
            )
        )

    async def play(self) -> None:
        """Apply each reference when it is due, until the end; an error interrupts it."""
        try:
            while not (self.is_interrupted or self.over):
                await run_waiting(self._give_due)
                await asyncio.sleep(_PERIOD_S)
        except SvsaError as error:
            name = self._session.name
            _log.warning("The excitation of session %s was interrupted. %s", name, error)

    def _give_due(self) -> None:
        while self._waiting and self._waiting[0].tick <= self._session.run.tick:
            command = self._waiting.popleft()
            self._session.change(command)
            self._seen = len(self._session.journal.commands)


def check_excitable(session: Session) -> None:
    """Raise `StateError` if the excitation could not be used for an identification."""
    if session.run.configuration.arm is not None:
        raise StateError("The identification is of a single joint, and this session is of an arm.")
    mechanism = find_mechanism(session.run.configuration.actuator)
    if mechanism.name != SVSA:
        raise StateError(
            f"The identification is of the SVSA, and this session simulates {mechanism.title}."
        )
    if session.journal.recorder is not None:
        raise StateError("The session is being recorded: stop the recording first.")
    if any(load.end_tick > session.run.tick for load in session.run.loads):
        raise StateError("A load is active or scheduled: remove every load first.")
    if session.pace.speed > FASTEST_SPEED:
        raise StateError(f"Speed {session.pace.speed:g} is too fast: at most {FASTEST_SPEED:g}.")


def build_excitation(excitation: Excitation | None) -> ExcitationState | None:
    """Return its progress, or None."""
    if excitation is None:
        return None
    return ExcitationState(elapsed_s=excitation.elapsed_s, duration_s=EXCITATION_DURATION_S)
