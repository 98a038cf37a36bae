"""A drive family: one value with everything that the bench needs to know about it.

A package announces it as an entry point of the group `svsa.drives`, as `robomodule` is.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import can

from svsa.hardware.drives.drive import Drive, StopFrames
from svsa.hardware.drives.emulated import EmulatedDrive, EmulatedMotor
from svsa.hardware.settings import MotorSettings

if TYPE_CHECKING:
    from cantools.database.can import Message as DbcMessage


HOST = "host"
"""The name of this computer in a DBC file."""


class Advice(NamedTuple):
    """Advice of `svsa bench-check` on drives of a family.

    supply: "… is on and within …". wiring: what their maker presets on the bus. factory: the
    address of a new one. mode: what to look at where the mode is not taken. error: where a drive
    reports an error. current: where no current flows.
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
        name: The name of its entry point, and of `drive` in a bench file.
        title: Its maker and model.
        needs_fd: Whether it uses CAN FD.
        settings: The fields of `[motor1]` and `[motor2]` in a bench file.
        emulated: The fields of the same sections in an emulator's file.
        examples: The addresses of the two drives of the emulator, if its file gives none.
        build: Makes a drive from its settings, the control period (s) and a speed (counts/s) that
            the motor never reaches.
        build_stop: The frames that stop a drive.
        emulate: Makes an emulated drive.
        describe: The messages of a DBC file, from the settings of its drives by their names.
        list_questions: A frame for each address that a drive can have, which one there answers.
        find_place: The address of the drive that has sent an answer to such a frame, in words;
            None for other frames.
        advice: What `svsa bench-check` says of it.
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
