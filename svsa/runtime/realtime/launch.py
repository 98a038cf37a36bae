"""Start the processes of a bench, the loop and its supervisor, and talk with the loop."""

import contextlib
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from svsa.errors import ParameterError, StateError, SvsaError, Violation
from svsa.hardware.heartbeat import Heartbeats
from svsa.runtime.configuration import Configuration
from svsa.runtime.realtime.link import LinkClosedError, build_links
from svsa.runtime.realtime.memory import LoopMemory

LISTEN_S = 0.1
ANSWER_S = 0.5
END_S = 5.0

Teller = Callable[[str, float], None]


def keep_quiet(step: str, seconds: float) -> None:
    """Tell nobody what a loop does while it starts."""


class BenchError(SvsaError):
    """The processes of a bench could not be started, or are gone."""


class BenchProcesses:
    """The loop and the supervisor of one bench, each a process.

    Raises `BenchError` where the loop cannot open the bench, ends, or says nothing for
    silence_s while it starts. tell: hears what it is doing until it is ready, with the seconds
    since its start. `memory`: see `LoopMemory`. `events`: what the loop has said and nobody has
    read yet. `notes`: what real time was granted.
    """

    def __init__(
        self, bench: Path, configuration: Configuration, silence_s: float, tell: Teller
    ) -> None:
        self.memory, self.beats = LoopMemory.create(), Heartbeats.create()
        self.events: list[dict[str, Any]] = []
        self.notes: list[str] = []
        self._number = 0
        self._link, theirs = build_links()
        self.beats.beat("server")
        names = [str(bench), self.memory.name, self.beats.name, str(theirs.fileno())]
        supervise = [str(bench), self.beats.name]
        self._loop = _start("svsa.runtime.realtime.process", names, theirs.fileno())
        self._supervisor = _start("svsa.hardware.supervisor", supervise)
        theirs.close()
        try:
            self._link.send({"configuration": configuration.model_dump(mode="json")})
            self._wait_until_ready(silence_s, tell)
        except (LinkClosedError, BenchError) as error:
            self.close()
            raise BenchError(f"The bench cannot be opened: {error}") from None

    def _wait_until_ready(self, silence_s: float, tell: Teller) -> None:
        """Wait as long as the loop gets on: a first compilation takes what it takes."""
        step, begin = "starting its process", time.monotonic()
        heard = begin
        while (now := time.monotonic()) - heard < silence_s:
            tell(step, now - begin)
            try:
                self._read(LISTEN_S)
            except LinkClosedError:
                raise BenchError(f"its loop has ended, which was {step}.") from None
            while self.events:
                heard, event = time.monotonic(), self.events.pop(0)
                match event["event"]:
                    case "starting":
                        step = event["step"]
                    case "failed":
                        raise BenchError(event["message"])
                    case "ready":
                        self.notes = event["notes"]
                        return
        raise BenchError(
            f"its loop has not got on for {silence_s:g} s: it was {step}. On a slow machine set"
            " [timing] start_silence_s in the bench file."
        )

    @property
    def alive(self) -> bool:
        """Whether the loop's process runs."""
        return self._loop.poll() is None

    @property
    def complete(self) -> bool:
        """Whether the supervisor's process runs too: a bench without it does not get ready."""
        return self.alive and self._supervisor.poll() is None

    def request(self, wanted: str, argument: Any = None) -> dict[str, Any]:
        """Have the loop do something between two ticks, and wait for its answer.

        Raises what the loop refused with (`ParameterError`, `StateError`), and `BenchError`
        where it does not answer in time; a command that comes too late is not carried out.
        """
        self._number += 1
        until = time.monotonic() + ANSWER_S
        message = {"number": self._number, "do": wanted, "argument": argument, "until": until}
        try:
            self._link.send(message)
            while time.monotonic() < until:
                for answer in self._read(until - time.monotonic()):
                    if answer["answer"] == self._number:
                        return _check(answer)
        except LinkClosedError:
            raise BenchError("The loop of the bench is gone.") from None
        raise BenchError(f"The loop of the bench did not answer within {ANSWER_S:g} s.")

    def take_events(self) -> list[dict[str, Any]]:
        """What the loop has said since the last time."""
        with contextlib.suppress(LinkClosedError):
            self._read(0.0)
        events, self.events = self.events, []
        return events

    def _read(self, timeout_s: float) -> list[dict[str, Any]]:
        """The answers that have come; events are kept."""
        messages = self._link.receive(max(timeout_s, 0.0))
        self.events += [message for message in messages if "event" in message]
        return [message for message in messages if "answer" in message]

    def close(self) -> None:
        """Ramp to zero, and end both processes: the supervisor after the loop."""
        with contextlib.suppress(SvsaError):
            self.request("end")
        self._link.close()
        _wait(self._loop)
        self._supervisor.terminate()
        _wait(self._supervisor)
        self.memory.close()
        self.beats.close()


def _start(module: str, arguments: list[str], *descriptors: int) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", module, *arguments]
    return subprocess.Popen(  # noqa: S603
        command, pass_fds=descriptors, stdin=subprocess.DEVNULL, start_new_session=True
    )


def _wait(process: subprocess.Popen[bytes]) -> None:
    """Wait for a process that is ending; one that hangs is killed."""
    try:
        process.wait(END_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _check(answer: dict[str, Any]) -> dict[str, Any]:
    if "refused" not in answer:
        return answer
    if "violations" in answer:
        raise ParameterError(*(Violation(**violation) for violation in answer["violations"]))
    raise StateError(answer["refused"])
