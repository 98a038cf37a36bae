"""The DBC file, read by cantools: it agrees with our codec on every frame."""

from pathlib import Path

import cantools
import pytest
from hypothesis import given
from hypothesis import strategies as st

import svsa
from svsa.errors import ParameterError
from svsa.hardware.description.dbc import describe_bench
from svsa.hardware.description.file import read_bench
from svsa.hardware.drives.robomodule import (
    LAYOUTS,
    Address,
    Command,
    build_id,
    decode,
    encode,
)
from svsa.hardware.encoders.can_node import CanNodeSettings

from .test_frames import messages

BENCH = read_bench(Path(svsa.__file__).parent / "hardware" / "emulator" / "bench.toml")
MOTOR1, MOTOR2 = Address(0, 1), Address(3, 15)
FROM_DRIVE = {Command.FEEDBACK, Command.INPUTS, Command.ERROR}


def build_dbc(motor1, motor2, node=None):
    """Build the DBC text of a bench with drives at these addresses, and with this encoder."""
    motors = {
        name: getattr(BENCH, name).changed(drive_group=address.group, drive_number=address.number)
        for name, address in (("motor1", motor1), ("motor2", motor2))
    }
    source = {"source": "can", "options": dict(node)} if node else {"source": "serial"}
    return describe_bench(BENCH.changed(**motors, deflection=BENCH.deflection.changed(**source)))


TEXT = build_dbc(MOTOR1, MOTOR2, CanNodeSettings(id=0x700))
DATABASE = cantools.database.load_string(TEXT, "dbc")


@given(message=messages(), address=st.sampled_from([MOTOR1, MOTOR2]))
def test_cantools_decodes_every_frame_like_our_codec(message, address):
    data = encode(message)
    can_id = build_id(address, message.command)
    read = DATABASE.decode_message(can_id, data, decode_choices=False)
    assert read == decode(message.command, data)._asdict()


@given(message=messages(), address=st.sampled_from([MOTOR1, MOTOR2]))
def test_our_codec_decodes_frames_of_cantools(message, address):
    can_id = build_id(address, message.command)
    values = {name: int(value) for name, value in message._asdict().items()}
    data = DATABASE.encode_message(can_id, values, padding=True)
    assert decode(message.command, data) == message


def test_two_drives_have_thirty_messages_including_group_commands():
    expected = {build_id(address, command) for address in (MOTOR1, MOTOR2) for command in Command}
    for group in (0, 3):
        commands = set(Command) - FROM_DRIVE
        expected |= {build_id(Address(group, 0), command) for command in commands}
    assert {message.frame_id for message in DATABASE.messages} == expected | {0x700}
    assert len(DATABASE.messages) == 2 * len(LAYOUTS) + 2 * (len(LAYOUTS) - 3) + 1
    names = [message.name for message in DATABASE.messages]
    assert len(set(names)) == len(names)
    assert max(map(len, names)) <= 32, "the longest name that a DBC file may have"


def test_messages_have_sender_receiver_and_units():
    feedback = DATABASE.get_message_by_name("motor2_feedback")
    assert feedback.senders == ["motor2"]
    assert feedback.receivers == {"host"}
    units = {signal.name: signal.unit for signal in feedback.signals}
    assert units == {"current_ma": "mA", "velocity_rpm": "rpm", "position_counts": "counts"}
    current = DATABASE.get_message_by_name("motor1_current")
    assert (current.senders, current.receivers) == (["host"], {"motor1"})
    assert DATABASE.get_message_by_name("group0_current").receivers == {"motor1"}
    assert set(DATABASE.get_message_by_name("motor1_online").senders) == {"host", "motor1"}
    limits = DATABASE.get_message_by_name("motor1_current").get_signal_by_name("pwm_limit")
    assert (limits.minimum, limits.maximum) == (0, 5000)


def test_modes_and_stall_protection_are_named():
    mode = DATABASE.decode_message(0x011, bytes.fromhex("0255555555555555"))
    assert str(mode["mode"]) == "current"
    error = DATABASE.decode_message(0x01D, bytes.fromhex("0155555555555555"))
    assert str(error["code"]) == "stall_protection"


@given(data=st.data(), width=st.sampled_from([16, 24, 32]), flags=st.tuples(*[st.booleans()] * 3))
def test_encoder_has_the_position_of_the_bench_file(data, width, flags):
    big_endian, signed, extended = flags
    offset = data.draw(st.integers(0, 8 - width // 8))
    node = CanNodeSettings(
        id=0x1ABCDEF if extended else 0x123,
        extended=extended,
        offset=offset,
        width=width,
        big_endian=big_endian,
        signed=signed,
    )
    database = cantools.database.load_string(build_dbc(MOTOR1, MOTOR2, node), "dbc")
    message = database.get_message_by_name("deflection")
    assert (message.frame_id, message.is_extended_frame) == (node.id, extended)
    payload = data.draw(st.binary(min_size=8, max_size=8))
    counts = int.from_bytes(
        payload[offset : offset + width // 8], "big" if big_endian else "little", signed=signed
    )
    assert message.decode(payload) == {"counts": counts}


def test_file_without_a_can_encoder_has_no_encoder_message():
    database = cantools.database.load_string(build_dbc(MOTOR1, MOTOR2), "dbc")
    assert "deflection" not in {message.name for message in database.messages}


@pytest.mark.parametrize(
    ("motor1", "motor2", "node"),
    [
        (Address(0, 1), Address(0, 1), None),
        (Address(0, 1), Address(0, 2), CanNodeSettings(id=0x02B)),
    ],
)
def test_two_frames_with_one_identifier_are_rejected(motor1, motor2, node):
    with pytest.raises(ParameterError, match="different from the id of"):
        build_dbc(motor1, motor2, node)


def test_bench_file_of_the_rig_is_described():
    database = cantools.database.load_string(describe_bench(BENCH), "dbc")
    assert database.get_message_by_name("deflection").frame_id == 0x700
    assert database.get_message_by_name("motor2_feedback").frame_id == 0x02B
