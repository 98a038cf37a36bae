"""Settings of a RoboModule drive in a bench file and in an emulator's file."""

from typing import ClassVar

from svsa.hardware.bench.settings import MotorSettings
from svsa.hardware.drives.emulated import EmulatedMotor
from svsa.hardware.drives.robomodule import Address
from svsa.inputs.checked import Whole, quantity

_GROUP = "Group of the drive's CAN address"
_NUMBER = "Number of the drive's CAN address"


def describe_place(address: Address) -> str:
    """An address in words."""
    return f"group {address.group} number {address.number}"


class RoboModuleSettings(MotorSettings):
    """A motor with a RoboModule drive."""

    address_field: ClassVar[str] = "drive_number"

    drive_group: Whole = quantity("", _GROUP, ge=0, le=7, default=0)
    drive_number: Whole = quantity("", _NUMBER, ge=1, le=15)
    pwm_limit: Whole = quantity("1", "Limit of the drive's PWM", ge=0, le=5000, default=5000)

    @property
    def address(self) -> Address:
        """The address of the drive."""
        return Address(self.drive_group, self.drive_number)

    @property
    def place(self) -> str:
        """The address of the drive, in words."""
        return describe_place(self.address)


class EmulatedRoboModuleMotor(EmulatedMotor):
    """A motor with an emulated RoboModule drive."""

    address_field: ClassVar[str] = "number"

    group: Whole = quantity("", _GROUP, ge=0, le=7, default=0)
    number: Whole = quantity("", _NUMBER, ge=1, le=15)

    @property
    def address(self) -> Address:
        """The address of the drive."""
        return Address(self.group, self.number)

    @property
    def place(self) -> str:
        """The address of the drive, in words."""
        return describe_place(self.address)
