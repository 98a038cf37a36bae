"""A deflection encoder on a serial line, with a terminal in place of the line."""

import os
import time

import pytest

from svsa.hardware.encoders.serial_line import SerialLine, SerialLineSettings
from svsa.hardware.encoders.source import EncoderError

LONGEST_S = 20.0


class Device:
    """The device at the other end of a serial line."""

    def __init__(self):
        self.handle, slave = os.openpty()
        self.port = os.ttyname(slave)
        self._slave = slave

    def say(self, data):
        os.write(self.handle, data)

    def close(self):
        for handle in (self.handle, self._slave):
            os.close(handle)


@pytest.fixture
def device():
    made = Device()
    yield made
    made.close()


def open_serial(device, **options):
    line = SerialLine(SerialLineSettings(port=device.port, baudrate=115_200, **options))
    line.open()
    return line


def read_until(line, counts):
    """Return the first reading with these counts; the terminal may take some time."""
    end = time.monotonic() + LONGEST_S
    while time.monotonic() < end:
        reading = line.read(2.5)
        if reading is not None and reading[0] == counts:
            return reading
        time.sleep(0.001)
    raise AssertionError(f"{counts} has not come: {line.read(2.5)}")


def test_lines_are_read_on_arrival_and_the_newest_counts(device):
    line = open_serial(device)
    assert line.read(0.0) is None
    device.say(b"1\n2\n-345\n")
    assert read_until(line, -345) == (-345, 2.5)
    device.say(b"77\r\n8")
    read_until(line, 77)
    device.say(b"1\n")
    read_until(line, 81)
    line.close()


def test_first_incomplete_line_is_ignored(device):
    """Of -1234567 only the end would be received."""
    line = open_serial(device)
    device.say(b"567\n12\n")
    read_until(line, 12)
    line.close()
    line.open()
    device.say(b"999\n")
    for _ in range(50):
        assert line.read(0.0) is None
        time.sleep(0.001)
    device.say(b"13\n")
    read_until(line, 13)
    line.close()


def test_damaged_lines_are_skipped(device):
    line = open_serial(device)
    device.say(b"\n5\n" + b"x" * 300 + b"6\n1_0\n\xff\xfe\n--3\n\n12345678901234\n")
    read_until(line, 5)
    device.say(b"8\n")
    read_until(line, 8)
    line.close()


def build_word(counts):
    content = counts.to_bytes(4, "little", signed=True)
    return b"\xa5" + content + bytes([sum(content) % 256])


def test_words_are_resynchronized_if_counts_contain_the_marker(device):
    """Every byte of these counts is the marker, and reading starts inside a word."""
    line = open_serial(device, binary=True)
    counts = int.from_bytes(b"\xa5" * 4, "little", signed=True)
    device.say(build_word(counts)[3:] + build_word(counts) * 3 + build_word(-2))
    read_until(line, -2)
    device.say(build_word(counts)[:4])
    assert line.read(0.0)[0] == -2
    device.say(build_word(counts)[4:])
    read_until(line, counts)
    line.close()


def test_noise_does_not_accumulate(device):
    line = open_serial(device, binary=True)
    for _ in range(20):
        device.say(b"\x11" * 500)
        line.read(0.0)
    device.say(build_word(4))
    read_until(line, 4)
    assert len(line._unread) < 6
    line.close()


def test_missing_serial_port_is_reported_with_instructions():
    line = SerialLine(SerialLineSettings(port="/dev/no-such-port"))
    with pytest.raises(EncoderError, match=r"no-such-port cannot be opened.*cable"):
        line.open()
    assert line.read(0.0) is None
    line.close()


def test_disconnected_device_is_an_error():
    device = Device()
    line = open_serial(device)
    device.close()
    end = time.monotonic() + LONGEST_S
    with pytest.raises(EncoderError, match="is lost"):
        while time.monotonic() < end:
            line.read(0.0)
    line.close()
