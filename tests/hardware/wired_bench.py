"""The emulator on a bus inside this process, in virtual time: no socket, no waiting.

python-can's `virtual` interface carries the frames; the emulator advances with the plant's clock.
Every frame that the plant sends is stored with its time, as by a sniffer on the bus.
"""

import itertools
from pathlib import Path
from typing import Any, NamedTuple

import can

from svsa.actuators.signals import Disturbance, State, Torque
from svsa.hardware.bench.emulation import Frame
from svsa.hardware.bench.reading import Reading
from svsa.hardware.description.calibration import find_calibration
from svsa.hardware.description.file import BenchFile, read_bench
from svsa.hardware.drives.robomodule import Command, decode, split_id
from svsa.hardware.emulator.emulator import Emulator
from svsa.hardware.emulator.parameters import EmulatorParameters
from svsa.hardware.plant.can_plant import CanPlant
from svsa.hardware.realtime.configuration import build_guard
from svsa.hardware.realtime.loop import BenchLoop
from svsa.hardware.safety.machine import BenchStatus
from tests.hardware.emulator.wire_frames import build_message, read_frame

EMULATOR_BENCH = Path(__file__).parents[2] / "svsa" / "hardware" / "emulator" / "bench.toml"
AT_REST = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
UNDISTURBED = Disturbance(0.0, 0.0, 0.0)
NO_TORQUE = Torque(0.0, 0.0)
_channels = itertools.count()


class Sent(NamedTuple):
    """A frame of the plant. time_s: virtual."""

    time_s: float
    can_id: int
    data: bytes


class VirtualClock:
    """Time that advances while it is waited for, together with the emulator."""

    def __init__(self, emulator: Emulator, wire: can.BusABC) -> None:
        self._rig, self._wire = emulator, wire
        self.sent: list[Sent] = []
        self.mute = False

    def bind(self, bus: can.BusABC) -> None:
        pass

    def now(self) -> float:
        return self._rig.now_us * 1e-6

    def convert(self, timestamp: float, arrival: float) -> float:
        return timestamp

    def take_frames(self) -> list[can.Message]:
        return []

    def collect(self) -> None:
        """Pass the frames of the plant to the emulator."""
        while (message := self._wire.recv(0)) is not None:
            self.sent.append(Sent(self.now(), message.arbitration_id, bytes(message.data)))
            self._rig.receive(read_frame(message), self)

    def wait_until(self, deadline: float) -> None:
        self.collect()
        for time_us, frame, sender in self._rig.advance_to(round(deadline * 1e6)):
            if sender is None and not self.mute:
                self.say(frame, time_us * 1e-6)

    def say(self, frame: Frame, time_s: float) -> None:
        """Put a frame on the wire, as one of the bench's nodes."""
        self._wire.send(build_message(frame, time_s))


class FakeBeats:
    """Heartbeats whose ages a test sets, s."""

    def __init__(self) -> None:
        self.ages = {"loop": 0.0, "supervisor": 0.0, "server": 0.0, "operator": 0.0}
        self.stops = 0

    def age_s(self, slot: str) -> float:
        return self.ages[slot]


class WiredBench:
    """Plant, emulator and clock, connected. A context manager."""

    def __init__(
        self,
        bench: BenchFile | None = None,
        parameters: EmulatorParameters | None = None,
        beats: Any = None,
        **safety: Any,
    ) -> None:
        channel = f"bench-{next(_channels)}"
        written = bench or read_bench(EMULATOR_BENCH)
        bus = written.bus.changed(interface="virtual", channel=channel, options={})
        self.bench = written.changed(bus=bus, safety=written.safety.changed(**safety))
        self.emulator = Emulator(parameters)
        self.wire = can.Bus(interface="virtual", channel=channel, preserve_timestamps=True)
        self.clock = VirtualClock(self.emulator, self.wire)
        calibration = find_calibration(self.bench)
        self.guard = build_guard(self.bench)
        self.plant = CanPlant(self.bench, calibration, self.clock, self.guard, beats)
        self.plant.open()
        self.reading: Reading | None = None
        self.beats, self.undisturbed = beats, UNDISTURBED
        self.push = NO_TORQUE
        self.monkeypatch: Any = None
        self._tick = 0

    def __enter__(self) -> "WiredBench":
        return self

    def __exit__(self, *_: object) -> None:
        self.plant.close()
        self.wire.shutdown()

    @property
    def plant_bus(self) -> can.BusABC:
        """The plant's end of the wire."""
        return self.plant._get_bus()

    def ask(self, **asked: Any) -> None:
        """Run one tick with additional options."""
        self.tick(1, **{"torque": self.push} | asked)

    @property
    def now(self) -> float:
        return self.clock.now()

    def tick(
        self,
        count: int = 1,
        torque: Torque = NO_TORQUE,
        known: State | None = None,
        estimate: Disturbance = UNDISTURBED,
        missed: int = 0,
    ) -> Torque:
        """Run periods with this commanded torque; return the last torque sent."""
        sent = NO_TORQUE
        for _ in range(count):
            self._tick += 1
            self.clock.wait_until(self._tick * self.bench.timing.period_s)
            self.reading = self.plant.read(self.now, known or AT_REST)
            y = self.reading.measurement
            x = AT_REST if y is None else State(y.theta1 + y.phi, 0.0, y.theta1, 0.0, y.theta2, 0.0)
            sent = self.plant.write(self.now, torque, known or x, estimate, missed)
            self.clock.collect()
        return sent

    def drive(self, loop: BenchLoop, count: int = 1, missed: int = 0) -> None:
        """Run periods of the loop of the bench; missed: ticks lost before each."""
        for _ in range(count):
            self._tick += 1
            self.clock.wait_until(self._tick * self.bench.timing.period_s)
            loop.tick(self.now, missed)
            self.clock.collect()

    def skip(self, seconds: float) -> None:
        """Advance the time without the plant, as when its process does not run."""
        self._tick += round(seconds / self.bench.timing.period_s)
        self.clock.wait_until(self._tick * self.bench.timing.period_s)

    def tick_until(self, status: BenchStatus, longest_s: float = 3.0, **asked: Any) -> None:
        """Run periods until the bench has this status."""
        for _ in range(round(longest_s / self.bench.timing.period_s)):
            if self.plant.status is status:
                return
            self.tick(**asked)
        raise AssertionError(f"{self.plant.status} instead of {status}: {self.plant.fault}")

    def make_ready(self) -> None:
        """Arm and home the bench."""
        self.plant.arm(self.now)
        self.tick_until(BenchStatus.READY)
        while (step := self.plant.homing_step) is not None:
            self.plant.confirm_home(step, "a test")
        self.tick(2)

    def make_run(self, torque: Torque = NO_TORQUE) -> None:
        """Run with this torque on the motors."""
        self.make_ready()
        self.plant.start(self.now)
        self.tick(3, torque)

    def read_currents(self, since_s: float = 0.0) -> list[tuple[float, int, int]]:
        """Return current commands on the wire: (time, drive number, mA)."""
        found = []
        for sent in self.clock.sent:
            address, command = split_id(sent.can_id)
            if command is Command.CURRENT and sent.time_s >= since_s:
                current = decode(command, sent.data).current_ma
                found.append((sent.time_s, address.number, current))
        return found

    def find_resets(self, since_s: float = 0.0) -> list[float]:
        """Return the times of broadcast resets on the wire."""
        return [sent.time_s for sent in self.clock.sent if sent[1] == 0 and sent[0] >= since_s]

    def find_zero_time(self, since_s: float) -> float:
        """Return the time from which both drives received zero only, s."""
        last = [sent for sent in self.read_currents() if sent[2] != 0]
        after = max((sent[0] for sent in last), default=0.0)
        zeros = [
            next(
                t
                for t, drive, current in self.read_currents(since_s)
                if drive == number and current == 0 and t > after
            )
            for number in (1, 2)
        ]
        return max(zeros)
