"""The family of moteus controllers, as the bench finds it."""

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

import can

from svsa.hardware.drives.family import Advice, DriveFamily
from svsa.hardware.drives.moteus import HOST, QUERY, decode_reply
from svsa.hardware.drives.moteus.drive import MoteusDrive, build_message, build_stop
from svsa.hardware.drives.moteus.emulated import EmulatedMoteusDrive
from svsa.hardware.drives.moteus.settings import (
    EmulatedMoteusMotor,
    MoteusSettings,
    describe_place,
)

if TYPE_CHECKING:
    from cantools.database.can import Message as DbcMessage


def _describe(motors: Mapping[str, MoteusSettings]) -> "list[DbcMessage]":
    # cantools takes a second to import, and only a DBC file needs it.
    from svsa.hardware.drives.moteus.dbc import describe_drives

    return describe_drives({name: motor.id for name, motor in motors.items()})


def _list_questions() -> Iterable[can.Message]:
    return (build_message(controller_id, QUERY) for controller_id in range(1, 128))


def _find_place(message: can.Message) -> str | None:
    source, destination = message.arbitration_id >> 8, message.arbitration_id & 0xFF
    is_reply = 1 <= source <= 127 and destination == HOST and decode_reply(message.data)
    return describe_place(source) if is_reply else None


MOTEUS = DriveFamily(
    name="moteus",
    title="mjbots moteus",
    needs_fd=True,
    settings=MoteusSettings,
    emulated=EmulatedMoteusMotor,
    examples=({"id": 1}, {"id": 2}),
    build=lambda settings, period_s, speed_max: MoteusDrive(settings),
    build_stop=build_stop,
    emulate=EmulatedMoteusDrive,
    describe=_describe,
    list_questions=_list_questions,
    find_place=_find_place,
    advice=Advice(
        supply="the controller's supply is on and within its limits",
        wiring="moteus needs 1 Mbit/s with 5 Mbit/s for the data, and a sample point of 0.666",
        factory="id 1",
        mode="calibrate the motor with the maker's program, which also names its fault",
        error="See that the motor turns freely and is calibrated, and that no other program"
        " commands the controller; the maker's program shows its fault.",
        current="that the controller has the torque constant of the bench file (motor.Kv), and that"
        " servo.max_current_A is not too low",
    ),
)
