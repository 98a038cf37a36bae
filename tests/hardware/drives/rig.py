"""The two drives of a bench on a real bus, with the ticks of the loop."""

from typing import Any

import can

from svsa.hardware.description.file import BenchFile
from svsa.hardware.drives.bus import open_bus, take_waiting
from svsa.hardware.drives.conversion import build_motor_scale
from svsa.hardware.drives.drive import Drive, compute_key, merge_stops
from svsa.hardware.drives.installed import build_drive, build_stop
from svsa.hardware.drives.phase import Phase
from svsa.hardware.emulator.launch import RunningEmulator
from svsa.hardware.plant.clock import LockstepClock

TICK_S = 0.001
LONGEST_START_S = 3.0
STARTING_TICKS = 4
RESET_S = 0.6
"""Time for which a drive may ignore frames after a reset."""
REST_MA = (0, 0)
MOTORS = ("motor1", "motor2")


class Rig:
    """The two drives of a bench, with the ticks of the loop; stores the frames on the bus."""

    def __init__(self, bench: BenchFile, emulator: RunningEmulator) -> None:
        self.bench, self.control = bench, emulator.control
        self.bus = open_bus(bench.bus)
        self.clock = LockstepClock()
        self.clock.bind(self.bus)
        self.drives: list[Drive] = []
        for name in MOTORS:
            motor = getattr(bench, name)
            counts = motor.speed_max_rad_per_s / abs(build_motor_scale(motor).angle_per_count)
            self.drives.append(build_drive(motor, TICK_S, counts))
        self.takers = {key: drive for drive in self.drives for key in drive.heard_ids}
        self.sent: list[tuple[float, can.Message]] = []
        self.heard: list[can.Message] = []
        self._send = self.bus.send
        self.bus.send = self._keep

    def _keep(self, message: can.Message, timeout: float | None = None) -> None:
        if compute_key(message) in self.drives[0].obeyed_ids | self.drives[1].obeyed_ids:
            self.sent.append((self.clock.now(), can.Message(**_describe(message))))
        self._send(message, timeout)

    def wait(self, seconds: float = TICK_S) -> None:
        """Advance the time, and pass the received frames to the drives."""
        self.clock.wait_until(self.clock.now() + seconds)
        now = self.clock.now()
        for message in (*self.clock.take_frames(), *take_waiting(self.bus, self.bench.bus, 1000)):
            self.heard.append(message)
            if drive := self.takers.get(compute_key(message)):
                drive.take(message, now)

    def tick(
        self, currents: tuple[int, int] = REST_MA, count: int = 1, period_s: float = TICK_S
    ) -> None:
        for _ in range(count):
            self.wait(period_s)
            now = self.clock.now()
            for drive, current in zip(self.drives, currents, strict=True):
                if drive.phase is Phase.READY:
                    assert drive.send_current(self.bus, current, now)
                elif drive.phase is not Phase.SILENT:
                    drive.advance(self.bus, now)

    def start(self) -> float:
        """Bring the drives from off to READY; return the duration, s."""
        begin = self.clock.now()
        for drive in self.drives:
            drive.begin()
        while self.clock.now() - begin < LONGEST_START_S:
            self.tick(period_s=STARTING_TICKS * TICK_S)
            if all(drive.phase in (Phase.READY, Phase.SILENT) for drive in self.drives):
                break
        return self.clock.now() - begin

    def zero(self, count: int = 1) -> None:
        """Run the ticks of a fault."""
        for _ in range(count):
            self.wait()
            for drive in self.drives:
                assert drive.send_zero(self.bus, self.clock.now())

    def read(self) -> list[dict[str, Any]]:
        """Return the emulated drives."""
        return list(self.control.read_state()["drives"].values())

    @property
    def targets(self) -> list[float]:
        """Return the target torques of the drives, N·m."""
        return [drive["target_nm"] for drive in self.read()]

    def close(self) -> None:
        for frame in merge_stops(*(build_stop(getattr(self.bench, name)) for name in MOTORS)):
            self.wait(0.0015)
            self.bus.send(frame)
        self.wait(RESET_S)
        self.control.clear_faults()
        self.control.home()
        self.bus.shutdown()


def _describe(message: can.Message) -> dict[str, Any]:
    return {
        "arbitration_id": message.arbitration_id,
        "is_extended_id": message.is_extended_id,
        "is_fd": message.is_fd,
        "bitrate_switch": message.bitrate_switch,
        "data": bytes(message.data),
    }
