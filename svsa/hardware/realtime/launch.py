"""Start of the processes of a bench, loop and supervisor, and communication with the loop.

All waiting uses `rest`: a caller with other work passes its own function.
"""

import contextlib
import math
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from svsa.errors import ParameterError, StateError, SvsaError, Violation
from svsa.hardware.description.file import read_bench
from svsa.hardware.realtime.link import LinkClosedError, build_links
from svsa.hardware.realtime.memory import LoopMemory
from svsa.hardware.realtime.prepared_laws import UnpreparedLawError
from svsa.hardware.safety.heartbeat import Heartbeats
from svsa.runs.definition.configuration import Configuration

if TYPE_CHECKING:
    from svsa.hardware.safety.third_line import ThirdLine

LISTEN_S = 0.1
END_S = 5.0
PATIENCE_S = 0.5
_REST_S = 0.001

Process = subprocess.Popen[bytes]
Rest = Callable[[float], None]
"""Lets this number of seconds pass."""

ReportProgress = Callable[[str, float], None]
COLD = (0.0, 0.0)
"""The heat of both motors before their first run."""


def ignore_progress(step: str, seconds: float) -> None:
    """Ignore the progress of a starting loop."""


class BenchError(StateError):
    """The processes of a bench could not be started, have ended, or are silent."""


class BenchProcesses:
    """The loop and the supervisor of one bench, each in a process that is being started.

    Attributes:
        memory: See `LoopMemory`.
        events: Unread messages of the loop.
        notes: Real-time privileges that were granted.
        step: Current activity of the loop until it is ready.
        failure: Why it did not become ready, or None.
        patience_s: Time after which a loop without ticks counts as silent; a command is answered
            within it.

    Args:
        rest: Lets time pass while they start, answer or end.
        heat: Heat of both motors when the previous loop ended, see `Winding`.
    """

    def __init__(
        self,
        bench: Path,
        configuration: Configuration,
        rest: Rest = time.sleep,
        heat: tuple[float, float] = COLD,
        patience_s: float = PATIENCE_S,
    ) -> None:
        self.memory, self.beats = LoopMemory.create(), Heartbeats.create()
        self.memory.fields["heat"] = heat
        self.events: list[dict[str, Any]] = []
        self.notes: list[str] = []
        self._rest, self.patience_s = rest, patience_s
        self._number = 0
        self._waiting: list[int] = []
        self._answers: dict[int, dict[str, Any]] = {}
        self._link, theirs = build_links()
        # Without a first beat the server counts as silent, and the loop would stop every run.
        self.beats.beat("server")
        names = [str(bench), self.memory.name, self.beats.name, str(theirs.fileno())]
        supervise = [str(bench), self.beats.name]
        self._loop = _start("svsa.hardware.realtime.process", names, theirs.fileno())
        self._supervisor = _start("svsa.hardware.safety.supervisor", supervise)
        # Only the child may keep its end open: otherwise its death would not close the link.
        theirs.close()
        self.third_line = _watch(bench, self.beats, self._loop, self._supervisor)
        with contextlib.suppress(LinkClosedError):  # the server waits for it and reads the reason
            self._link.send({"configuration": configuration.model_dump(mode="json")})
        self.step, self._begun_s = "starting its process", time.monotonic()
        self.failure: str | None = None

    @property
    def age_s(self) -> float:
        """Time since the start, s."""
        return time.monotonic() - self._begun_s

    def wait_until_ready(self, silence_s: float, report: ReportProgress) -> None:
        """Wait while the loop makes progress: a first compilation has no time limit.

        `report` receives the activity, with the seconds since the start.

        Raises:
            BenchError: If the loop cannot open the bench, ends, or is silent for silence_s; both
                processes are then ended.
        """
        try:
            self._wait_until_ready(silence_s, report)
        except (LinkClosedError, BenchError) as error:
            self.failure = f"The bench cannot be opened: {error}"
            self.end()
            raise BenchError(self.failure) from None

    def _wait_until_ready(self, silence_s: float, report: ReportProgress) -> None:
        heard = time.monotonic()
        while time.monotonic() - heard < silence_s:
            report(self.step, self.age_s)
            self._rest(LISTEN_S)
            try:
                self._read()
            except LinkClosedError:
                raise BenchError(f"its loop ended while it was {self.step}.") from None
            while self.events:
                heard, event = time.monotonic(), self.events.pop(0)
                match event["event"]:
                    case "starting":
                        self.step = event["step"]
                    case "failed":
                        raise BenchError(event["message"])
                    case "ready":
                        self.notes = event["notes"]
                        return
        raise BenchError(
            f"its loop has not got on for {silence_s:g} s: it was {self.step}. On a slow machine"
            " set [timing] start_silence_s in the bench file."
        )

    @property
    def alive(self) -> bool:
        """Whether the loop's process runs."""
        return self._loop.poll() is None

    @property
    def supervisor_alive(self) -> bool:
        """Whether the supervisor's process runs: without it the bench does not become ready."""
        return self._supervisor.poll() is None

    @property
    def silence_s(self) -> float:
        """Time since the loop's last tick, s; 0 before the first one, or after a regular end."""
        age = self.beats.age_s("loop")
        return 0.0 if math.isinf(age) else age

    @property
    def listens(self) -> bool:
        """Whether the loop takes requests: its process runs and ticks."""
        return self.alive and self.silence_s <= self.patience_s

    def request(self, action: str, argument: Any = None) -> dict[str, Any]:
        """Send a request for the loop to execute between two ticks, and wait for its answer.

        Requests that wait at the same time are answered in order; a command that arrives too late
        is not executed.

        Raises:
            ParameterError, StateError: If the loop rejects the request.
            BenchError: If the loop is silent or does not answer in time.
        """
        if not self.listens:
            raise BenchError(self._describe_silence())
        # The loop rejects the command after this time: the caller has reported a failure by then,
        # and a late command would contradict it.
        until = time.monotonic() + self.patience_s
        try:
            number = self._send(action, argument, until)
            self._waiting.append(number)
            try:
                while time.monotonic() < until:
                    self._read()
                    # Several requests may wait at a time; the journal needs their answers in order.
                    if number in self._answers and self._waiting[0] == number:
                        return _check(self._answers.pop(number))
                    self._rest(_REST_S)
            finally:
                self._waiting.remove(number)
        except LinkClosedError:
            raise BenchError(self._describe_silence()) from None
        raise BenchError(f"The loop of the bench did not answer within {self.patience_s:g} s.")

    def report(self, action: str, argument: Any = None) -> None:
        """Send a request as `request`, without waiting for its answer."""
        if self.listens:
            with contextlib.suppress(LinkClosedError):
                self._send(action, argument, time.monotonic() + self.patience_s)

    def _describe_silence(self) -> str:
        what = "has been silent" if self.alive else "ended; it has been silent"
        return (
            f"The loop of the bench {what} for {self.silence_s:.1f} s: it accepts no requests."
            " Restart it."
        )

    def _send(self, action: str, argument: Any, until: float) -> int:
        self._number += 1
        message = {"number": self._number, "do": action, "argument": argument, "until": until}
        self._link.send(message)
        return self._number

    def take_events(self) -> list[dict[str, Any]]:
        """Return the loop's events since the last call."""
        with contextlib.suppress(LinkClosedError):
            self._read()
        events, self.events = self.events, []
        return events

    def _read(self) -> None:
        """Read events, and the answer that a request waits for."""
        for message in self._link.receive():
            if "event" in message:
                self.events.append(message)
            elif message["answer"] in self._waiting:
                self._answers[message["answer"]] = message

    def end(self) -> None:
        """Ramp to zero, and end both processes: the supervisor after the loop."""
        with contextlib.suppress(SvsaError):
            self.request("end")
        if self.alive and self.silence_s > self.patience_s:
            self._loop.kill()
        self._link.close()
        self._wait(self._loop)
        # Before the supervisor ends: if loop and supervisor were both gone, it would intervene.
        self.third_line.stop(self._rest)
        self._supervisor.terminate()
        self._wait(self._supervisor)

    def free(self) -> None:
        """Release the shared memory, which is unreadable afterwards."""
        self.memory.close()
        self.beats.close()

    def _wait(self, process: subprocess.Popen[bytes]) -> None:
        """Wait until a process has ended; kill one that hangs."""
        end = time.monotonic() + END_S
        while process.poll() is None and time.monotonic() < end:
            self._rest(_REST_S)
        if process.poll() is None:
            process.kill()
            process.wait()


def _watch(bench: Path, beats: Heartbeats, loop: Process, supervisor: Process) -> "ThirdLine":
    from svsa.hardware.safety.third_line import ThirdLine  # imported here: needs the extra `bench`

    return ThirdLine(read_bench(bench), beats, loop, supervisor)


def _start(module: str, arguments: list[str], *descriptors: int) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", module, *arguments]
    # A session of its own keeps Ctrl-C of the terminal away from loop and supervisor: the server
    # ends them in order.
    return subprocess.Popen(  # noqa: S603
        command, pass_fds=descriptors, stdin=subprocess.DEVNULL, start_new_session=True
    )


def _check(answer: dict[str, Any]) -> dict[str, Any]:
    if "refused" not in answer:
        return answer
    if "violations" in answer:
        raise ParameterError(*(Violation(**violation) for violation in answer["violations"]))
    if "unprepared" in answer:
        raise UnpreparedLawError(answer["unprepared"])
    raise StateError(answer["refused"])
