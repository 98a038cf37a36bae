"""The loop's process: ticks at absolute deadlines, messages between two ticks.

    python -m svsa.hardware.realtime.process BENCH MEMORY HEARTBEATS DESCRIPTOR

The first message is the initial configuration. The process ends on request of the server or when
the server has ended, and leaves the drives at zero current.
"""

import dataclasses
import gc
import sys
import time
from typing import Any

from pydantic_core import to_jsonable_python

from svsa.errors import ParameterError, SvsaError, Violation
from svsa.hardware.description.calibration import find_calibration
from svsa.hardware.description.file import read_bench
from svsa.hardware.plant.can_plant import CanPlant
from svsa.hardware.plant.clock import BenchClock, ClockError, choose_clock
from svsa.hardware.realtime.configuration import build_guard, read_actuation
from svsa.hardware.realtime.link import Link, LinkClosedError
from svsa.hardware.realtime.loop import MOVING, STATUSES, BenchLoop
from svsa.hardware.realtime.memory import LoopMemory, add_to_histogram
from svsa.hardware.realtime.prepared_laws import PreparedLaws, UnpreparedLawError
from svsa.hardware.realtime.warm_up import warm_up
from svsa.hardware.safety.heartbeat import Heartbeats
from svsa.hardware.safety.machine import BenchStatus
from svsa.hardware.schedule import LOOP_PRIORITY, request_real_time
from svsa.numerics.compilation import watch_compilation
from svsa.runs.definition.command import read_command
from svsa.runs.definition.configuration import Configuration

FIRST_MESSAGE_S = 10.0
LISTEN_S = 0.00015
"""Time before a tick at which its frames are read, s; later frames are read in the tick."""


class LoopProcess:
    """One bench, its loop, and the link to the server."""

    def __init__(
        self,
        loop: BenchLoop,
        plant: CanPlant,
        clock: BenchClock,
        server_s: float,
        link: Link,
        memory: LoopMemory,
        beats: Heartbeats,
        laws: PreparedLaws,
    ) -> None:
        self._loop, self._plant, self._clock, self._laws = loop, plant, clock, laws
        self._link: Link | None = link
        self._fields, self._beats, self._server_s = memory.fields, beats, server_s
        self._reported: tuple[Any, ...] = ()
        for motor, heat in zip(self._plant.motors, memory.fields["heat"], strict=True):
            motor.winding.heat = float(heat)
        self._ending = False

    def run(self) -> None:
        """Tick until the server ends the process, or the server is lost and the bench is at
        rest.
        """
        period = self._loop.run.period_s
        self._plant.catch_up()
        deadline = self._clock.now()
        while not (self._ending and self._plant.status not in MOVING):
            deadline += period
            # Frames are fetched before the deadline, and the last 0.15 ms are not slept. Measured:
            # p99 of the cost of a tick 398 to 204 µs, median of the lateness 40 to 1 µs.
            self._clock.wait_until(deadline - LISTEN_S)
            self._plant.listen()
            self._clock.wait_until(deadline)
            # Two clocks: that of the bench, which an emulator in lockstep stops, and the monotonic
            # clock for the cost.
            begin, lateness = self._clock.now(), self._clock.find_lateness(deadline)
            begin_s = time.monotonic()
            missed = int((begin - deadline) / period)
            self._loop.tick(begin, missed)
            # After the tick, so that a loop that blocks in a tick stops beating.
            self._beats.beat("loop")
            self._note(lateness, time.monotonic() - begin_s, missed)
            deadline += missed * period
            # Shared memory reaches the loop even if the link is full or the sessions of the server
            # are blocked.
            if self._fields["quick_stop"]:
                self._fields["quick_stop"] = 0
                self._plant.quick_stop(begin, "quick stop")
            # After the tick: a command must not delay the torque.
            self._listen()
            self._report_state()

    def _note(self, lateness: float, cost: float, missed: int) -> None:
        """Publish the timing of this tick and the readings for the server."""
        fields = self._fields
        add_to_histogram(fields["lateness"], lateness)
        add_to_histogram(fields["cost"], cost)
        fields["worst_s"] = max(float(fields["worst_s"]), lateness)
        fields["ticks"] += 1
        fields["skipped"] += missed
        fields["status"] = STATUSES.index(self._plant.status)
        fields["emulated"] = self._plant.emulated
        for number, motor in enumerate(self._plant.motors):
            fields["heat"][number] = motor.winding.heat
            fields["allowed_nm"][number] = motor.winding.allow()
            fields["is_limited_by_heat"][number] = motor.heat_reduction is not None
        if self._loop.reading is not None:
            fields["current_a"] = self._loop.reading.current_a
            fields["ages_s"] = self._loop.reading.ages_s

    def _listen(self) -> None:
        """Execute the server's requests; stop the bench if the server is lost or hangs."""
        if self._link is None:
            return
        try:
            for message in self._link.receive():
                self._link.send({"answer": message["number"], **self._answer(message)})
            self._link.flush()
        except LinkClosedError:
            self._link, self._ending = None, True
            self._stop("the server has ended")
        is_silent = self._beats.age_s("server") > self._server_s
        if self._plant.status is BenchStatus.RUN and is_silent:
            self._stop("the server is silent")

    def _stop(self, reason: str) -> None:
        if self._plant.status in MOVING:
            self._plant.stop(self._clock.now(), reason)

    def _answer(self, message: dict[str, Any]) -> dict[str, Any]:
        try:
            if time.monotonic() > message["until"]:
                raise SvsaError("The command arrived too late and was not executed.")
            return self._do(message["do"], message.get("argument"))
        except ParameterError as error:
            # A rejected value may be an object that JSON cannot represent.
            violations = to_jsonable_python(error.violations, fallback=repr)
            return {"refused": str(error), "violations": violations}
        except UnpreparedLawError as error:
            return {"refused": str(error), "unprepared": error.arguments}
        except SvsaError as error:
            return {"refused": str(error)}

    def _do(self, action: str, argument: Any) -> dict[str, Any]:
        now, loop, plant = self._clock.now(), self._loop, self._plant
        match action:
            case "change":
                return {"tick": loop.change(read_command(argument))}
            case "load":
                loop.load(Configuration(**argument))
            case "prepare":
                self._laws.add(argument)
            case "arm":
                # Garbage collection is off while the loop runs. No torque is sent at this point.
                gc.collect()
                self._beats.beat("loop")
                plant.arm(now)
            case "start":
                start = loop.start(now)
                report = {"mu0": start.mu0, "x": start.x, "run": loop.number}
                return report | {"motion": loop.read_motion()}
            case "stop":
                plant.stop(now, argument)
            case "quick_stop":
                plant.quick_stop(now, argument)
            case "clear":
                plant.clear(now)
            case "home":
                plant.confirm_home(argument["step"], argument["by"])
            case "end":
                self._ending = True
                self._stop("the server ends")
            case _:
                raise ParameterError(Violation("do", action, "", "a command of the loop"))
        return {}

    def _report_state(self) -> None:
        """Report changes of the bench's state."""
        plant = self._plant
        limited = [motor.name for motor in plant.motors if motor.heat_reduction is not None]
        state = (
            plant.status,
            plant.fault,
            tuple(plant.problems),
            plant.homing_step,
            tuple(limited),
        )
        if self._link is None or state == self._reported:
            return
        self._reported = state
        fault = dataclasses.asdict(plant.fault) if plant.fault else None
        status = {"status": plant.status, "fault": fault, "problems": list(plant.problems)}
        status |= {"homing_step": plant.homing_step, "limited_by_heat": limited}
        try:
            self._link.send({"event": "state", **status})
        except LinkClosedError:
            self._link, self._ending = None, True


class Progress:
    """Reports the activity of a starting loop to the server."""

    def __init__(self, link: Link) -> None:
        self._link = link
        self._functions = 0

    def __call__(self, step: str) -> None:
        """Report that this step starts."""
        self._link.send({"event": "starting", "step": step})

    def count_function(self, name: str) -> None:
        """Count one compiled function."""
        self._functions += 1
        self(f"compiling the loop, once: {self._functions} functions, {name} the last")


def main(arguments: list[str]) -> int:
    """Run the loop of a bench; the exit code is 0 unless the bench could not be opened."""
    path, memory_name, heartbeat_name, descriptor = arguments
    link = Link.from_descriptor(int(descriptor))
    memory, beats = LoopMemory.attach(memory_name), Heartbeats.attach(heartbeat_name)
    report = Progress(link)
    try:
        # The bus comes first: opening it resets the drives, which may hold an old current, and the
        # compilation after it can take 15 s.
        report("opening the bus")
        bench = read_bench(path)
        clock = choose_clock(bench)
        plant = CanPlant(bench, find_calibration(bench), clock, build_guard(bench), beats)
        plant.open()
    except SvsaError as error:
        link.send({"event": "failed", "message": str(error)})
        return 1
    try:
        (first,) = link.receive(FIRST_MESSAGE_S)
        report("loading the compiled loop")
        laws = PreparedLaws()
        try:
            with watch_compilation(report.count_function):
                loop = BenchLoop(
                    plant,
                    read_actuation(bench),
                    bench.home.lever_ratio,
                    Configuration(**first["configuration"]),
                    memory,
                    laws.bind,
                )
                warm_up(loop, laws, report)
        except SvsaError as error:
            link.send({"event": "failed", "message": str(error)})
            return 1
        report("asking for real time")
        link.send({"event": "ready", "notes": request_real_time(LOOP_PRIORITY)})
        LoopProcess(loop, plant, clock, bench.safety.server_s, link, memory, beats, laws).run()
    except LinkClosedError:
        pass
    except ClockError as error:
        sys.stderr.write(f"Loop: {error}\n")
        return 1
    finally:
        # First: zero current, whatever fails afterwards.
        plant.close()
        beats.end("loop")
        memory.close()
        beats.close()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
