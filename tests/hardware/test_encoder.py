"""Where the deflection's counts come from: CAN node, serial line, NI counter, file."""

import math
import os
import sys
import time
import types

import can
import pytest

from svsa.errors import ParameterError
from svsa.hardware.bench import DeflectionSettings
from svsa.hardware.conversion import Unwrapped
from svsa.hardware.encoders import read_source
from svsa.hardware.encoders.source import EncoderError

ONE_TURN = 2.0 * math.pi
LONGEST_S = 20.0


def build(source, **options):
    return read_source(DeflectionSettings(source=source, options=options))


def build_frame(data, number=0x700, **kind):
    return can.Message(arbitration_id=number, data=data, **({"is_extended_id": False} | kind))


@pytest.mark.parametrize(
    ("options", "data", "counts"),
    [
        ({}, "ffffff85 55555555", -123),
        ({"big_endian": False}, "85ffffff 55555555", -123),
        ({"signed": False}, "ffffff85 55555555", 2**32 - 123),
        ({"offset": 3, "width": 16}, "555555 ff85 555555", -123),
        ({"offset": 5, "width": 24, "big_endian": False}, "5555555555 85ffff", -123),
    ],
)
def test_counts_lie_where_the_options_say(options, data, counts):
    node = build("can", id=0x700, **options)
    assert node.read(0.0) is None
    assert node.feed(build_frame(bytes.fromhex(data)), 1.5)
    assert node.read(9.0) == (counts, 1.5)


@pytest.mark.parametrize(
    "frame",
    [
        build_frame(bytes(8), 0x701),
        build_frame(bytes(8), is_extended_id=True),
        build_frame(bytes(3)),
        build_frame(None, is_remote_frame=True, dlc=8),
        build_frame(bytes(8), is_error_frame=True),
    ],
    ids=["another id", "extended", "too short", "a request", "an error frame"],
)
def test_what_is_not_a_frame_of_the_node_changes_nothing(frame):
    node = build("can", id=0x700)
    node.feed(build_frame((7).to_bytes(4, "big")), 1.0)
    assert not node.feed(frame, 2.0)
    assert node.read(3.0) == (7, 1.0)


def test_a_narrow_counter_is_unwrapped_by_its_own_width():
    node = build("can", id=0x700, width=16)
    unwrapped = Unwrapped(node.bits)
    for counts in (32_000, 33_000, 65_000, 66_000, 40_000):
        node.feed(build_frame((counts % 2**16).to_bytes(2, "big")), 0.0)
        assert unwrapped.update(node.read(0.0)[0]) == counts


@pytest.mark.parametrize(
    "options", [{}, {"id": 1, "width": 12}, {"id": 1, "offset": 6}, {"id": 1, "other": 1}]
)
def test_wrong_options_are_refused_by_name(options):
    with pytest.raises(ParameterError):
        build("can", **options)


class Device:
    """The far end of a serial line."""

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
    line = build("serial", port=device.port, baudrate=115_200, **options)
    line.open()
    return line


def read_until(line, counts):
    """The first reading with these counts; the terminal may take its time."""
    end = time.monotonic() + LONGEST_S
    while time.monotonic() < end:
        reading = line.read(2.5)
        if reading is not None and reading[0] == counts:
            return reading
        time.sleep(0.001)
    raise AssertionError(f"{counts} has not come: {line.read(2.5)}")


def test_lines_are_read_as_they_come_and_the_newest_counts(device):
    line = open_serial(device)
    assert line.read(0.0) is None
    device.say(b"1\n2\n-345\n")
    assert read_until(line, -345) == (-345, 2.5)
    device.say(b"77\r\n8")
    read_until(line, 77)
    device.say(b"1\n")
    read_until(line, 81)
    line.close()


def test_a_line_that_began_before_it_was_heard_is_not_taken_for_a_number(device):
    """Of -1234567 only the end would be there."""
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


def test_damaged_lines_are_passed_over(device):
    line = open_serial(device)
    device.say(b"\n5\n" + b"x" * 300 + b"6\n1_0\n\xff\xfe\n--3\n\n12345678901234\n")
    read_until(line, 5)
    device.say(b"8\n")
    read_until(line, 8)
    line.close()


def build_word(counts):
    content = counts.to_bytes(4, "little", signed=True)
    return b"\xa5" + content + bytes([sum(content) % 256])


def test_words_are_found_again_where_their_marker_stands_in_the_counts(device):
    """Every byte of these counts is the marker, and the line is joined in the middle."""
    line = open_serial(device, binary=True)
    counts = int.from_bytes(b"\xa5" * 4, "little", signed=True)
    device.say(build_word(counts)[3:] + build_word(counts) * 3 + build_word(-2))
    read_until(line, -2)
    device.say(build_word(counts)[:4])
    assert line.read(0.0)[0] == -2
    device.say(build_word(counts)[4:])
    read_until(line, counts)
    line.close()


def test_noise_does_not_pile_up(device):
    line = open_serial(device, binary=True)
    for _ in range(20):
        device.say(b"\x11" * 500)
        line.read(0.0)
    device.say(build_word(4))
    read_until(line, 4)
    assert len(line._unread) < 6
    line.close()


def test_a_serial_port_that_is_not_there_says_what_to_check():
    line = build("serial", port="/dev/no-such-port")
    with pytest.raises(EncoderError, match=r"no-such-port cannot be opened.*cable"):
        line.open()
    assert line.read(0.0) is None
    line.close()


def test_a_device_that_is_pulled_out_is_an_error_and_not_a_hang():
    device = Device()
    line = open_serial(device)
    device.close()
    end = time.monotonic() + LONGEST_S
    with pytest.raises(EncoderError, match="is gone"):
        while time.monotonic() < end:
            line.read(0.0)
    line.close()


class FakeError(Exception):
    """As nidaqmx.errors.Error: the root of what the package raises."""


class FakeChannels:
    def __init__(self, task):
        self._task = task

    def add_ci_ang_encoder_chan(
        self,
        counter,
        name_to_assign_to_channel="",
        decoding_type=None,
        zidx_enable=False,
        zidx_val=0,
        zidx_phase=None,
        units=None,
        pulses_per_rev=24,
        initial_angle=0.0,
        custom_scale_name="",
    ):
        if counter != "Dev1/ctr0":
            raise FakeError("Physical channel specified does not exist on this device.")
        self._task.asked = (decoding_type, units, pulses_per_rev, zidx_enable)
        self._task.channel = types.SimpleNamespace()
        return self._task.channel


class FakeTask:
    """What of nidaqmx.Task is used. angle: rad, None where the card is gone."""

    made: "list[FakeTask]" = []

    def __init__(self):
        self.ci_channels = FakeChannels(self)
        self.angle, self.running, self.closed = 0.0, False, False
        FakeTask.made.append(self)

    def start(self):
        self.running = True

    def read(self, number_of_samples_per_channel=None, timeout=10.0):
        assert self.running and not self.closed
        assert timeout <= 0.01
        if self.angle is None:
            raise FakeError("Device removed.")
        return self.angle

    def close(self):
        self.closed = True


@pytest.fixture
def card(monkeypatch):
    """A package as nidaqmx is laid out, with one card."""
    package, constants, errors = (
        types.ModuleType(f"nidaqmx{tail}") for tail in ("", ".constants", ".errors")
    )
    package.Task = FakeTask
    constants.AngleUnits = types.SimpleNamespace(RADIANS="radians")
    constants.EncoderType = types.SimpleNamespace(X_4="x4")
    errors.Error = FakeError
    for module in (package, constants, errors):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    FakeTask.made.clear()
    return FakeTask.made


def test_a_counter_counts_every_edge(card):
    """2000 lines are 8000 counts a turn, read on demand, signed."""
    counter = build("nidaqmx", counter="Dev1/ctr0", lines=2000, a_terminal="PFI8")
    counter.open()
    (task,) = card
    assert task.asked == ("x4", "radians", 2000, False)
    assert vars(task.channel) == {"ci_encoder_a_input_term": "PFI8"}
    for counts in (0, 1, -1, 8000, -123_457, 2**31 - 1, -(2**31)):
        task.angle = counts / 8000 * ONE_TURN
        assert counter.read(3.0) == (counts, 3.0)
    counter.close()
    assert task.closed
    assert counter.read(4.0) is None


def test_a_counter_that_does_not_exist_or_goes_away_is_said(card):
    wrong = build("nidaqmx", counter="Dev7/ctr0", lines=2000)
    with pytest.raises(EncoderError, match=r"Dev7/ctr0.*driver"):
        wrong.open()
    assert card[0].closed
    counter = build("nidaqmx", counter="Dev1/ctr0", lines=2000)
    counter.open()
    card[1].angle = None
    with pytest.raises(EncoderError, match="Device removed"):
        counter.read(0.0)


def test_without_the_package_it_says_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "nidaqmx", None)
    counter = build("nidaqmx", counter="Dev1/ctr0", lines=2000)
    with pytest.raises(EncoderError, match=r"pip install 'svsa-lab\[nidaqmx\]'"):
        counter.open()
    counter.close()


def test_a_recorded_file_is_replayed_in_its_own_time(tmp_path):
    path = tmp_path / "counts.csv"
    path.write_text("time_s,counts\n0.0,5\n0.1,6\n0.3,-7\n", "utf-8")
    source = build("replay", file=str(path))
    source.open()
    assert [source.read(t)[0] for t in (0.0, 0.05, 0.1, 0.25, 0.3, 9.0)] == [
        *(5, 5, 6, 6),
        *(-7, -7),
    ]
    assert source.read(30.0) == (-7, 30.0)
    source.close()


@pytest.mark.parametrize(
    "text", [None, "", "time_s,counts\n", "a,b\n0,x\n", "t,c\n1,2\n1,3\n", "t,c\n1\n"]
)
@pytest.mark.filterwarnings("ignore:.*input contained no data")
def test_a_file_that_cannot_be_replayed_is_an_error(tmp_path, text):
    path = tmp_path / "counts.csv"
    if text is not None:
        path.write_text(text, "utf-8")
    source = build("replay", file=str(path))
    with pytest.raises(EncoderError, match="cannot be replayed"):
        source.open()


def test_a_wrong_option_is_called_by_its_path_in_the_bench_file():
    with pytest.raises(ParameterError) as refused:
        build("can", id=0x700, width=99)
    assert [violation.name for violation in refused.value.violations] == [
        "deflection.options.width"
    ]
