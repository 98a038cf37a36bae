"""A check of a bench's file on an emulator's bus, over in time, and what it has sent."""

from svsa.hardware.commissioning import check_bench
from svsa.hardware.drives.robomodule import (
    Command,
    decode,
    split_id,
)

LONGEST_S = 20.0


def check(path, bus, move=False, watch=None):
    """Every step of a check; it is over in time and the drives are at zero current."""
    steps = list(check_bench(path, move, watch, bus.open, bus.now))
    assert bus.now() < LONGEST_S
    assert_left_alone(bus)
    return {step.name: step for step in steps}


class Watcher:
    """A user who sees on the emulator which way each motor turns first."""

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
    """The current that a frame asks of this motor, mA; None for every other frame."""
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
