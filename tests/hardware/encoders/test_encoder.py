"""Sources of deflection counts: a CAN node or a file; rejected options."""

import can
import pytest

from svsa.errors import ParameterError
from svsa.hardware.bench.settings import DeflectionSettings
from svsa.hardware.drives.conversion import Unwrapped
from svsa.hardware.encoders import read_source
from svsa.hardware.encoders.nidaqmx_counter import NidaqmxCounter
from svsa.hardware.encoders.serial_line import SerialLine
from svsa.hardware.encoders.source import EncoderError


def build(source, **options):
    return read_source(DeflectionSettings(source=source, options=options))


def test_source_is_selected_by_its_name():
    assert isinstance(build("serial", port="/dev/ttyUSB0"), SerialLine)
    assert isinstance(build("nidaqmx", counter="Dev1/ctr0", lines=2000), NidaqmxCounter)


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
def test_counts_have_the_position_of_the_options(options, data, counts):
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
def test_other_frames_change_nothing(frame):
    node = build("can", id=0x700)
    node.feed(build_frame((7).to_bytes(4, "big")), 1.0)
    assert not node.feed(frame, 2.0)
    assert node.read(3.0) == (7, 1.0)


def test_narrow_counter_is_unwrapped_by_its_own_width():
    node = build("can", id=0x700, width=16)
    unwrapped = Unwrapped(node.bits)
    for counts in (32_000, 33_000, 65_000, 66_000, 40_000):
        node.feed(build_frame((counts % 2**16).to_bytes(2, "big")), 0.0)
        assert unwrapped.update(node.read(0.0)[0]) == counts


@pytest.mark.parametrize(
    "options", [{}, {"id": 1, "width": 12}, {"id": 1, "offset": 6}, {"id": 1, "other": 1}]
)
def test_invalid_options_are_rejected_by_name(options):
    with pytest.raises(ParameterError):
        build("can", **options)


def test_recorded_file_is_replayed_in_its_own_time(tmp_path):
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
    "text",
    [
        *(None, "", "time_s,counts\n", "a,b\n0,x\n", "t,c\n1,2\n1,3\n", "t,c\n1\n"),
        *("t,c\n0,0,5\n1,0,6\n", "t;c\n0;5\n0,1;6\n", "t,c\n0,5.5\n1,6\n"),
    ],
)
@pytest.mark.filterwarnings("ignore:.*input contained no data")
def test_unreadable_file_is_an_error(tmp_path, text):
    path = tmp_path / "counts.csv"
    if text is not None:
        path.write_text(text, "utf-8")
    source = build("replay", file=str(path))
    with pytest.raises(EncoderError, match="cannot be replayed"):
        source.open()


def test_invalid_option_is_named_by_its_path_in_the_bench_file():
    with pytest.raises(ParameterError) as refused:
        build("can", id=0x700, width=99)
    assert [violation.name for violation in refused.value.violations] == [
        "deflection.options.width"
    ]
