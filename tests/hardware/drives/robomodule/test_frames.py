"""Frames of the drives: test vectors of the manufacturer, round trips, rejections, any bytes."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from svsa.errors import SvsaError
from svsa.hardware.bench.emulation import ADVANCE_ID, EMULATED_ID, decode_time, encode_time
from svsa.hardware.drives.robomodule import (
    LAYOUTS,
    Address,
    Command,
    Config,
    Current,
    CurrentPosition,
    CurrentVelocity,
    CurrentVelocityPosition,
    DriveError,
    Feedback,
    FrameError,
    Inputs,
    Mode,
    Online,
    OpenLoop,
    Position,
    Reset,
    SetMode,
    Velocity,
    VelocityPosition,
    build_id,
    decode,
    encode,
    split_id,
)

MANUAL = [
    (Current(5000, 1000), "13 88 03 E8 55 55 55 55"),
    (OpenLoop(500), "01 F4 55 55 55 55 55 55"),
    (OpenLoop(-500), "FE 0C 55 55 55 55 55 55"),
    (Reset(), "55 55 55 55 55 55 55 55"),
    (Online(), "55 55 55 55 55 55 55 55"),
    (SetMode(Mode.CURRENT), "02 55 55 55 55 55 55 55"),
    (SetMode(Mode.CURRENT_VELOCITY_POSITION), "08 55 55 55 55 55 55 55"),
    (Config(1, 0), "01 00 55 55 55 55 55 55"),
    (DriveError(1), "01 55 55 55 55 55 55 55"),
]
LAID_OUT = [
    (Velocity(5000, -1000), "13 88 FC 18 55 55 55 55"),
    (Position(5000, -2), "13 88 55 55 FF FF FF FE"),
    (VelocityPosition(1, 2, 0x01020304), "00 01 00 02 01 02 03 04"),
    (CurrentVelocity(1000, -30), "03 E8 FF E2 55 55 55 55"),
    (CurrentPosition(1000, 100_000), "03 E8 55 55 00 01 86 A0"),
    (CurrentVelocityPosition(1000, 30, -100_000), "03 E8 00 1E FF FE 79 60"),
    (Feedback(-1000, 30, -1), "FC 18 00 1E FF FF FF FF"),
    (Inputs(1, 0, 1, 0x0203, 4, -500), "01 00 01 02 03 04 FE 0C"),
]
FIELDS = [
    (command, position, field)
    for command, layout in LAYOUTS.items()
    for position, field in enumerate(layout.fields)
]


def build(command, values):
    message = LAYOUTS[command].message
    return message(*(Mode(value) if message is SetMode else value for value in values))


@st.composite
def messages(draw):
    command = draw(st.sampled_from(list(LAYOUTS)))
    fields = LAYOUTS[command].fields
    return build(command, [draw(st.integers(field.least, field.most)) for field in fields])


@pytest.mark.parametrize(("message", "bytes_"), MANUAL + LAID_OUT)
def test_bytes_match_the_manual(message, bytes_):
    assert encode(message) == bytes.fromhex(bytes_)
    read = decode(message.command, bytes.fromhex(bytes_))
    assert (type(read), read) == (type(message), message)


@pytest.mark.parametrize(
    ("address", "command", "can_id"),
    [
        (Address(0, 1), Command.CURRENT, 0x013),
        (Address(0, 1), Command.OPEN_LOOP, 0x012),
        (Address(0, 0), Command.RESET, 0x000),
        (Address(7, 15), Command.ONLINE, 0x7FF),
        (Address(0, 2), Command.FEEDBACK, 0x02B),
    ],
)
def test_identifier_consists_of_group_number_and_command(address, command, can_id):
    assert build_id(address, command) == can_id
    assert split_id(can_id) == (address, command)


def test_every_command_has_one_layout_and_every_mode_one_data_command():
    assert set(LAYOUTS) == set(Command)
    assert [command.mode for command in Command if command.mode] == list(Mode)
    assert all(command.mode == command - 1 for command in Command if command.mode)


@given(message=messages())
def test_encoded_message_is_decoded_unchanged(message):
    data = encode(message)
    assert len(data) == 8
    read = decode(message.command, data)
    assert (type(read), read) == (type(message), message)
    assert encode(read) == data


@given(message=messages(), fill=st.binary(min_size=8, max_size=8))
def test_unused_bytes_are_ignored(message, fill):
    used = {
        field.start + offset
        for field in LAYOUTS[message.command].fields
        for offset in range(field.packer.size)
    }
    clean = encode(message)
    dirty = bytes(clean[i] if i in used else fill[i] for i in range(8))
    assert all(clean[i] == 0x55 for i in range(8) if i not in used)
    assert decode(message.command, dirty) == message


@pytest.mark.parametrize(("command", "position", "field"), FIELDS)
@given(beyond=st.integers(1, 2**70), below=st.booleans())
def test_value_out_of_range_is_rejected_by_name_and_bound(command, position, field, beyond, below):
    values = [other.least for other in LAYOUTS[command].fields]
    values[position] = field.least - beyond if below else field.most + beyond
    with pytest.raises(FrameError) as refused:
        encode(LAYOUTS[command].message(*values))
    violation = refused.value.violation
    assert (violation.name, violation.value) == (field.name, values[position])
    assert str(field.least) in violation.bound
    assert str(field.most) in violation.bound


@pytest.mark.parametrize(("command", "position", "field"), FIELDS)
@pytest.mark.parametrize("value", [math.nan, math.inf, 1.0, None, "1", b"\x01", []])
def test_non_integer_is_rejected(command, position, field, value):
    values = [other.least for other in LAYOUTS[command].fields]
    values[position] = value
    with pytest.raises(FrameError, match=field.name):
        encode(LAYOUTS[command].message(*values))


@given(can_id=st.integers(-(2**33), 2**33))
def test_any_identifier_is_split_or_rejected(can_id):
    if 0 <= can_id <= 0x7FF and can_id & 0xF != 14:
        address, command = split_id(can_id)
        assert build_id(address, command) == can_id
    else:
        with pytest.raises(FrameError):
            split_id(can_id)


@given(group=st.integers(-3, 10), number=st.integers(-3, 20))
def test_invalid_drive_address_is_rejected(group, number):
    if 0 <= group <= 7 and 0 <= number <= 15:
        assert split_id(build_id(Address(group, number), Command.MODE))[0] == (group, number)
    else:
        with pytest.raises(FrameError, match="group" if not 0 <= group <= 7 else "number"):
            build_id(Address(group, number), Command.MODE)


@given(command=st.sampled_from(Command), data=st.binary(max_size=64))
def test_any_bytes_are_a_message_or_rejected(command, data):
    try:
        message = decode(command, data)
    except FrameError as refused:
        assert isinstance(refused, SvsaError)
        assert str(refused)
    else:
        assert len(data) == 8
        assert decode(command, encode(message)) == message


@given(command=st.sampled_from(Command), data=st.binary(min_size=8, max_size=8))
def test_reports_of_a_drive_are_never_rejected_for_their_values(command, data):
    """A fault must not be lost because of an unusual value next to it."""
    if command in (Command.FEEDBACK, Command.INPUTS, Command.ERROR, Command.ONLINE):
        assert decode(command, data).command is command


@given(time_us=st.integers(0, 2**64 - 1))
def test_lockstep_time_fits_a_frame(time_us):
    assert len(encode_time(time_us)) == 8
    assert decode_time(encode_time(time_us)) == time_us


def test_emulation_marker_uses_no_identifier_of_a_drive():
    assert min(ADVANCE_ID, EMULATED_ID) > 0x7FF
    assert max(ADVANCE_ID, EMULATED_ID) < 2**29
    assert ADVANCE_ID != EMULATED_ID
