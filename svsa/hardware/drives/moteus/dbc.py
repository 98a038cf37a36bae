"""The messages of moteus controllers for a DBC file: the frames that are used here."""

from collections import OrderedDict

from cantools.database.can import Message, Signal
from cantools.database.conversion import BaseConversion

from svsa.hardware.drives.family import HOST
from svsa.hardware.drives.moteus import HOST as SOURCE
from svsa.hardware.drives.moteus import Mode, build_id
from svsa.hardware.drives.moteus.drive import FAULT_WORDS

_MODES = {mode.value: mode.name.lower() for mode in Mode}


def describe_drives(drives: dict[str, int]) -> list[Message]:
    """The command and the reply of each controller, by their identifiers."""
    messages: list[Message] = []
    for name, controller_id in drives.items():
        messages += [_describe_command(name, controller_id), _describe_reply(name, controller_id)]
    return messages


def _describe_command(name: str, controller_id: int) -> Message:
    return Message(
        build_id(SOURCE, controller_id, reply=True),
        f"{name}_command",
        32,
        [
            _signal("mode", 2, 8, "", name, _MODES),
            _signal("torque_nm", 9, 32, "N·m", name, is_float=True),
            _signal("timeout_s", 19, 16, "s", name, scale=0.001),
        ],
        comment="To a controller: torque in position mode without gains; a stop has the mode only.",
        senders=[HOST],
        is_extended_frame=True,
        is_fd=True,
    )


def _describe_reply(name: str, controller_id: int) -> Message:
    reply = build_id(controller_id, SOURCE)
    faults = {code: words.replace(" ", "_") for code, words in FAULT_WORDS.items()}
    return Message(
        reply,
        f"{name}_reply",
        20,
        [
            _signal("mode", 2, 8, "", HOST, _MODES),
            _signal("position", 5, 32, "turns", HOST, scale=0.00001),
            _signal("q_current", 11, 32, "A", HOST, scale=0.001),
            _signal("fault", 17, 8, "", HOST, faults),
        ],
        comment="From a controller, to each command.",
        senders=[name],
        is_extended_frame=reply > 0x7FF,
        is_fd=True,
    )


def _signal(
    name: str,
    start: int,
    bits: int,
    unit: str,
    receiver: str,
    choices: dict[int, str] | None = None,
    scale: float = 1,
    is_float: bool = False,
) -> Signal:
    """Describe a signal; `start` is its first byte."""
    return Signal(
        name,
        8 * start,
        bits,
        byte_order="little_endian",
        is_signed=True,
        conversion=BaseConversion.factory(
            scale=scale,
            choices=OrderedDict(choices) if choices else None,
            is_float=is_float,
        ),
        unit=unit,
        receivers=[receiver],
    )
