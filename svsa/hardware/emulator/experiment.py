"""A figure of the paper on the emulator: through CAN, in lockstep, faster than real time.

Loop, plant and limits are those of a bench; time advances when the loop requests it, so that a run
gives the same samples every time.
"""

import contextlib
import tempfile
from collections.abc import Callable
from pathlib import Path

import tomli_w

from svsa.errors import FaultError, StateError
from svsa.hardware.description.calibration import find_calibration
from svsa.hardware.description.file import BenchFile, read_bench
from svsa.hardware.emulator.bench_file import EMULATOR_BENCH
from svsa.hardware.emulator.launch import RunningEmulator, start_emulator
from svsa.hardware.emulator.parameters import EmulatorParameters
from svsa.hardware.plant.can_plant import CanPlant
from svsa.hardware.plant.clock import LockstepClock
from svsa.hardware.realtime.configuration import (
    build_bench_configuration,
    build_guard,
    read_actuation,
)
from svsa.hardware.realtime.loop import BenchLoop
from svsa.hardware.realtime.memory import SampleArray
from svsa.hardware.safety.heartbeat import Heartbeats
from svsa.hardware.safety.machine import BenchStatus
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.paper import LOAD_TIME_S, Figure
from svsa.runs.result.result import Result
from svsa.simulation.plant.loads import Load

ARMING_S = 5.0
SETTLING_S = 0.2


class LockstepBench:
    """The emulator with the bench's own loop, one tick at a time.

    Args:
        wanted: Law, references and loads of the run.
        ticks: Number of samples to store.
        bench: Bench file; by default that of the emulator.
        beats: Heartbeats, if they are monitored.
    """

    def __init__(
        self,
        emulator: RunningEmulator,
        request: Configuration,
        ticks: int,
        bench: BenchFile | None = None,
        beats: Heartbeats | None = None,
    ) -> None:
        self.emulator = emulator
        self.bench = bench or connect_bench(emulator)
        self.sink = SampleArray(ticks)
        self._clock = LockstepClock()
        calibration, guard = find_calibration(self.bench), build_guard(self.bench)
        self.plant = CanPlant(self.bench, calibration, self._clock, guard, beats)
        self.plant.open()
        self.configuration = build_bench_configuration(self.bench, request)
        actuation, mu0 = read_actuation(self.bench), self.bench.home.lever_ratio
        self.loop = BenchLoop(self.plant, actuation, mu0, self.configuration, self.sink)
        self._deadline = self.now()

    def now(self) -> float:
        """The emulator's time, s."""
        return self._clock.now()

    def tick(self, count: int = 1) -> None:
        """Run `count` periods."""
        for _ in range(count):
            self._deadline += self.bench.timing.period_s
            self._clock.wait_until(self._deadline)
            self.loop.tick(self.now())

    def tick_until(self, status: BenchStatus, longest_s: float = ARMING_S) -> None:
        """Run until the bench has this status.

        Raises:
            FaultError: If the bench has a fault.
            StateError: If the status is not reached in time.
        """
        end = self.now() + longest_s
        while self.plant.status is not status:
            if self.plant.fault is not None:
                raise FaultError(self.plant.fault)
            if self.now() > end:
                raise StateError(f"The bench is {self.plant.status} after {longest_s:g} s.")
            self.tick()

    def prepare(self) -> None:
        """Arm, and confirm the zero marks of the emulator."""
        self.plant.arm(self.now())
        self.tick_until(BenchStatus.READY)
        while (step := self.plant.homing_step) is not None:
            self.plant.confirm_home(step, "lockstep")
        self.tick(round(SETTLING_S / self.bench.timing.period_s))

    def start(self) -> None:
        """Start the run at tick 0."""
        self.loop.start(self.now())

    def close(self) -> None:
        """Set zero current."""
        self.plant.close()


def connect_bench(emulator: RunningEmulator) -> BenchFile:
    """The emulator's bench file, with the ports of this emulator."""
    bench = read_bench(EMULATOR_BENCH)
    options = {**bench.bus.options, "port": emulator.port}
    return bench.changed(bus=bench.bus.changed(options=options))


def run_on_emulator(
    figure: Figure, law: str, duration_s: float, progress: Callable[[float], None]
) -> Result:
    """Run a figure with its load on the emulator; `progress` receives the finished share.

    Raises:
        FaultError: If the run ends in a fault.
    """
    request = figure.build_configuration(law)
    return run_request(request, figure.hung, LOAD_TIME_S, duration_s, progress)


def run_request(
    request: Configuration,
    load: Load,
    onset_s: float,
    duration_s: float,
    progress: Callable[[float], None],
    parameters: EmulatorParameters | None = None,
) -> Result:
    """Run a configuration on the emulator, with a load that the bench does not know.

    Args:
        request: Law, references and spring estimator.
        load: Load on the emulated mechanism.
        onset_s: Its onset, s.
        duration_s: Duration of the run, s.
        progress: Receives the finished share.
        parameters: Of the emulator; by default those of the paper's bench.

    Returns:
        The run.

    Raises:
        FaultError: If the run ends in a fault.
    """
    with contextlib.ExitStack() as stack:
        options: list[str] = []
        if parameters is not None:
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
            values = parameters.model_dump(mode="json", exclude_none=True)
            (folder / "emulator.toml").write_text(tomli_w.dumps(values), encoding="utf-8")
            options = ["--file", str(folder / "emulator.toml")]
        emulator = stack.enter_context(start_emulator(True, 120.0, *options))
        bench = LockstepBench(emulator, request, round(duration_s / 0.001))
        stack.callback(bench.close)
        bench.prepare()
        bench.start()
        emulator.control.load(load.changed(start_s=None), at_s=bench.now() + onset_s)
        ticks = len(bench.sink.samples)
        for tick in range(ticks):
            bench.tick()
            if bench.plant.fault is not None:
                raise FaultError(bench.plant.fault)
            if tick % 100 == 0:
                progress(tick / ticks)
        progress(1.0)
    samples = bench.sink.samples[: bench.sink.done]
    return Result(bench.configuration, samples, law=request.law, plant="emulated")
