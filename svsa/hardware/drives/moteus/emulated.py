"""One emulated moteus controller, as the manufacturer's documentation describes it.

It parses any sequence of subframes, writes and reads the registers of torque control, and reports
an error for others. A command in position mode is valid for its timeout: after that the controller
enters the mode `TIMEOUT`, in which it produces no torque, and which only a stop leaves.
"""

import struct
from collections.abc import Callable, Iterator
from typing import NamedTuple

from svsa.hardware.bench.emulation import Frame
from svsa.hardware.drives.emulated import EmulatedDrive, Motion
from svsa.hardware.drives.moteus import NOP, REPLY, Mode, Register, build_id
from svsa.hardware.drives.moteus.settings import EmulatedMoteusMotor

DEFAULT_TIMEOUT_S = 0.1
DRIVER_FAULT = 33
_WRITE, _READ, _ANSWER, _WRITE_ERROR, _READ_ERROR = 0x00, 0x10, 0x20, 0x30, 0x31
_UNKNOWN_REGISTER = 1
_TYPES = (struct.Struct("<b"), struct.Struct("<h"), struct.Struct("<i"), struct.Struct("<f"))
_LENGTHS = (0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64)
_UNITS: dict[int, tuple[float, float, float]] = {
    Register.MODE: (1.0, 1.0, 1.0),
    Register.POSITION: (0.01, 0.0001, 0.00001),
    Register.Q_CURRENT: (1.0, 0.1, 0.001),
    Register.FAULT: (1.0, 1.0, 1.0),
    Register.COMMAND_POSITION: (0.01, 0.0001, 0.00001),
    Register.COMMAND_VELOCITY: (0.1, 0.00025, 0.00001),
    Register.FEEDFORWARD_TORQUE: (0.5, 0.01, 0.001),
    Register.KP_SCALE: (1 / 127, 1 / 32767, 1 / 2147483647),
    Register.KD_SCALE: (1 / 127, 1 / 32767, 1 / 2147483647),
    Register.ILIMIT_SCALE: (1 / 127, 1 / 32767, 1 / 2147483647),
    Register.TIMEOUT: (0.01, 0.001, 0.000001),
}
"""Resolution of int8, int16 and int32 in the register's unit."""


class _Subframe(NamedTuple):
    """A read or write of consecutive registers in a frame.

    Attributes:
        kind: `_WRITE` or `_READ`.
        width: 0 to 2 integers, 3 a float.
        start: First register.
        registers: Number of registers.
        values: Values of a write.
    """

    kind: int
    width: int
    start: int
    registers: int
    values: tuple[float, ...]


class EmulatedMoteusDrive(EmulatedDrive):
    """A controller with its registers."""

    answers_with_feedback = True

    def __init__(self, motor: EmulatedMoteusMotor) -> None:
        super().__init__(motor)
        self._id = motor.id
        self.reset(0)

    def reset(self, time_us: int) -> None:
        """Begin as after power is switched on: stopped, and the position is zero."""
        self._mode = Mode.STOPPED
        self._hold(0, time_us)
        self.stalled = False
        self._valid_until_us: float = 0.0
        self.zero_counter()

    @property
    def mode(self) -> int:
        """The mode as the controller reports it."""
        return Mode.FAULT if self.stalled else self._mode

    @property
    def engaged(self) -> bool:
        """Whether it is in position mode."""
        return self._mode is Mode.POSITION

    def receive(self, frame: Frame, time_us: int, observe: Callable[[], Motion]) -> list[Frame]:
        """Receive a frame of the bus; return the reply if the frame requests one."""
        source, destination = frame.can_id >> 8 & 0x7F, frame.can_id & 0xFF
        if frame.can_id > 0xFFFF or not frame.fd or destination != self._id or not self.heard:
            return []
        try:
            subframes = list(_parse(frame.data))
        except (IndexError, struct.error, ValueError):
            return []
        written: dict[int, float] = {}
        for subframe in subframes:
            if subframe.kind == _WRITE:
                written |= zip(range(subframe.start, 0x1000), subframe.values, strict=False)
        if Register.MODE in written:
            self._command(written, time_us)
        self.errors += len(written.keys() - _UNITS.keys())
        if not frame.can_id & REPLY:
            return []
        motion = observe()
        data = b"".join(
            self._read(subframe, motion) for subframe in subframes if subframe.kind == _READ
        )
        length = next(length for length in _LENGTHS if length >= len(data))
        answer = build_id(self._id, source)
        padded = data.ljust(length, bytes((NOP,)))
        return [Frame(answer, padded, extended=answer > 0x7FF, fd=True)]

    def _command(self, written: dict[int, float], time_us: int) -> None:
        """Registers of a command that are not written have their defaults."""
        mode = written[Register.MODE]
        if mode == Mode.STOPPED:
            self._mode, self.stalled = Mode.STOPPED, False
            self._hold(0, time_us)
        elif mode == Mode.POSITION and not self.stalled and self._mode is not Mode.TIMEOUT:
            gains = (Register.KP_SCALE, Register.KD_SCALE, Register.ILIMIT_SCALE)
            if any(written.get(gain, 1.0) for gain in gains):
                # This emulator has no position controller.
                self.errors += 1
                return
            self._mode = Mode.POSITION
            torque = written.get(Register.FEEDFORWARD_TORQUE, 0.0)
            self._hold(round(1000.0 * torque / self.motor.torque_constant_nm_per_a), time_us)
            timeout_s = written.get(Register.TIMEOUT, 0.0) or DEFAULT_TIMEOUT_S
            self._valid_until_us = time_us + 1e6 * timeout_s
        else:
            self.errors += 1

    def expire(self, time_us: int) -> bool:
        """Apply the command timeout; return whether the torque has changed."""
        if self._mode is not Mode.POSITION or time_us <= self._valid_until_us:
            return False
        self._mode = Mode.TIMEOUT
        self._hold(0, time_us)
        return True

    def _read(self, query: _Subframe, motion: Motion) -> bytes:
        values = {
            Register.MODE: self.mode,
            Register.POSITION: self.counts / self.motor.counts_per_rev,
            Register.Q_CURRENT: self.compute_current_ma(motion.torque) / 1000.0,
            Register.FAULT: DRIVER_FAULT if self.stalled else 0,
        }
        registers = range(query.start, query.start + query.registers)
        unknown = [register for register in registers if register not in values]
        if unknown:
            return bytes((_READ_ERROR, *_write_varuint(unknown[0]), _UNKNOWN_REGISTER))
        data = bytes((_ANSWER | query.width << 2 | query.registers, *_write_varuint(query.start)))
        for register in registers:
            data += _pack(values[Register(register)], register, query.width)
        return data


def _pack(value: float, register: int, width: int) -> bytes:
    if width == 3:
        return _TYPES[3].pack(value)
    most = 2 ** (8 * _TYPES[width].size - 1) - 1
    steps = round(value / _UNITS[register][width])
    return _TYPES[width].pack(min(max(steps, -most), most))


def _parse(data: bytes) -> Iterator[_Subframe]:
    """Parse the subframes that write and read; raises an error for invalid ones."""
    at = 0
    while at < len(data):
        kind = data[at]
        at += 1
        if kind == NOP:
            continue
        if kind >= _ANSWER:
            raise ValueError("only a controller sends this")
        width, count = kind >> 2 & 3, kind & 3
        if not count:
            count, at = _read_varuint(data, at)
        start, at = _read_varuint(data, at)
        values = []
        if kind & 0xF0 == _WRITE:
            for register in range(start, start + count):
                (number,) = _TYPES[width].unpack_from(data, at)
                unit = _UNITS.get(register, (1.0, 1.0, 1.0))
                values.append(number if width == 3 else number * unit[width])
                at += _TYPES[width].size
        yield _Subframe(kind & 0xF0, width, start, count, tuple(values))


def _read_varuint(data: bytes, at: int) -> tuple[int, int]:
    value = shift = 0
    while True:
        value |= (data[at] & 0x7F) << shift
        if not data[at] & 0x80:
            return value, at + 1
        at, shift = at + 1, shift + 7


def _write_varuint(value: int) -> bytes:
    data = bytearray()
    while value > 0x7F:
        data.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes((*data, value))
