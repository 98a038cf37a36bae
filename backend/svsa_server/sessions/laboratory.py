"""The sessions of this server and the background task that advances them."""

import asyncio
import itertools
import logging
import math
import secrets
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from svsa.errors import StateError
from svsa.hardware.description.file import read_bench
from svsa.hardware.emulator.control import EmulatorControl, EmulatorError
from svsa.hardware.realtime.configuration import build_first_experiment
from svsa.hardware.session.session import BenchSession
from svsa.runs.definition.command import Command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design
from svsa.runs.definition.paper import get_figure
from svsa.runs.session.session import Operator, Session
from svsa.runs.session.simulated import SimulatedSession
from svsa.simulation.plant.loads import Load
from svsa_server.access.roles import INSTRUCTOR
from svsa_server.leases.lease import ControlLease
from svsa_server.problems import TooManyError, UnknownError
from svsa_server.sessions.hosted import HostedSession, LogEndedLease
from svsa_server.sessions.preparation import prepare_change
from svsa_server.sessions.waiting import pause

WAKE_PERIOD_S = 1.0 / 60.0
OPERATOR_POLL_S = 0.005
OPERATOR_TIMEOUT_S = 5.0
BURST_S = 0.5 * WAKE_PERIOD_S
SHARED_SESSION = "lab"

_log = logging.getLogger("svsa")


class Laboratory:
    """The sessions by name: the shared one, and private ones that end when they are idle.

    Args:
        max_sessions: Maximum number of private sessions.
        max_each: Maximum number per owner, except for the instructor.
        idle_s: Time after which a private session without requests or streams ends, s.
        control_s: Time after which a control lease without calls and streams expires, s.
        shared_lease: Lease of the shared session of a class.
        log_ended_lease: Called when a control lease passes to the next user in the queue.
    """

    def __init__(
        self,
        shared: Session,
        max_sessions: int,
        idle_s: float,
        control_s: float,
        shared_lease: ControlLease | None = None,
        max_each: int | None = None,
        log_ended_lease: LogEndedLease = lambda hosted, settled: None,
    ) -> None:
        self._note_settled = log_ended_lease
        self.sessions = {
            shared.name: HostedSession(shared, lease=shared_lease, log_ended_lease=log_ended_lease)
        }
        self._max_sessions = max_sessions
        self._idle_s = idle_s
        self._control_s = control_s
        self._most_each = max_each

    def get(self, name: str) -> HostedSession:
        """Return the session of this name, which counts as use.

        Raises:
            UnknownError: If there is none.
        """
        if name not in self.sessions:
            open_to_all = [key for key, hosted in self.sessions.items() if not hosted.owner]
            known = ", ".join(open_to_all[:10])
            raise UnknownError(
                f"There is no session {name[:80]!r}; sessions here: {known}. A private session ends"
                " when no client uses it or the lab restarts: open a new one."
            )
        self.sessions[name].touch()
        return self.sessions[name]

    def create(
        self, configuration: Configuration, owner: str = "", note: str = ""
    ) -> HostedSession:
        """Create a private session, running; rejected as by `check_room`."""
        self.check_room(owner)
        session = SimulatedSession(build_name(), configuration)
        session.start()
        hosted = self._add(session, owner)
        hosted.note = note
        return hosted

    async def branch(
        self,
        configuration: Configuration,
        commands: list[Command],
        tick: int,
        run_id: str,
        owner: str = "",
    ) -> HostedSession:
        """Create a private session, paused, that continues from a recorded run at a tick."""
        self.check_room(owner)
        session = await asyncio.to_thread(
            SimulatedSession.branch, build_name(), configuration, commands, tick, run_id
        )
        return self._add(session, owner)

    def check_room(self, owner: str) -> None:
        """Raise `TooManyError` if this owner has too many sessions, `StateError` if the server
        has.
        """
        own = sum(hosted.owner == owner for hosted in self.sessions.values())
        most = None if owner in ("", INSTRUCTOR.id) else self._most_each
        if most is not None and own >= most:
            raise TooManyError(
                f"{own} private sessions of yours are open, and each person may have {most}: end"
                " one first."
            )
        # Any number of people can join with one code and could use all sessions: one is reserved
        # for the instructor.
        reserved = 1 if owner == INSTRUCTOR.id and not own else 0
        if len(self.sessions) > self._max_sessions + reserved:
            raise StateError(
                f"{self._max_sessions} private sessions are open, which is all this lab allows:"
                " end one, or wait for an idle one to end."
            )

    def _add(self, session: SimulatedSession, owner: str) -> HostedSession:
        session.prepare = prepare_change
        hosted = self.sessions[session.name] = HostedSession(
            session, time.monotonic(), owner, log_ended_lease=self._note_settled
        )
        return hosted

    def end(self, name: str) -> None:
        """End a private session.

        Raises:
            StateError: If it is the shared one.
        """
        self.get(name)
        if name == SHARED_SESSION:
            raise StateError("The shared session is not ended; reset it instead.")
        self._remove(name)

    def close(self) -> None:
        """End every session, recordings first."""
        for hosted in self.sessions.values():
            hosted.close()

    async def run(self) -> None:
        """Wake every session 60 times a second until cancelled; streams send every other time."""
        for sends in itertools.cycle((True, False)):
            begin = time.monotonic()
            self._end_idle(begin)
            self.free_leases(begin)
            for hosted in list(self.sessions.values()):
                self._wake(hosted.session)
                if sends:
                    hosted.round.begin()
            await asyncio.sleep(max(0.001, begin + WAKE_PERIOD_S - time.monotonic()))

    def _wake(self, session: Session) -> None:
        """Wake a session; an error pauses that session and does not stop the others."""
        try:
            if math.isinf(session.pace.speed):
                self._run_unpaced(session)
            else:
                session.wake(time.monotonic())
        except Exception:
            _log.exception("Session %s was paused by an error of the program", session.name)
            session.halt()

    def _run_unpaced(self, session: Session) -> None:
        """Run a session at full speed: bursts of ticks within its share of half the time."""
        others = (hosted.session for hosted in self.sessions.values())
        unpaced = sum(math.isinf(other.pace.speed) for other in others)
        # All unpaced sessions together get half of the time, so that live sessions are not late.
        end = time.monotonic() + BURST_S / unpaced
        while session.status == "running":
            session.burst(time.monotonic())
            if time.monotonic() >= end:
                break

    def free_leases(self, now: float) -> None:
        """End the control of holders that are gone at `now` (monotonic, s), and report it."""
        for hosted in self.sessions.values():
            hosted.release_if_left(now, self._control_s)

    def _end_idle(self, now: float) -> None:
        for name, hosted in list(self.sessions.items()):
            if hosted.is_idle(now, self._idle_s):
                self._remove(name)

    def _remove(self, name: str) -> None:
        self.sessions.pop(name).close()


def build_shared_session(bench: Path | None, design: Design | None = None) -> Session:
    """Build the shared session: Figure 4A running with an interactive load, or a bench.

    `design` is that of the simulation, by default the paper's; a bench has its own, and must still
    be opened.
    """
    if bench is not None:
        first, operator = build_first_experiment(read_bench(bench)), find_operator(bench)
        return BenchSession(SHARED_SESSION, bench, first, operator, pause)
    configuration = get_figure("4a").build_configuration(load=False, design=design)
    session = SimulatedSession(SHARED_SESSION, configuration)
    session.prepare = prepare_change
    session.start()
    return session


class EmulatorOperator(Operator):
    """Operates an emulator as a person operates a bench, one action at a time, in a thread."""

    def __init__(self, control_port: int) -> None:
        self._port = control_port
        # One thread keeps the commands of the emulator in order, and the event loop does not wait
        # for its port.
        self._thread = ThreadPoolExecutor(1, "operator")

    def hang(self, loads: tuple[Load, ...]) -> None:
        """Request that exactly these loads are on."""
        self._thread.submit(self._send_command, lambda control: control.set_loads(loads))

    def set_to_marks(self) -> None:
        """Set the mechanism to its zero marks, and wait until it is there."""
        done = self._thread.submit(self._send_command, EmulatorControl.home)
        end = time.monotonic() + OPERATOR_TIMEOUT_S
        while not done.done():
            if time.monotonic() > end:
                raise StateError(
                    "The emulator was not set to its marks: it has not answered within"
                    f" {OPERATOR_TIMEOUT_S:g} s. Restart the emulator, then arm again."
                )
            pause(OPERATOR_POLL_S)

    def _send_command(self, command: Callable[[EmulatorControl], object]) -> None:
        try:
            with EmulatorControl(self._port, OPERATOR_TIMEOUT_S) as control:
                command(control)
        except EmulatorError as error:
            _log.warning("The emulator was not notified. %s", error)


def find_operator(bench: Path) -> Operator:
    """Return the operator of the bench: a person, or the emulator's stand-in."""
    emulator = read_bench(bench).emulator
    return EmulatorOperator(emulator.control_port) if emulator else Operator()


def build_name() -> str:
    """Draw an unguessable name for a private session."""
    return f"private-{secrets.token_hex(4)}"
