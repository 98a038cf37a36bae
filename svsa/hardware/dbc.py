"""A DBC file of the bench, so that standard tools decode what was captured from its bus.

Made from the addresses of the two drives, from `LAYOUTS` and from the deflection encoder's frame:
nothing in it is written twice. Numbers are those of the wire (counts, mA, rev/min); each command
is a message of its own, since every mode lays its bytes out differently.
"""

from collections.abc import Iterator
from typing import NamedTuple

from svsa.errors import ParameterError, Violation
from svsa.hardware.bench import BenchFile, MotorSettings
from svsa.hardware.encoders.can_node import CanNodeSettings
from svsa.hardware.robomodule import (
    LAYOUTS,
    LENGTH,
    STALL_PROTECTION,
    Address,
    Command,
    Field,
    Mode,
    build_id,
)

HOST, ENCODER = "host", "deflection_encoder"
_FROM_DRIVE = (Command.FEEDBACK, Command.INPUTS, Command.ERROR)
_EXTENDED = 1 << 31


class _Signal(NamedTuple):
    name: str
    first_bit: int
    bits: int
    big_endian: bool
    signed: bool
    least: int
    most: int
    unit: str


class _Message(NamedTuple):
    number: int
    name: str
    length: int
    senders: tuple[str, ...]
    receivers: tuple[str, ...]
    signals: tuple[_Signal, ...]
    meaning: str


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
    messages: list[_Message] = []
    for name, address in drives.items():
        messages += _list_messages(name, address, (name,))
    for group in sorted({address.group for address in drives.values()}):
        members = tuple(name for name, address in drives.items() if address.group == group)
        messages += _list_messages(f"group{group}", Address(group, 0), members)
    if deflection is not None:
        messages.append(_describe_encoder(deflection))
    _check_numbers(messages)
    nodes = [HOST, *drives] + [ENCODER] * (deflection is not None)
    lines = ['VERSION ""', "NS_ :", "BS_:", f"BU_: {' '.join(nodes)}", ""]
    for message in messages:
        lines += [*_write_message(message), ""]
    for message in messages:
        if len(message.senders) > 1:
            lines.append(f"BO_TX_BU_ {message.number} : {','.join(message.senders)};")
    lines += [f'CM_ BO_ {m.number} "{m.meaning}";' for m in messages]
    lines += [line for message in messages for line in _name_values(message)]
    return "\n".join(lines) + "\n"


def _read_address(motor: MotorSettings) -> Address:
    return Address(motor.drive_group, motor.drive_number)


def _list_messages(name: str, address: Address, drives: tuple[str, ...]) -> Iterator[_Message]:
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
        yield _Message(
            build_id(address, command),
            f"{name}_{command.name.lower()}",
            LENGTH,
            senders,
            receivers,
            tuple(map(_describe_field, layout.fields)),
            " ".join((layout.message.__doc__ or "").split()),
        )


def _describe_field(field: Field) -> _Signal:
    kind = field.packer.format[-1]
    bits, signed = 8 * field.packer.size, kind.islower()
    return _Signal(
        field.name, 8 * field.start, bits, True, signed, field.least, field.most, field.unit
    )


def _describe_encoder(node: CanNodeSettings) -> _Message:
    least = -(1 << node.width - 1) if node.signed else 0
    most = least + (1 << node.width) - 1
    counts = _Signal(
        "counts",
        8 * node.offset,
        node.width,
        node.big_endian,
        node.signed,
        least,
        most,
        "counts",
    )
    number = node.id | _EXTENDED if node.extended else node.id
    end = node.offset + node.width // 8
    meaning = "Counts of the deflection encoder, by itself."
    return _Message(number, "deflection", end, (ENCODER,), (HOST,), (counts,), meaning)


def _check_numbers(messages: list[_Message]) -> None:
    names: dict[int, str] = {}
    for message in messages:
        if message.number in names:
            bound = f"another than that of {names[message.number]}"
            raise ParameterError(Violation(f"id of {message.name}", message.number, "", bound))
        names[message.number] = message.name


def _write_message(message: _Message) -> Iterator[str]:
    receivers = ",".join(message.receivers)
    yield f"BO_ {message.number} {message.name}: {message.length} {message.senders[0]}"
    for s in message.signals:
        start = s.first_bit + 7 if s.big_endian else s.first_bit
        coding = f"{start}|{s.bits}@{0 if s.big_endian else 1}{'-' if s.signed else '+'}"
        yield f' SG_ {s.name} : {coding} (1,0) [{s.least}|{s.most}] "{s.unit}" {receivers}'


def _name_values(message: _Message) -> Iterator[str]:
    for signal in message.signals:
        if signal.name == "mode":
            names = " ".join(f'{mode.value} "{mode.name.lower()}"' for mode in Mode)
        elif signal.name == "code":
            names = f'{STALL_PROTECTION} "stall_protection"'
        else:
            continue
        yield f"VAL_ {message.number} {signal.name} {names} ;"
