"""A drive family: everything about it that the bench needs, in one value.

A package registers it as an entry point of the group `svsa.drives`, like `robomodule`.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import can

from svsa.hardware.bench.settings import MotorSettings
from svsa.hardware.drives.drive import Drive, StopFrames
from svsa.hardware.drives.emulated import EmulatedDrive, EmulatedMotor

if TYPE_CHECKING:
    from cantools.database.can import Message as DbcMessage


HOST = "host"
"""The name of this computer in a DBC file."""


class Advice(NamedTuple):
    """Advice of `svsa bench-check` for drives of a family.

    Attributes:
        supply: Completes "… is on and within …".
        wiring: Bus settings preset by the manufacturer.
        factory: Address of a new drive.
        mode: What to check if the drive does not enter its mode.
        error: What to check if a drive reports an error.
        current: What to check if no current flows.
    """

    supply: str
    wiring: str
    factory: str
    mode: str
    error: str
    current: str


@dataclass(frozen=True, kw_only=True)
class DriveFamily:
    """A family of drives.

    Attributes:
        name: Name of its entry point, and of `drive` in a bench file.
        title: Manufacturer and model.
        needs_fd: Whether it uses CAN FD.
        settings: Fields of `[motor1]` and `[motor2]` in a bench file.
        emulated: Fields of the same sections in an emulator's file.
        examples: Default addresses of the two drives of the emulator.
        build: Creates a drive from its settings, the control period (s) and a speed (counts/s) that
            the motor never reaches.
        build_stop: Returns the frames that stop a drive.
        emulate: Creates an emulated drive.
        describe: Returns the messages of a DBC file, from the settings of the drives by name.
        list_questions: Returns a frame for each possible address, which the drive there answers.
        find_place: Returns as text the address of the drive that answered such a frame; None for
            other frames.
        advice: Advice of `svsa bench-check`.
    """

    name: str
    title: str
    needs_fd: bool
    settings: type[MotorSettings]
    emulated: type[EmulatedMotor]
    examples: tuple[Mapping[str, int], Mapping[str, int]]
    build: Callable[[Any, float, float], Drive]
    build_stop: Callable[[Any], StopFrames]
    emulate: Callable[[Any], EmulatedDrive]
    describe: Callable[[Mapping[str, Any]], "list[DbcMessage]"]
    list_questions: Callable[[], Iterable[can.Message]]
    find_place: Callable[[can.Message], str | None]
    advice: Advice
