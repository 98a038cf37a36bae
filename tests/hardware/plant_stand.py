"""A plant under test, simulated or on the wire, with its true state."""

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import svsa
from svsa.actuators.dynamics import compute_deflection
from svsa.actuators.signals import Disturbance, Measurement, State, Torque
from svsa.hardware.bench.reading import Reading
from svsa.hardware.bench.settings import BusSettings
from svsa.hardware.description.calibration import find_calibration
from svsa.hardware.description.file import BenchFile, read_bench
from svsa.hardware.drives.conversion import build_motor_scale, compute_current_ma
from svsa.hardware.drives.phase import Phase
from svsa.hardware.emulator.experiment import connect_bench
from svsa.hardware.emulator.launch import RunningEmulator
from svsa.hardware.emulator.mechanics import Mechanics
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
from svsa.hardware.safety.machine import BenchStatus, Conditions, Machine
from svsa.runs.definition.paper import get_figure
from tests.hardware.wired_bench import EMULATOR_BENCH

AT_REST = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
UNDISTURBED = Disturbance(0.0, 0.0, 0.0)
NO_TORQUE = Torque(0.0, 0.0)
MOTEUS = Path(svsa.__file__).parent / "hardware" / "drives" / "moteus"
FIGURE = get_figure("4a").build_configuration(load=False)
PHASE_S = 0.0007
"""Limit of the paper's gains for an adapter without timestamps, which does not know the age of a
count: the frame of the principal motor, sent at 0.43 ms, must arrive within half a tick.
"""
ARMING_TICKS = 4
"""Arming waits a second for the drives; the contract starts when they are READY."""
UNSTAMPED_AGE_S = 0.0005
"""An adapter without timestamps: a count is half a tick old on average when it is read."""


class SimulatedPlant:
    """The mechanism of Table 1 without drives and wire, within the states and limits of a bench."""

    def __init__(self, bench: BenchFile) -> None:
        self._guard = build_guard(bench)
        self._machine = Machine(bench, self._guard, [])
        self._scales = (build_motor_scale(bench.motor1), build_motor_scale(bench.motor2))
        self.mechanics = Mechanics(EmulatorParameters())
        self.now_s = 0.0

    def __getattr__(self, name: str) -> Any:
        """The state machine, as in a plant of the bench."""
        return getattr(self._machine, name)

    @property
    def homing_step(self) -> str | None:
        return self._machine.homing.next_step

    @property
    def time_us(self) -> int:
        return round(self.now_s * 1e6)

    def arm(self, now: float) -> None:
        self._machine.arm()

    def start(self, now: float) -> None:
        self._machine.start(0.0)

    def stop(self, now: float, reason: str) -> None:
        self._machine.stop()

    def read(self, now: float, known: State) -> Reading:
        x = self.mechanics.read(self.time_us)
        y = Measurement(x.theta1, x.theta2, compute_deflection(x), known.dq, known.dtheta1, 0.0)
        y = y._replace(dtheta2=known.dtheta2)
        return Reading(y, (0.0, 0.0), (0.0, 0.0, 0.0), (0, 0, 0))

    def write(
        self, now: float, asked: Torque, known: State, estimate: Disturbance, missed: int
    ) -> Torque:
        conditions = Conditions(Phase.READY, (0.0, 0.0, 0.0), None, missed, 0.0, 0.0)
        torque = self._machine.update(conditions, asked, known, estimate)
        sent = Torque(
            *(
                compute_current_ma(one, scale) * scale.torque_per_ma
                for one, scale in zip(torque, self._scales, strict=True)
            )
        )
        self._guard.note(sent, (0.0, 0.0))
        self.mechanics.set_target(self.time_us, sent)
        return sent

    def close(self) -> None:
        self.mechanics.set_target(self.time_us, NO_TORQUE)


class Stand:
    """A plant, advancing time, and the true state.

    wait: advances the time to a given time, s. Ticks are at `PHASE_S` of each ms, so frames have
    the same age in every test. describe: returns x, the target torques of the motors, and the modes
    of the drives.
    """

    def __init__(
        self,
        plant: Any,
        bench: BenchFile,
        wait: Callable[[float], None],
        now_s: float,
        describe: Callable[[], tuple[State, list[float], list[Any]]],
    ) -> None:
        self.plant, self.bench, self.describe = plant, bench, describe
        self._wait, self._now = wait, math.ceil(1e3 * now_s) * 1e-3 + PHASE_S
        self.sink = SampleArray(2000)
        configuration, mu0 = build_bench_configuration(bench, FIGURE), bench.home.lever_ratio
        self.loop = BenchLoop(plant, read_actuation(bench), mu0, configuration, self.sink)
        self.reading: Reading | None = None

    @property
    def x(self) -> State:
        return self.describe()[0]

    @property
    def targets(self) -> list[float]:
        return self.describe()[1]

    @property
    def now(self) -> float:
        return self._now

    def go_on(self, ticks: int = 1) -> None:
        self._now += ticks * self.bench.timing.period_s
        self._wait(self._now)

    def tick(self, ticks: int = 1) -> None:
        """Run periods of the loop of the bench."""
        for _ in range(ticks):
            self.go_on()
            self.loop.tick(self._now)

    def push(self, torque: Torque, ticks: int = 1) -> Torque:
        """Run periods with this torque; return the last torque sent."""
        sent = NO_TORQUE
        for _ in range(ticks):
            self.go_on()
            reading = self.reading = self.plant.read(self._now, AT_REST)
            known = AT_REST
            if reading.measurement is not None:
                y = reading.measurement
                known = State(y.theta1 + y.phi, 0.0, y.theta1, 0.0, y.theta2, 0.0)
            sent = self.plant.write(self._now, torque, known, UNDISTURBED, 0)
        return sent

    def prepare(self) -> None:
        self.plant.arm(self._now)
        while self.plant.status is not BenchStatus.READY:
            assert self.plant.fault is None
            self.go_on(ARMING_TICKS)
            self.loop.tick(self._now)
        while (step := self.plant.homing_step) is not None:
            self.plant.confirm_home(step, "a test")
        self.tick(5)

    def start(self, by_hand: bool = True) -> None:
        self.prepare()
        self.plant.start(self._now) if by_hand else self.loop.start(self._now)


def stand_simulated() -> Iterator[Stand]:
    bench = read_bench(EMULATOR_BENCH)
    plant = SimulatedPlant(bench)

    def wait(until: float) -> None:
        plant.now_s = until

    def describe() -> tuple[State, list[float], list[Any]]:
        return plant.mechanics.read(plant.time_us), list(plant.mechanics.target), [None, None]

    yield Stand(plant, bench, wait, 0.0, describe)
    plant.close()


def stand_emulated(emulator: RunningEmulator, interface: str) -> Iterator[Stand]:
    """interface: socketcand or slcan; moteus: its drives, and CAN FD on slcan."""
    bench = read_bench(MOTEUS / "bench.toml") if interface == "moteus" else connect_bench(emulator)
    if interface != "socketcand":
        bench = bench.changed(
            bus=BusSettings(
                interface="slcan",
                channel=emulator.slcan,
                fd=interface == "moteus",
                options={"sleep_after_open": 0.0},
                timestamps="arrival",
            ),
            timing=bench.timing.changed(feedback_age_s=UNSTAMPED_AGE_S),
        )
    clock = LockstepClock()
    plant = CanPlant(bench, find_calibration(bench), clock, build_guard(bench))
    plant.open()
    emulator.control.home()

    def describe() -> tuple[State, list[float], list[Any]]:
        state = emulator.control.read_state()
        drives = state["drives"].values()
        return (
            State(**state["x"]),
            [drive["target_nm"] for drive in drives],
            [drive["mode"] for drive in drives],
        )

    yield Stand(plant, bench, clock.wait_until, clock.now(), describe)
    plant.close()
