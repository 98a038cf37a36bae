"""The lab's side of an isolated law: one request per tick, with a time limit.

One process computes one run, or several in parallel.
"""

import os
import select
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, ExitStack
from time import monotonic, perf_counter
from types import TracebackType
from typing import Self

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.teaching.isolation.confinement import BOUNDS, Bounds, Command, confine
from svsa.teaching.isolation.frames import (
    ANSWER,
    ASK,
    BEGIN,
    DOUBLES,
    FAILED,
    PAIR,
    READY,
    ROW,
    TICK,
    TORQUE,
)
from svsa.teaching.isolation.refusal import LawFaultCode, LawFaultError

SHOWN_BYTES = 2000
_NUMBERS = 512
_NO_MORE_S = 2.0
_SIGNAL_BASE = 128

Place = Callable[[bytes, int, Bounds], AbstractContextManager[Command]]


class RunningLaw:
    """The process of a law; it computes as many runs as there are models.

    `cost_s` is the time of each answer including communication, s.

    Args:
        models: Nominal model of each run (`Actuator`), which `build` of the law receives.
        place: `confine`, or `leave_open` for a trusted law.

    Raises:
        LawFaultError: If the law fails.
        NotIsolatedError: If it cannot be confined.
    """

    def __init__(
        self, source: bytes, models: Sequence[Actuator], bounds: Bounds, place: Place
    ) -> None:
        self._bounds = bounds
        self._numbers = b""
        self._got = b""
        self._runs = len(models)
        self._length = ANSWER.size + self._runs * PAIR.size
        self.cost_s: list[float] = []
        with ExitStack() as opened:
            # A file, bounded by `output_bytes`: if no process reads it, a full pipe would block a
            # law that prints.
            self._output = opened.enter_context(tempfile.TemporaryFile())
            asked, self._asking = os.pipe()
            opened.callback(os.close, self._asking)
            self._answers, answering = os.pipe()
            opened.callback(os.close, self._answers)
            try:
                command = opened.enter_context(place(source, answering, bounds))
                self._process = subprocess.Popen(  # noqa: S603  words of our own, no shell
                    command.words, stdin=asked, stdout=self._output, stderr=self._output,
                    pass_fds=(answering,), cwd=command.folder, env={}, start_new_session=True,
                )  # fmt: skip
                opened.callback(self._end)
            finally:
                os.close(asked)
                os.close(answering)
            # A law that does not read must not block the lab, which then reports "late".
            os.set_blocking(self._asking, False)
            os.set_blocking(self._answers, False)
            self._poll = select.poll()
            self._poll.register(self._answers, select.POLLIN)
            self._end_s = monotonic() + bounds.whole_s
            rows = [ROW.pack(*model, *[0.0] * (DOUBLES - len(model))) for model in models]
            self._ask(BEGIN, b"".join(rows), READY, bounds.start_s)
            self._opened = opened.pop_all()

    def answer(self, rows: bytes) -> bytes:
        """Return the torques (`PAIR`) for the arguments (`ROW`) of each run's law, in order."""
        begin = perf_counter()
        torques = self._ask(TICK, rows, TORQUE, self._bounds.answer_s)
        self.cost_s.append(perf_counter() - begin)
        return torques

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """End the process and its children."""
        self._opened.close()

    def read_output(self) -> str:
        """Return the end of the law's output to stdout and stderr, without the path of the Python
        installation, which may contain the name of a user.
        """
        # `pread`, because the position of the file is where the law's next output goes.
        descriptor = self._output.fileno()
        begin = max(0, os.fstat(descriptor).st_size - SHOWN_BYTES)
        output = os.pread(descriptor, SHOWN_BYTES, begin).decode("utf-8", "replace")
        return output.replace(sys.base_prefix, "")

    def _ask(self, kind: int, rows: bytes, expected: int, wait_s: float) -> bytes:
        number = self._draw_number()
        asked = ASK.pack(kind, int.from_bytes(number, "little"), self._runs) + rows
        try:
            written = os.write(self._asking, asked)
        except BrokenPipeError:
            raise self._describe_end() from None
        except BlockingIOError:
            written = 0
        if written < len(asked):
            raise self._fail("late", "The law does not read what it is asked.")
        answer = self._read_answer(wait_s)
        answered, echoed = ANSWER.unpack_from(answer)
        if echoed != int.from_bytes(number, "little"):
            raise self._fail("early", "The law answered what it was not asked.")
        if answered == FAILED:
            raise self._fail("error", "The law raised an error.")
        if answered != expected:
            raise self._fail("garbled", f"The law wrote a frame of kind {answered}.")
        return answer[ANSWER.size :]

    def _read_answer(self, wait_s: float) -> bytes:
        # Both bounds are needed: many answers, each just within its time limit, could take hours.
        end_s = min(monotonic() + wait_s, self._end_s)
        got = b""
        while len(got) < self._length:
            left_s = end_s - monotonic()
            if left_s <= 0 or not self._poll.poll(left_s * 1000):
                whole_s = self._bounds.whole_s
                message = (
                    f"The law's run took more than {whole_s:g} s."
                    if end_s == self._end_s
                    else f"The law did not answer within {wait_s:g} s."
                )
                raise self._fail("late", message)
            more = os.read(self._answers, self._length - len(got))
            if not more:
                raise self._describe_end()
            got += more
        return got

    def _draw_number(self) -> bytes:
        if not self._numbers:
            self._numbers = os.urandom(8 * _NUMBERS)
        number, self._numbers = self._numbers[:8], self._numbers[8:]
        return number

    def _describe_end(self) -> LawFaultError:
        try:
            code = self._process.wait(_NO_MORE_S)
        except subprocess.TimeoutExpired:
            return self._fail("ended", "The law closed its end of the pipe.")
        # bwrap reports a signal of its child as exit code 128 + signal number.
        number = -code if code < 0 else code - _SIGNAL_BASE
        if number in (signal.SIGKILL, signal.SIGXCPU):
            bound = self._bounds.cpu_s
            return self._fail("ended", f"The law was ended: it had {bound} s of the processor.")
        return self._fail("ended", f"The law's process ended with code {code}.")

    def _fail(self, code: LawFaultCode, message: str) -> LawFaultError:
        self._end()
        return LawFaultError(code, message, self.read_output())

    def _end(self) -> None:
        """Kill bwrap, the first process of its namespace, and with it every process in it."""
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()


class LawProcess(RunningLaw):
    """An isolated law as a `Controller` of `svsa.simulate`; one process per run.

    `torques` are its answers, (u1, u2), N·m. See `RunningLaw`.
    """

    def __init__(
        self, source: bytes, model: Actuator, bounds: Bounds = BOUNDS, place: Place = confine
    ) -> None:
        self.torques: list[tuple[float, float]] = []
        super().__init__(source, [model], bounds, place)

    def __call__(
        self,
        time_s: float,
        reference: Reference,
        x: State,
        w: Disturbance,
        applied: Torque,
        measured: Positions,
    ) -> tuple[float, float]:
        """Compute the law's torque, N·m."""
        row = ROW.pack(time_s, *reference, *x, *w, *applied, *measured)
        u1, u2 = PAIR.unpack(self.answer(row))
        self.torques.append((u1, u2))
        return u1, u2


class GroupProcess(RunningLaw):
    """An isolated law as a `GroupController` of `svsa.runs.execution.batch.run_group`.

    One process for at most eight runs, with a separate law for each; `models` has one per run. See
    `RunningLaw`.
    """

    def __init__(
        self,
        source: bytes,
        models: Sequence[Actuator],
        bounds: Bounds = BOUNDS,
        place: Place = confine,
    ) -> None:
        super().__init__(source, models, bounds, place)

    def __call__(self, time_s: float, is_asked: np.ndarray, observed: np.ndarray) -> np.ndarray:
        """Compute torques (8, 2), N·m; 0 for a run that has ended."""
        count, torques = self._runs, np.zeros((len(observed), 2))
        rows = np.empty((count, DOUBLES))
        rows[:, 0] = np.where(is_asked[:count], time_s, np.nan)
        rows[:, 1:] = observed[:count]
        torques[:count] = np.frombuffer(self.answer(rows.tobytes())).reshape(count, 2)
        return torques
