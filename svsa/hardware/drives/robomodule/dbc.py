"""The messages of RoboModule drives for a DBC file.

Numbers are those on the bus (counts, mA, rev/min), each field as in `LAYOUTS`; each command is a
separate message, because every mode has a different layout.
"""

from collections import OrderedDict
from collections.abc import Iterator, Mapping

from cantools.database.can import Message, Signal
from cantools.database.conversion import BaseConversion

from svsa.hardware.drives.family import HOST
from svsa.hardware.drives.robomodule import (
    LAYOUTS,
    LENGTH,
    STALL_PROTECTION,
    Address,
    Command,
    Field,
    Mode,
    build_id,
)

_FROM_DRIVE = (Command.FEEDBACK, Command.INPUTS, Command.ERROR)
_CHOICES = {
    "mode": {mode.value: mode.name.lower() for mode in Mode},
    "code": {STALL_PROTECTION: "stall_protection"},
}


def describe_drives(drives: Mapping[str, Address]) -> list[Message]:
    """Describe the messages of some drives, and the commands to their groups.

    Raises:
        FrameError: If no drive can have an address.
    """
    messages: list[Message] = []
    for name, address in drives.items():
        messages += _list_messages(name, address, (name,))
    for group in sorted({address.group for address in drives.values()}):
        members = tuple(name for name, address in drives.items() if address.group == group)
        messages += _list_messages(f"group{group}", Address(group, 0), members)
    return messages


def _list_messages(name: str, address: Address, drives: tuple[str, ...]) -> Iterator[Message]:
    """Commands to a drive and its messages; a group sends no messages."""
    for command, layout in LAYOUTS.items():
        if command not in _FROM_DRIVE:
            senders, receivers = (HOST,), drives
        elif address.number:
            senders, receivers = drives, (HOST,)
        else:
            continue
        if command is Command.ONLINE and address.number:
            senders, receivers = (HOST, *drives), (HOST, *drives)
        yield Message(
            build_id(address, command),
            f"{name}_{command.name.lower()}",
            LENGTH,
            [_describe_field(field, receivers) for field in layout.fields],
            comment=" ".join((layout.message.__doc__ or "").split()),
            senders=list(senders),
        )


def _describe_field(field: Field, receivers: tuple[str, ...]) -> Signal:
    choices = _CHOICES.get(field.name)
    return Signal(
        field.name,
        8 * field.start + 7,
        8 * field.packer.size,
        byte_order="big_endian",
        is_signed=field.packer.format[-1].islower(),
        conversion=BaseConversion.factory(choices=OrderedDict(choices) if choices else None),
        minimum=field.least,
        maximum=field.most,
        unit=field.unit,
        receivers=list(receivers),
    )
