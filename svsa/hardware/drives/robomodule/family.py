"""The family of RoboModule drives, as the bench finds it."""

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

import can

from svsa.hardware.drives.family import Advice, DriveFamily
from svsa.hardware.drives.robomodule import (
    Address,
    Command,
    FrameError,
    Online,
    split_id,
)
from svsa.hardware.drives.robomodule.drive import RoboModuleDrive, build_message, build_stop
from svsa.hardware.drives.robomodule.emulated import EmulatedRoboModuleDrive
from svsa.hardware.drives.robomodule.settings import (
    EmulatedRoboModuleMotor,
    RoboModuleSettings,
    describe_place,
)

if TYPE_CHECKING:
    from cantools.database.can import Message as DbcMessage


def _describe(motors: Mapping[str, RoboModuleSettings]) -> "list[DbcMessage]":
    # cantools takes a second to import, and only a DBC file needs it.
    from svsa.hardware.drives.robomodule.dbc import describe_drives

    return describe_drives({name: motor.address for name, motor in motors.items()})


def _list_questions() -> Iterable[can.Message]:
    """The online check of each address."""
    for group in range(8):
        for number in range(1, 16):
            yield build_message(Address(group, number), Online())


def _find_place(message: can.Message) -> str | None:
    """Source of an echo of the online check."""
    if message.is_extended_id:
        return None
    try:
        address, command = split_id(message.arbitration_id)
    except FrameError:
        return None
    return describe_place(address) if command is Command.ONLINE else None


ROBOMODULE = DriveFamily(
    name="robomodule",
    title="RoboModule RMDS",
    needs_fd=False,
    settings=RoboModuleSettings,
    emulated=EmulatedRoboModuleMotor,
    examples=({"number": 1}, {"number": 2}),
    build=RoboModuleDrive,
    build_stop=build_stop,
    emulate=EmulatedRoboModuleDrive,
    describe=_describe,
    list_questions=_list_questions,
    find_place=_find_place,
    advice=Advice(
        supply="the drive's supply is on and within 7 V to 33 V",
        wiring="the drives leave the factory at 1 Mbit/s",
        factory="group 0, number 1",
        mode="check that its firmware speaks the protocol of 2018-07 and that its supply does not"
        " break down",
        error="The drive went into stall protection: see that the motor turns freely, its brake is"
        " off and its leads are not shorted; switch the drive off and on.",
        current="that pwm_limit is not too low",
    ),
)
