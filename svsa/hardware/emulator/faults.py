"""Faults of an emulated bench, one model each, injected on demand."""

from typing import Annotated, Literal

from svsa.inputs.checked import BY_KIND, Checked, Number, Whole, quantity

Node = Literal["motor1", "motor2", "deflection"]
DriveName = Literal["motor1", "motor2"]


class DropFrames(Checked):
    """Frames of a node are lost, each with this probability (seeded)."""

    kind: Literal["drop"] = "drop"
    node: Node = quantity("", "Sender of the frames")
    probability: Number = quantity("1", "Probability for each frame", gt=0, le=1, default=1.0)


class LateFrames(Checked):
    """Frames of a node are late."""

    kind: Literal["late"] = "late"
    node: Node = quantity("", "Sender of the frames")
    delay_s: Number = quantity("s", "Delay", gt=0, le=10)


class FrozenEncoder(Checked):
    """Counts that stay as they are."""

    kind: Literal["freeze"] = "freeze"
    node: Node = quantity("", "Encoder")


class ReversedEncoder(Checked):
    """Counts that go the wrong way."""

    kind: Literal["reverse_encoder"] = "reverse_encoder"
    node: Node = quantity("", "Encoder")


class ReversedMotor(Checked):
    """Torque with the wrong sign."""

    kind: Literal["reverse_motor"] = "reverse_motor"
    node: DriveName = quantity("", "Motor")


class BrownOut(Checked):
    """A drive that restarts: no mode, position zero."""

    kind: Literal["brown_out"] = "brown_out"
    node: DriveName = quantity("", "Drive")


class Stall(Checked):
    """A drive in stall protection: no torque, an error frame every 100 ms."""

    kind: Literal["stall"] = "stall"
    node: DriveName = quantity("", "Drive")


class Unplugged(Checked):
    """A drive with a disconnected CAN cable: it holds its last current, and receives and sends
    nothing.
    """

    kind: Literal["unplugged"] = "unplugged"
    node: DriveName = quantity("", "Drive")


class ZeroedCounter(Checked):
    """A drive that sets its position to zero without leaving its mode."""

    kind: Literal["zeroed_counter"] = "zeroed_counter"
    node: DriveName = quantity("", "Drive")


class Silence(Checked):
    """A drive without power."""

    kind: Literal["silent"] = "silent"
    node: DriveName = quantity("", "Drive")


class BusErrors(Checked):
    """Error frames on the bus, one a millisecond."""

    kind: Literal["bus_errors"] = "bus_errors"
    count: Whole = quantity("frames", "Number of values", ge=1, le=10_000, default=1)


class CurrentOffset(Checked):
    """A drive with more current than commanded."""

    kind: Literal["current_offset"] = "current_offset"
    node: DriveName = quantity("", "Drive")
    offset_a: Number = quantity("A", "Additional current", ge=-15, le=15)


EmulatorFault = Annotated[
    DropFrames
    | LateFrames
    | FrozenEncoder
    | ReversedEncoder
    | ReversedMotor
    | BrownOut
    | Stall
    | Silence
    | Unplugged
    | ZeroedCounter
    | BusErrors
    | CurrentOffset,
    BY_KIND,
]
