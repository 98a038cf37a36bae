"""The session of a bench in the server."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from svsa.actuators.signals import State
from svsa.errors import Fault, StateError
from svsa.hardware.description.calibration import find_calibration, list_problems
from svsa.hardware.description.file import read_bench
from svsa.hardware.realtime.configuration import build_bench_configuration, check_loads
from svsa.hardware.realtime.launch import ReportProgress, Rest, ignore_progress
from svsa.hardware.safety.machine import MOVING, BenchStatus
from svsa.hardware.session.commands import BenchCommands
from svsa.hardware.session.report import BenchReport
from svsa.hardware.session.run import BenchRun, describe_start
from svsa.hardware.session.supervised_loop import SupervisedLoop
from svsa.inputs.extras import require_extra
from svsa.runs.definition.command import Command, JointNumber, check_joint
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Start
from svsa.runs.records.header import PlantKind
from svsa.runs.records.recorder import Recorder
from svsa.runs.session.clock import Pace
from svsa.runs.session.journal import Journal
from svsa.runs.session.session import PROGRAM_ERROR, Operator, Status
from svsa.simulation.loop.lane import AT_REST

UNWATCHED_S = 1.0


class BenchSession:
    """A `Session` of a bench: `start` begins a run at t = 0, `pause` ramps to zero torque.

    Every start begins a new run, from the measured position.

    Attributes:
        bench: The bench file.
        loop: Its processes, which are being started until `open` returns.
        report: Their reports.

    Args:
        operator: Called with the active loads whenever they change, and at the marks.
        rest: Lets time pass while a command waits for the bench; `wake` waits for nothing.

    Raises:
        BenchError: If the loop is silent.
        MissingExtraError: Without the extra `bench`.
    """

    def __init__(
        self,
        name: str,
        path: Path,
        request: Configuration,
        operator: Operator | None = None,
        rest: Rest = time.sleep,
    ) -> None:
        require_extra("bench")
        self.name = name
        self.watched = self.closed = False
        self.bench, self._operator = read_bench(path), operator or Operator()
        self.calibration = find_calibration(self.bench)
        self._unwatched_since = 0.0
        self.loop = SupervisedLoop(path, self.bench, rest)
        configuration = build_bench_configuration(self.bench, request)
        self.loop.launch(configuration)
        self._run = self._build_still_run(configuration)
        self.journal = Journal(self._run, is_bench=True, hang=self._operator.hang)
        problems = list_problems(self.bench, self.calibration)
        self.report = BenchReport(self.loop, self.journal, problems)
        self._commands = BenchCommands(self.journal, self._ask, self._is_moving, rest)

    def _build_still_run(self, configuration: Configuration) -> BenchRun:
        """Build a run without motion, for the time until the processes are ready."""
        still = Start(self.bench.home.lever_ratio, AT_REST)
        return BenchRun(configuration, still, self.loop.memory, is_still=True)

    def _begin(self, run: BenchRun) -> None:
        self._run = run
        self.journal.begin(run)

    def open(self, notify: ReportProgress = ignore_progress) -> None:
        """Wait until the bench can be armed; `notify` receives the activity of the loop.

        Raises:
            BenchError: If it cannot be opened.
        """
        try:
            self.loop.open(notify)
        finally:
            self.journal.version += 1

    @property
    def run(self) -> BenchRun:
        """The current run."""
        return self._run

    @property
    def version(self) -> int:
        """Version of the journal."""
        return self.journal.version

    @property
    def bench_status(self) -> BenchStatus:
        """State reported by the loop; FAULT if the report is outdated."""
        return self.report.status

    @property
    def status(self) -> Status:
        """running during motion, fault until it is cleared, else paused."""
        if self.fault is not None:
            return "fault"
        return "running" if self.bench_status in MOVING else "paused"

    @property
    def emulated(self) -> bool | None:
        """Whether the bus reported an emulator; None before it was read."""
        return self.loop.emulated

    def _is_moving(self) -> bool:
        return self.status == "running"

    @property
    def plant(self) -> PlantKind:
        """A bench, or the emulator."""
        return "emulated" if self.emulated else "bench"

    @property
    def fault(self) -> Fault | None:
        """The bench's latched fault."""
        return self.report.fault

    @property
    def pace(self) -> Pace:
        """Real-time pace."""
        return Pace()

    def load(self, configuration: Configuration) -> None:
        """Use law, references and loads from the next start on.

        Raises:
            StateError: During motion.
        """
        self._load(build_bench_configuration(self.bench, configuration))

    def _load(self, configuration: Configuration) -> None:
        check_loads(configuration.loads)
        self._ask("load", configuration.model_dump(mode="json"))
        self._operator.hang(())
        self.journal.stop_recording()
        self._begin(self._build_still_run(configuration))

    def reset(self) -> None:
        """Restart at t = 0 at the next start.

        Raises:
            StateError: During motion.
        """
        self._load(self.journal.build_restart())

    def arm(self) -> None:
        """Bring the drives to READY: reset, configuration, mode."""
        self.loop.check_started()
        if self.bench_status is BenchStatus.OFF:
            self._operator.set_to_marks()
        self._ask("arm")

    def confirm_home(self, step: str, by: str) -> None:
        """Confirm that an axis is at its zero mark; `by` is the name of the observer."""
        self._ask("home", {"step": step, "by": by})

    def clear(self) -> None:
        """Clear the latched fault: FAULT → OFF; loop and supervisor are restarted if one has
        ended.
        """
        if self.loop.loss is not None or not self.loop.processes.supervisor_alive:
            self.restart()
        elif self.report.loop_status is BenchStatus.FAULT:
            self._ask("clear")
        self.report.clear()
        self.journal.version += 1

    def restart(self) -> None:
        """Restart loop and supervisor, by force if they do not respond.

        Raises:
            StateError: During motion.
            BenchError: If the bench cannot be opened.
        """
        if self.loop.starting:
            raise StateError("The loop of the bench is being started already.")
        if self.bench_status in MOVING:
            raise StateError("The bench is moving: stop it before you restart its loop.")
        self.journal.version += 1
        try:
            self.loop.restart(self._restart)
        finally:
            self.journal.version += 1

    def _restart(self) -> None:
        configuration = self.run.configuration
        self.journal.stop_recording()
        self.loop.launch(configuration)
        self.report.begin()
        self._begin(self._build_still_run(configuration))

    def prepare_recording(self) -> None:
        """Check as `Session.prepare_recording`, once it is known whether the bench is emulated."""
        self.loop.check_started()
        if self.emulated is None:
            raise StateError(
                "It is not known yet whether the bench is emulated: repeat the request."
            )
        self.journal.check_recordable()
        if not self._is_moving() and self.run.tick:
            self.reset()

    def start_recording(self, recorder: Recorder) -> None:
        """As `Journal.start_recording`."""
        self.journal.start_recording(recorder)

    def stop_recording(self) -> None:
        """As `Journal.stop_recording`."""
        self.journal.stop_recording()

    def start(self) -> None:
        """Start a run.

        Raises:
            StateError: Unless READY, homed and watched.
        """
        if self.bench.safety.needs_watcher and not self.watched:
            raise StateError("No client watches this bench: open its page or a stream first.")
        answer = self._ask("start")
        start = Start(answer["mu0"], State(*answer["x"]))
        recorder = self.journal.recorder
        if recorder is not None:
            if recorder.status.ticks:
                self.journal.stop_recording()
            else:
                recorder.write_fault(None)
                mu0, motion, count = answer["mu0"], answer["motion"], len(self.journal.commands)
                recorder.write_start(describe_start(self.bench, mu0, motion, count))
        self._begin(BenchRun(self.run.configuration, start, self.loop.memory))

    def pause(self) -> None:
        """Ramp to zero torque."""
        if self.bench_status in MOVING:
            self._ask("stop", "stopped by hand")

    def halt(self, why: str = PROGRAM_ERROR) -> None:
        """Ramp to zero torque, without waiting for the loop's report."""
        self.loop.processes.report("stop", why)

    def quick_stop(self) -> None:
        """Quick stop: zero current, latched, even if the loop does not respond."""
        # Through shared memory first, because that works without an answer of the loop.
        self.stop_from_keyboard()
        self.report.check_for_loss()
        if self.loop.loss is None and not self.loop.starting:
            self._ask("quick_stop", "quick stop")

    def stop_from_keyboard(self) -> None:
        """Quick stop without waiting for the loop's report."""
        self.loop.request_quick_stop()

    def note_operator_beat(self) -> None:
        """Note a message of the operator, which holds the dead-man's switch."""
        self.loop.processes.beats.beat("operator")

    def step(self, ticks: int) -> None:
        """Raise `StateError`: a bench has no single ticks."""
        raise StateError("A bench runs in real time: it cannot run single ticks.")

    def set_speed(self, factor: float) -> None:
        """Raise `StateError`: a bench runs in real time."""
        raise StateError("A bench runs in real time: its speed cannot be changed.")

    def burst(self, now: float) -> None:
        """Update as `wake`: a bench runs in real time."""
        self.wake(now)

    def wake(self, now: float) -> None:
        """Read the samples and events of the bench since the last call; does not block."""
        if self.loop.starting:
            return
        self.loop.processes.beats.beat("server")
        states = self.loop.take_states()
        self.report.check_for_stop(states)
        if not self._commands.is_pending:
            self.journal.advance(self._run.count_ready())
        self.report.take(states)
        self.report.check_for_loss()
        if self.watched or self.bench_status is not BenchStatus.RUN:
            self._unwatched_since = now
        elif self.bench.safety.needs_watcher and now - self._unwatched_since > UNWATCHED_S:
            self._unwatched_since = now
            self.loop.processes.report("stop", "no client watches")

    def _ask(self, action: str, argument: object = None) -> dict[str, Any]:
        """Send a request to the loop; its state is up to date on return."""
        answer = self.loop.ask(action, argument)
        states = self.loop.take_states()
        self.report.check_for_stop(states)
        self.report.take(states)
        return answer

    def change(self, command: Command) -> Command:
        """Apply a command at the tick reported by the loop, and return it with this tick."""
        return self._commands.change(command)

    def set(self, command: Command) -> None:
        """Apply a command unless nothing would change."""
        self._commands.patch(lambda _: command)

    def patch(
        self,
        build: Callable[[Configuration], Command],
        joint: JointNumber | None = None,
        again: bool = False,
    ) -> None:
        """Apply `set` after the loop has answered earlier changes."""
        check_joint(self.run.configuration, joint)
        if again:
            self.change(build(self.run.configuration))
        else:
            self._commands.patch(build)

    def close(self) -> None:
        """Ramp to zero, and end the bench's processes."""
        self.journal.stop_recording()
        self.loop.close()
        self.closed = True
