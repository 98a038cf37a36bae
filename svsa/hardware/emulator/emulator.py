"""The emulator: drives, encoder node and mechanics on one bus, in the order of their events.

Time is whole microseconds since the start. A frame takes 0.13 ms: 8 bytes at 1 Mbit/s; CAN FD with
up to 48 bytes at 5 Mbit/s takes no longer. If several frames wait, the lowest identifier is sent
first. The output depends only on the input frames, their times, and the seed.
"""

import heapq
import random
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from svsa.actuators.dynamics import compute_deflection
from svsa.actuators.signals import Torque
from svsa.hardware.bench.emulation import EMULATED_DATA, EMULATED_ID, EMULATED_PERIOD_S, Frame
from svsa.hardware.bench.real_motors import RealMotors
from svsa.hardware.drives.emulated import EmulatedDrive, EmulatorClock, Motion
from svsa.hardware.drives.installed import get_family
from svsa.hardware.emulator.encoder import EncoderNode
from svsa.hardware.emulator.faults import (
    BrownOut,
    BusErrors,
    CurrentOffset,
    DropFrames,
    EmulatorFault,
    FrozenEncoder,
    LateFrames,
    ReversedEncoder,
    ReversedMotor,
    Silence,
    Stall,
    Unplugged,
    ZeroedCounter,
)
from svsa.hardware.emulator.mechanics import Mechanics
from svsa.hardware.emulator.parameters import EmulatorParameters
from svsa.simulation.plant.loads import Load

FRAME_US = 130
ERROR_PERIOD_US = 100_000
MAX_WAITING = 1000
_EMULATED_US = round(EMULATED_PERIOD_S * 1e6)
_ERROR_FRAME_US = 1000

TimedFrame = tuple[int, Frame, Any]


class Emulator:
    """The emulated bench. `advance_to` returns the frames sent in between.

    Attributes:
        now_us: Time, µs.
        frames: Number of frames sent on the bus.
    """

    def __init__(self, parameters: EmulatorParameters | None = None) -> None:
        self.parameters = parameters or EmulatorParameters()
        p = self.parameters
        self.mechanics = Mechanics(p)
        self._motors = RealMotors.of(p.actuator)
        self.drives: dict[str, EmulatedDrive] = {
            name: get_family(motor.drive).emulate(motor)
            for name, motor in (("motor1", p.motor1), ("motor2", p.motor2))
        }
        self.encoder = EncoderNode(p.deflection)
        self.now_us, self.frames = 0, 0
        self._random = random.Random(p.seed)  # noqa: S311
        self._events: list[tuple[int, int, Callable[[], None]]] = []
        self._waiting: list[tuple[int, int, Frame, Any]] = []
        self._busy = False
        self._order = 0
        self._sent: list[TimedFrame] = []
        self._drops: dict[str, float] = {}
        self._delays: dict[str, int] = {}
        for name, drive in self.drives.items():
            self._beat_at(drive.motor, 0, lambda k, n=name, d=drive: self._feed(n, d, k))
            self._at(ERROR_PERIOD_US, lambda d=drive: self._complain(d))
        self._beat_at(p.deflection, 0, lambda _: self._count_deflection())
        self._at(_EMULATED_US, self._beat)

    @property
    def next_event_us(self) -> int:
        """The time of the next event, µs."""
        return self._events[0][0]

    def advance_to(self, time_us: int) -> list[TimedFrame]:
        """Advance to this time; return the frames until then, (µs, frame, sender or None)."""
        while self._events[0][0] <= time_us:
            self.now_us, _, happen = heapq.heappop(self._events)
            happen()
        self.now_us = max(self.now_us, time_us)
        said, self._sent = self._sent, []
        return said

    def receive(self, frame: Frame, sender: Any) -> None:
        """Receive a client's frame now; others receive it after its transmission."""
        self._request(frame, sender)

    def schedule(self, at_us: int, happen: Callable[[], None]) -> None:
        """Schedule an action at that time, or now if it is past."""
        self._at(max(at_us, self.now_us), happen)

    def add_load(self, load: Load) -> None:
        """Put a load on, now."""
        self.mechanics.add_load(self.now_us, load.changed(start_s=None))

    def set_loads(self, loads: Sequence[Load]) -> None:
        """Set exactly these loads from now on."""
        self.mechanics.clear_loads(self.now_us)
        for load in loads:
            self.add_load(load)

    def home(self) -> None:
        """Move the mechanism to its marks, as an operator does by hand, and release it."""
        self.mechanics.home(self.now_us)

    def inject(self, fault: EmulatorFault) -> None:
        """Inject a fault now."""
        match fault:
            case DropFrames():
                self._drops[fault.node] = fault.probability
            case LateFrames():
                self._delays[fault.node] = round(fault.delay_s * 1e6)
            case BusErrors():
                for number in range(fault.count):
                    self._at(self.now_us + number * _ERROR_FRAME_US, self._send_error_frame)
            case FrozenEncoder() | ReversedEncoder() if fault.node == "deflection":
                self.encoder.fail(frozen=fault.kind == "freeze")
            case FrozenEncoder():
                self.drives[fault.node].frozen = True
            case ReversedEncoder():
                self.drives[fault.node].encoder_sign *= -1
            case ReversedMotor():
                self.drives[fault.node].motor_sign *= -1
            case BrownOut():
                self.drives[fault.node].reset(self.now_us)
            case Stall():
                self.drives[fault.node].stalled = True
            case Silence():
                self.drives[fault.node].powered = False
            case Unplugged():
                self.drives[fault.node].plugged = False
            case ZeroedCounter():
                self.drives[fault.node].zero_counter()
            case CurrentOffset():
                self.drives[fault.node].offset_ma = 1000.0 * fault.offset_a
        self._drive()

    def clear_faults(self) -> None:
        """Remove all faults; a drive that was off starts as after a reset."""
        self._drops.clear()
        self._delays.clear()
        self.encoder.repair()
        for drive in self.drives.values():
            if not drive.powered or drive.stalled:
                drive.reset(self.now_us)
            drive.plugged = True
            drive.encoder_sign, drive.motor_sign = drive.motor.sign, 1
            drive.powered, drive.stalled, drive.frozen, drive.offset_ma = True, False, False, 0.0
        self._drive()

    def _at(self, time_us: int, happen: Callable[[], None]) -> None:
        self._order += 1
        # The number keeps simultaneous events in the order in which they were scheduled, and
        # prevents heapq from comparing functions.
        heapq.heappush(self._events, (time_us, self._order, happen))

    def _drive(self) -> None:
        """Set the target torques of the drives' current loops."""
        drive1, drive2 = self.drives.values()
        target = self._motors.join(Torque(drive1.target_nm, drive2.target_nm))
        self.mechanics.set_target(self.now_us, target)

    def _beat_at(self, clock: EmulatorClock, number: int, happen: Callable[[int], None]) -> None:
        """Schedule an action at every ms of this clock, from beat `number` on."""

        def beat() -> None:
            self._beat_at(clock, number + 1, happen)
            happen(number)

        elapsed = clock.phase_s * 1e6 + number * 1000.0 * (1.0 + clock.drift)
        self._at(round(elapsed), beat)

    def _feed(self, name: str, drive: EmulatedDrive, beat: int) -> None:
        """Send a drive's pushed frames of this ms of its clock."""
        for frame in drive.list_pushed(beat, self._observe(name, drive)):
            self._send(name, frame)
        if drive.expire(self.now_us):
            self._drive()

    def _observe(self, name: str, drive: EmulatedDrive) -> Motion:
        """Update a motor's encoder; return the motion of the motor."""
        x, number = self.mechanics.read(self.now_us), 0 if name == "motor1" else 1
        drive.look(self._motors.find_angles(x.theta1, x.theta2)[number])
        velocity = self._motors.find_angles(x.dtheta1, x.dtheta2)[number]
        return Motion(velocity, self._motors.split(self.mechanics.torque)[number])

    def _complain(self, drive: EmulatedDrive) -> None:
        self._at(self.now_us + ERROR_PERIOD_US, lambda: self._complain(drive))
        if drive.heard and drive.stalled and (frame := drive.build_error()) is not None:
            self._request(frame, None)

    def _count_deflection(self) -> None:
        x = self.mechanics.read(self.now_us)
        angle = x.q if self._motors.is_pair else compute_deflection(x)
        self._send("deflection", self.encoder.build_frame(angle))

    def _beat(self) -> None:
        self._at(self.now_us + _EMULATED_US, self._beat)
        self._sent.append((self.now_us, Frame(EMULATED_ID, EMULATED_DATA, extended=True), None))

    def _send_error_frame(self) -> None:
        self._sent.append((self.now_us, Frame(0, b"", error=True), None))

    def _send(self, node: str, frame: Frame) -> None:
        """A sensor's frame, unless a fault drops or delays it."""
        probability = self._drops.get(node, 0.0)
        if probability and self._random.random() < probability:
            return
        if delay := self._delays.get(node, 0):
            self._at(self.now_us + delay, lambda: self._request(frame, None))
        else:
            self._request(frame, None)

    def _request(self, frame: Frame, sender: Any) -> None:
        """Queue a frame until the bus is free; a full queue drops it."""
        if len(self._waiting) >= MAX_WAITING:
            return
        self._order += 1
        # CAN arbitration: the lowest identifier first; frames with equal identifiers keep their
        # order.
        heapq.heappush(self._waiting, (_compute_priority(frame), self._order, frame, sender))
        if not self._busy:
            self._busy = True
            self._at(self.now_us, self._transmit)

    def _transmit(self) -> None:
        self._busy = bool(self._waiting)
        if self._busy:
            _, _, frame, sender = heapq.heappop(self._waiting)
            self._at(self.now_us + FRAME_US, lambda: self._deliver(frame, sender))

    def _deliver(self, frame: Frame, sender: Any) -> None:
        self.frames += 1
        self._sent.append((self.now_us, frame, sender))
        if sender is not None:
            for name, drive in self.drives.items():
                observe = partial(self._observe, name, drive)
                for answer in drive.receive(frame, self.now_us, observe):
                    if drive.answers_with_feedback:
                        self._send(name, answer)
                    else:
                        self._request(answer, None)
            self._drive()
        self._transmit()


def _compute_priority(frame: Frame) -> int:
    """The order on the bus: 11 bits first, then standard before extended, then the other 18."""
    if frame.extended:
        return frame.can_id >> 18 << 19 | 1 << 18 | frame.can_id & 0x3FFFF
    return frame.can_id << 19
