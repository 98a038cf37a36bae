"""The check of a bench file on the bus of an emulator, its duration, and the frames it sent."""

from svsa.hardware.commissioning import check_bench
from svsa.hardware.drives.robomodule import (
    Command,
    decode,
    split_id,
)

LONGEST_S = 20.0


def check(path, bus, move=False, watch=None):
    """Run every step of a check; it ends in time with the drives at zero current."""
    steps = list(check_bench(path, move, watch, bus.open, bus.now))
    assert bus.now() < LONGEST_S
    assert_left_alone(bus)
    return {step.name: step for step in steps}


class Watcher:
    """A user who sees on the emulator in which direction each motor turns first."""

    def __init__(self, bus):
        self._bus, self._seen = bus, {}
        bus.before_send = self._look

    def _look(self, message):
        for name, drive in self._bus.emulator.drives.items():
            if current := find_current(message, name):
                self._seen.setdefault(name, current * drive.motor_sign * drive.motor.sign > 0)

    def __call__(self, question):
        return self._seen[question.split()[1]]


def assert_left_alone(bus):
    assert not bus.is_open
    for drive in bus.emulator.drives.values():
        assert drive.current_ma == 0
        assert drive.mode is None or not drive.powered


def find_current(message, motor):
    """Return the current that a frame commands for this motor, mA; None for other frames."""
    address, command = split_id(message.arbitration_id)
    if command is not Command.CURRENT or address.number != int(motor[-1]):
        return None
    return decode(command, message.data).current_ma


def list_currents(bus):
    return [
        (time_s, split_id(message.arbitration_id)[0], current)
        for time_s, message in bus.sent
        for motor in ("motor1", "motor2")
        if (current := find_current(message, motor)) is not None
    ]
