"""A session whose first lane is a bench, seen from the server."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from svsa.bench.calibration import find_calibration, list_problems
from svsa.bench.file import read_bench
from svsa.bench.homing import STEPS, Axis
from svsa.bench.realtime.configuration import build_bench_configuration
from svsa.bench.realtime.launch import BenchProcesses, Rest, Teller, keep_quiet
from svsa.bench.realtime.loss import LOSSES, Loss, find_loss, is_supervised
from svsa.bench.safety.machine import MOVING, BenchStatus
from svsa.errors import Fault, StateError
from svsa.extras import require_extra
from svsa.loop.loop import AT_REST
from svsa.plant.disturbances import Load
from svsa.records.header import PlantKind
from svsa.records.recorder import Recorder
from svsa.reference.trajectories import Trajectory
from svsa.run.command import Command, build_command
from svsa.run.configuration import Configuration, Lane
from svsa.run.run import Start
from svsa.session.bench_run import BenchRun
from svsa.session.session import Session, Status
from svsa.signals import State

UNWATCHED_S = 1.0
CHANGING_S = 0.001
UNKNOWN_S = 0.25
"""So long after the last tick it may not be known yet who stops the drives."""


class Hands:
    """Whoever stands at the bench: a person, who needs no telling, or a stand-in."""

    def hang(self, loads: tuple[Load, ...]) -> None:
        """These loads and no others are on."""

    def set_to_marks(self) -> None:
        """Set the mechanism to its zero marks, before it is armed."""


MOST_POINTS_IN_MOTION = 200


def check_takes_no_time(reference: Trajectory) -> None:
    """Raise `StateError` for a curve that the loop could not take in between two ticks.

    One of 200 points takes it 2 ms, one of 2000 points 7 ms: long enough to lose the bench.
    """
    curve = reference.get_shape().curve
    if curve is not None and len(curve.breaks) > MOST_POINTS_IN_MOTION:
        raise StateError(
            f"The reference has {len(curve.breaks)} points, and a bench that moves takes one of"
            f" {MOST_POINTS_IN_MOTION} at most: stop it, set the reference, and run it again."
        )


class BenchSession(Session):
    """A bench as a session: `start` begins a run at t = 0, `pause` ramps to zero torque.

    Every start begins a new run, from where the bench stands. hands: told of the loads that
    are on whenever they change, and of the marks. rest: lets time pass where a command waits for
    the bench; `wake` waits for nothing. `bench`: the bench file. `starting`: its processes are
    being started, until `open` returns, and refuse commands. Raises `BenchError` where the loop is
    silent, `MissingExtraError` without the extra `bench`.
    """

    def __init__(
        self,
        name: str,
        path: Path,
        wanted: Configuration,
        hands: Hands | None = None,
        rest: Rest = time.sleep,
    ) -> None:
        require_extra("bench")
        self.bench, self._path, self._hands = read_bench(path), path, hands or Hands()
        self._rest = rest
        self.calibration = find_calibration(self.bench)
        self.starting = True
        self._told_status = BenchStatus.OFF
        self._changing = 0
        self.problems = list_problems(self.bench, self.calibration)
        self.homing_step: Axis | None = STEPS[0].name
        self._fault: Fault | None = None
        self._unwatched_since = 0.0
        super().__init__(name, wanted)

    def _build_first_run(self, configuration: Configuration) -> BenchRun:
        return self._launch(build_bench_configuration(self.bench, configuration))

    def _launch(self, configuration: Configuration) -> BenchRun:
        """Start the processes; the run that stands still until they are ready, and after."""
        self.processes = BenchProcesses(self._path, configuration, self._rest)
        self.memory = self.processes.memory
        return self._build_still_run(configuration)

    def _build_still_run(self, configuration: Configuration) -> BenchRun:
        still = Start(self.bench.home.lever_ratio, AT_REST)
        return BenchRun(configuration, still, self.memory)

    def open(self, tell: Teller = keep_quiet) -> None:
        """Wait until the bench may be armed; raises `BenchError` where it cannot be opened.

        tell: hears what the loop does meanwhile.
        """
        try:
            self.processes.wait_until_ready(self.bench.timing.start_silence_s, tell)
        finally:
            self.starting = False
            self.version += 1

    @property
    def bench_status(self) -> BenchStatus:
        """As the loop says; FAULT where it cannot be believed any more."""
        return self._told_status if self._fault is None else BenchStatus.FAULT

    @property
    def loss(self) -> Loss | None:
        """What has become of the loop where it does not tick, and who stopped the drives."""
        return None if self.starting else find_loss(self.processes)

    @property
    def status(self) -> Status:
        """Running while the bench moves, fault until it is cleared, else paused."""
        if self._fault is not None:
            return "fault"
        return "running" if self.bench_status in MOVING else "paused"

    @property
    def plant(self) -> PlantKind:
        """A bench, or the emulated rig, which says so on the bus."""
        return "emulated" if self.memory.fields["emulated"] else "bench"

    @property
    def fault(self) -> Fault | None:
        """The bench's latched fault."""
        return self._fault

    @property
    def supervised(self) -> bool:
        """Whether the supervisor is there and its heartbeat fresh."""
        return is_supervised(self.processes)

    def load(self, configuration: Configuration) -> None:
        """Use its law, references and loads from the next start on; `StateError` in motion."""
        configuration = build_bench_configuration(self.bench, configuration)
        self._ask("load", configuration.model_dump(mode="json"))
        self.stop_recording()
        self._begin(self._build_still_run(configuration))

    def reset(self) -> None:
        """Begin again at t = 0 at the next start; raises `StateError` in motion."""
        self.load(self.run.configuration.changed(loads=self.initial.loads))

    def arm(self) -> None:
        """Bring the drives to READY: reset, configuration, mode."""
        self._check_started()
        if self.bench_status is BenchStatus.OFF:
            self._hands.set_to_marks()
        self._ask("arm")

    def confirm_home(self, step: str, by: str) -> None:
        """That an axis stands at its zero mark, and who says so."""
        self._ask("home", {"step": step, "by": by})

    def clear(self) -> None:
        """Clear the latched fault: FAULT → OFF; loop and supervisor begin anew if one is gone."""
        if self.loss is not None or not self.processes.supervisor_alive:
            self.restart()
        elif self._told_status is BenchStatus.FAULT:
            self._ask("clear")
        self._fault = None
        self.version += 1

    def restart(self) -> None:
        """End loop and supervisor, by force where they do not listen, and start both anew.

        Raises `StateError` in motion, and `BenchError` where the bench cannot be opened.
        """
        if self.starting:
            raise StateError("The loop of the bench is being started already.")
        if self.bench_status in MOVING:
            raise StateError("The bench is moving: stop it before its loop is started anew.")
        self.starting = True
        self.version += 1
        try:
            before = self.processes
            before.end()
            self.stop_recording()
            self._begin(self._launch(self.run.configuration))
            before.free()
            self._told_status, self._fault = BenchStatus.OFF, None
            self.homing_step = STEPS[0].name
            self.open()
        finally:
            self.starting = False
            self.version += 1

    def start_recording(self, recorder: Recorder) -> None:
        """As `Session.start_recording`, once it is known whether the bench is emulated."""
        self._check_started()
        super().start_recording(recorder)

    def start(self) -> None:
        """Begin a run; raises `StateError` unless READY, at home and watched."""
        if self.bench.safety.needs_watcher and not self.watched:
            raise StateError("Nobody watches this bench: open the page or a stream of it first.")
        answer = self._ask("start")
        configuration = self.run.configuration
        start = Start(answer["mu0"], State(*answer["x"]))
        if self.recorder is not None:
            if self.recorder.status.ticks:
                self.stop_recording()
            else:
                self.recorder.write_fault(None)
        self._begin(BenchRun(configuration, start, self.memory))

    def pause(self) -> None:
        """Ramp to zero torque."""
        if self.bench_status in MOVING:
            self._ask("stop", "stopped by hand")

    def quick_stop(self) -> None:
        """The quick stop: zero current now, latched, even where the loop does not listen."""
        self.stop_from_keyboard()
        self._look_for_loss()
        if self.loss is None and not self.starting:
            self._ask("quick_stop", "quick stop")

    def halt(self) -> None:
        """Ramp to zero torque, without waiting for the loop to say that it does."""
        self.processes.tell("stop", "an error of the program")

    def stop_from_keyboard(self) -> None:
        """The quick stop from any thread, through shared memory alone."""
        self.memory.fields["quick_stop"] = 1

    def close(self) -> None:
        """Ramp to zero, and end the bench's processes."""
        self.stop_recording()
        self.processes.end()
        self.processes.free()
        self.closed = True

    def step(self, ticks: int) -> None:
        """Refused: a bench has no single ticks."""
        raise StateError("A bench runs in real time: it cannot go by single ticks.")

    def set_speed(self, factor: float) -> None:
        """Refused: a bench has the speed of the world."""
        raise StateError("A bench runs in real time: its speed cannot be changed.")

    def hear_operator(self) -> None:
        """The operator holds the dead-man's switch."""
        self.processes.beats.beat("operator")

    def wake(self, now: float) -> None:
        """Take in what the bench has done since the last time; waits for nothing."""
        if self.starting:
            return
        self.processes.beats.beat("server")
        if not self._changing:
            self._advance(self._bench_run.count_ready())
        self._take_events()
        self._look_for_loss()
        if self.watched or self.bench_status is not BenchStatus.RUN:
            self._unwatched_since = now
        elif self.bench.safety.needs_watcher and now - self._unwatched_since > UNWATCHED_S:
            self._unwatched_since = now
            self.processes.tell("stop", "nobody watches")

    def _begin_load(self, load: Load) -> None:
        super()._begin_load(load)
        self._hang_loads()

    def _end_load(self, load: Load) -> None:
        super()._end_load(load)
        self._hang_loads()

    def _hang_loads(self) -> None:
        """Tell the emulated rig what hangs on it at this tick."""
        tick = self.run.tick
        on = (load for load in self.run.loads if load.start_tick <= tick < load.end_tick)
        self._hands.hang(tuple(load.load for load in on))

    def _take_state(self, event: dict) -> None:
        self.problems, self.homing_step = event["problems"], event["homing_step"]
        fault, is_loss = event["fault"], self._fault is not None and self._fault.code in LOSSES
        if fault is None:
            self._fault = self._fault if is_loss else None
        elif self._fault is None or is_loss:
            self._latch(Fault(**fault))
        self._told_status = BenchStatus(event["status"])
        self.version += 1

    def _look_for_loss(self) -> None:
        """Latch what has become of a loop that does not tick; what was done may come to be known.

        The loop's own fault, where it has one or comes back with one, is the better reason.
        """
        loss, fault = self.loss, self._fault
        if loss is None or not (fault is None or fault.code in LOSSES):
            return
        if loss.stopped_by is None and 0.0 < self.processes.silence_s < UNKNOWN_S:
            return
        if fault is None or fault.message != loss.message:
            run = self.run
            self._latch(Fault(loss.code, 0, run.tick, run.time_s, loss.message))

    def _latch(self, fault: Fault) -> None:
        is_known = self._fault is not None and self._fault.code == fault.code
        self._fault = fault
        self.version += 1
        if not is_known:
            self._tell_fault(fault, ends_run=self._told_status in MOVING)

    def _ask(self, wanted: str, argument: object = None) -> dict:
        """Have the loop do it; what it says of its state is known when this returns."""
        self._check_started()
        answer = self.processes.request(wanted, argument)
        self._take_events()
        return answer

    def _check_started(self) -> None:
        if self.starting:
            raise StateError(
                f"The bench is being started ({self.processes.step},"
                f" {self.processes.age_s:.0f} s): ask again when it is ready."
            )

    def _take_events(self) -> None:
        for event in self.processes.take_events():
            if event["event"] == "state":
                self._take_state(event)

    def patch(self, kind: str, build: Callable[[Configuration], Any]) -> None:
        """As `Session.patch`, once the loop has answered to every change before."""
        self._wait_for_changes()
        super().patch(kind, build)

    def _wait_for_changes(self) -> None:
        while self._changing:
            self._rest(CHANGING_S)

    def _take(self, command: Command) -> Command:
        """The command at the tick at which the loop has taken it."""
        if command.kind in ("position", "stiffness") and self.status == "running":
            check_takes_no_time(command.argument)
        if command.kind == "rivals":
            self._wait_for_changes()
            twin = Lane(law=self.run.configuration.law)
            others = tuple(lane for lane in command.argument if lane != twin)
            command = build_command(command.tick, "rivals", (twin, *others))
        self._changing += 1  # what comes after this tick is not taken in before it is known
        try:
            tick = self._ask("change", command.to_json())["tick"]
        finally:
            self._changing -= 1
        self._advance(tick - self.run.tick)
        return command._replace(tick=tick)

    @property
    def _bench_run(self) -> BenchRun:
        if not isinstance(self.run, BenchRun):
            raise StateError("The session has no run of the bench yet.")
        return self.run
