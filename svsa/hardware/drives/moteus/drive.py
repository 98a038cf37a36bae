"""A moteus controller: its start-up, its commands and its last reply.

OFF → RESET (stopped, 0.1 s) → MODE → READY. It sends feedback only in reply: each command includes
a query.
"""

import can

from svsa.hardware.drives.drive import EXTENDED, Drive, StopFrames
from svsa.hardware.drives.moteus import (
    HOST,
    QUERY,
    REPLY,
    STOP,
    Mode,
    build_id,
    decode_reply,
    encode_torque,
)
from svsa.hardware.drives.moteus.settings import MoteusSettings
from svsa.hardware.drives.phase import Phase

SETTLE_S = 0.1
"""Time of continuous replies before READY, s: by then the supervisor has received frames."""
FIRST_ANSWER_S = 0.5
FAULT_WORDS = {
    32: "calibration fault",
    33: "motor driver fault",
    34: "over voltage",
    35: "encoder fault",
    36: "motor not configured",
    37: "PWM cycle overrun",
    38: "over temperature",
    39: "outside limit",
    40: "under voltage",
    41: "configuration changed",
    42: "theta invalid",
    43: "position invalid",
    44: "driver enable fault",
    45: "stop position deprecated",
    46: "timing violation",
    47: "feedforward without acceleration limit",
    48: "invalid limits",
}


class MoteusDrive(Drive):
    """The frames to and from one controller.

    Its position is not set to zero: counts are relative to the position at the end of the reset.
    `errors` counts replies in READY from any mode except that in which it produces torque.
    """

    def __init__(self, settings: MoteusSettings) -> None:
        to, answer = settings.id, build_id(settings.id, HOST)
        self.heard_ids = frozenset((answer, answer | EXTENDED))
        # From any source, with or without a reply; short identifiers may be standard ones.
        sent = [build_id(source, to) for source in range(128)]
        self.obeyed_ids = frozenset(
            key for i in sent for key in (i, i | EXTENDED, i | REPLY | EXTENDED)
        )
        self._command = build_message(to, encode_torque(0.0, 0))
        self._stop, self._query = build_message(to, STOP), build_message(to, QUERY)
        self._timeout_ms = round(1000.0 * settings.watchdog_s)
        self._torque_per_ma = 0.001 * (settings.torque_constant_nm_per_a or 0.0)
        self._begun_s: float | None = None
        super().__init__(settings)

    def _forget(self) -> None:
        super()._forget()
        self._mode, self._fault = -1, 0
        self._zero: int | None = None
        self._held_ma = 0

    def begin(self) -> None:
        """Stop the controller at the next `advance`, then continue the start-up."""
        self._forget()
        self.phase, self._begun_s = Phase.RESET, None

    def advance(self, bus: can.BusABC, now: float) -> None:
        """Send stops until the controller has been stopped for a while, then torque 0."""
        if self._begun_s is None:
            self._begun_s = now
        waited = now - self._begun_s
        if self.phase is Phase.RESET:
            if self._mode == Mode.STOPPED and waited >= SETTLE_S:
                self.phase, self._begun_s = Phase.MODE, now
                # The last stop may still be unanswered: its reply has the same position.
                self._zero = None
                self.send_current(bus, 0, now)
            else:
                self.send_zero(bus, now)
        elif self.phase is Phase.MODE:
            self.send_current(bus, 0, now)
            if self.engaged:
                self.phase = Phase.READY
        if self.phase is not Phase.READY and waited >= FIRST_ANSWER_S:
            self.phase = Phase.SILENT

    def take(self, message: can.Message, time_s: float) -> None:
        """Read a reply."""
        reply = decode_reply(message.data)
        if reply is None:
            return
        if self._zero is None:
            self._zero = reply.position
        self.counts, self.current_ma = reply.position - self._zero, reply.current_ma
        self._mode, self._fault = reply.mode, reply.fault
        self.heard_s, self.engaged = time_s, reply.mode == Mode.POSITION
        self.answers += 1
        if reply.mode == Mode.FAULT or (self.phase is Phase.READY and not self.engaged):
            self.errors += 1

    def send_current(self, bus: can.BusABC, current_ma: int, now: float) -> bool:
        """Command the torque of a current at the motor, and ask for feedback."""
        self.sent_s, self._held_ma = now, current_ma
        torque = current_ma * self._torque_per_ma
        self._command.data[:] = encode_torque(torque, self._timeout_ms)
        bus.send(self._command)
        return True

    def send_zero(self, bus: can.BusABC, now: float) -> bool:
        """Stop the controller: zero torque, and no other until it is started up again."""
        self.sent_s = now
        bus.send(self._stop)
        return True

    def ask(self, bus: can.BusABC, now: float) -> None:
        """Request a reply without a command."""
        bus.send(self._query)

    def query(self, bus: can.BusABC, now: float) -> None:
        """Repeat the last current, so that the controller replies and does not time out."""
        self.send_current(bus, self._held_ma, now)

    def describe_error(self) -> str:
        """The fault, or the mode in which the controller makes no torque."""
        if self._mode == Mode.FAULT:
            words = FAULT_WORDS.get(self._fault, "not in its documentation")
            return f"reports fault {self._fault}: {words}"
        if self._mode == Mode.TIMEOUT:
            return "timed out: commands came too late, or not at all"
        return f"has left its mode: it is in mode {self._mode}, as after a restart"


def build_message(controller_id: int, data: bytes) -> can.Message:
    """A frame to a controller, which answers it."""
    return can.Message(
        arbitration_id=build_id(HOST, controller_id, reply=True),
        is_extended_id=True,
        is_fd=True,
        bitrate_switch=True,
        data=data,
    )


def build_stop(settings: MoteusSettings) -> StopFrames:
    """The stop command: one frame is both zero torque and reset."""
    stop = build_message(settings.id, STOP)
    return StopFrames((stop,), (stop,))
