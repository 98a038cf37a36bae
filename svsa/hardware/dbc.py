"""DBC file of a bench, with which CAN tools decode captured traffic.

Made by cantools from what the families of the two drives describe and from the deflection
encoder's frame: nothing in it is written twice.
"""

from cantools.database import Database
from cantools.database.can import Message, Node, Signal

from svsa.errors import ParameterError, Violation
from svsa.hardware.drives.family import HOST
from svsa.hardware.drives.installed import get_family
from svsa.hardware.encoders.can_node import CanNodeSettings
from svsa.hardware.file import BenchFile

ENCODER = "deflection_encoder"


def describe_bench(bench: BenchFile) -> str:
    """The DBC text of a bench file: drives, and the encoder where that is on the bus.

    Raises `ParameterError` where two frames have one identifier.
    """
    motors = {"motor1": bench.motor1, "motor2": bench.motor2}
    messages: list[Message] = []
    for drive in dict.fromkeys(motor.drive for motor in motors.values()):
        theirs = {name: motor for name, motor in motors.items() if motor.drive == drive}
        messages += get_family(drive).describe(theirs)
    nodes = [HOST, *motors]
    if bench.deflection.source == "can":
        messages.append(_describe_encoder(CanNodeSettings(**bench.deflection.options)))
        nodes.append(ENCODER)
    _check_identifiers(messages)
    return Database(messages, [Node(name) for name in nodes]).as_dbc_string()


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
        comment="Counts of the deflection encoder alone.",
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
