"""A DBC file of the bench, so that standard tools decode what was captured from its bus.

Made by cantools from the addresses of the two drives, from `LAYOUTS` and from the deflection
encoder's frame: nothing in it is written twice. Numbers are those of the wire (counts, mA,
rev/min); each command is a message of its own, since every mode lays its bytes out differently.
"""

from collections import OrderedDict
from collections.abc import Iterator

from cantools.database import Database
from cantools.database.can import Message, Node, Signal
from cantools.database.conversion import BaseConversion

from svsa.errors import ParameterError, Violation
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
from svsa.hardware.encoders.can_node import CanNodeSettings
from svsa.hardware.file import BenchFile, MotorSettings

HOST, ENCODER = "host", "deflection_encoder"
_FROM_DRIVE = (Command.FEEDBACK, Command.INPUTS, Command.ERROR)
_CHOICES = {
    "mode": {mode.value: mode.name.lower() for mode in Mode},
    "code": {STALL_PROTECTION: "stall_protection"},
}


def describe_bench(bench: BenchFile) -> str:
    """The DBC text of a bench file. Raises `ParameterError` where two frames have one id."""
    source = bench.deflection
    node = CanNodeSettings(**source.options) if source.source == "can" else None
    return build_dbc(_read_address(bench.motor1), _read_address(bench.motor2), node)


def build_dbc(motor1: Address, motor2: Address, deflection: CanNodeSettings | None = None) -> str:
    """The DBC text of two drives, and of the encoder where that is on the bus.

    Commands to a whole group are there as well. Raises `FrameError` for an address that no drive
    has, and `ParameterError` where two frames have one identifier.
    """
    drives = {"motor1": motor1, "motor2": motor2}
    messages: list[Message] = []
    for name, address in drives.items():
        messages += _list_messages(name, address, (name,))
    for group in sorted({address.group for address in drives.values()}):
        members = tuple(name for name, address in drives.items() if address.group == group)
        messages += _list_messages(f"group{group}", Address(group, 0), members)
    if deflection is not None:
        messages.append(_describe_encoder(deflection))
    _check_identifiers(messages)
    nodes = [HOST, *drives] + [ENCODER] * (deflection is not None)
    return Database(messages, [Node(name) for name in nodes]).as_dbc_string()


def _read_address(motor: MotorSettings) -> Address:
    return Address(motor.drive_group, motor.drive_number)


def _list_messages(name: str, address: Address, drives: tuple[str, ...]) -> Iterator[Message]:
    """What is said to a drive and by it; a group as such says nothing."""
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


def _describe_encoder(node: CanNodeSettings) -> Message:
    least = -(1 << node.width - 1) if node.signed else 0
    counts = Signal(
        "counts",
        8 * node.offset + (7 if node.big_endian else 0),
        node.width,
        byte_order="big_endian" if node.big_endian else "little_endian",
        is_signed=node.signed,
        minimum=least,
        maximum=least + (1 << node.width) - 1,
        unit="counts",
        receivers=[HOST],
    )
    return Message(
        node.id,
        "deflection",
        node.offset + node.width // 8,
        [counts],
        comment="Counts of the deflection encoder, by itself.",
        senders=[ENCODER],
        is_extended_frame=node.extended,
    )


def _check_identifiers(messages: list[Message]) -> None:
    names: dict[tuple[int, bool], str] = {}
    for message in messages:
        identifier = (message.frame_id, message.is_extended_frame)
        if identifier in names:
            bound = f"another than that of {names[identifier]}"
            raise ParameterError(Violation(f"id of {message.name}", message.frame_id, "", bound))
        names[identifier] = message.name
