"""Settings of a moteus controller in a bench file and in an emulator's file."""

from typing import ClassVar

from svsa.hardware.bench.settings import MotorSettings
from svsa.hardware.drives.emulated import EmulatedMotor
from svsa.inputs.checked import Number, Whole, quantity

COUNTS_PER_REV = 100_000
_ID = "Identifier of the controller (id.id)"


def describe_place(controller_id: int) -> str:
    """An identifier in words."""
    return f"id {controller_id}"


class MoteusSettings(MotorSettings):
    """A motor with a moteus controller, whose `motor_position.rotor_to_output_ratio` is 1."""

    address_field: ClassVar[str] = "id"

    id: Whole = quantity("", _ID, ge=1, le=127)
    watchdog_s: Number = quantity(
        "s",
        "Time without a command after which the controller times out",
        ge=0.02,
        le=1,
        default=0.1,
    )
    counts_per_rev: Whole | None = quantity(
        "1",
        "Counts per motor revolution: the controller reports 1/100 000 of one",
        ge=COUNTS_PER_REV,
        le=COUNTS_PER_REV,
        default=COUNTS_PER_REV,
    )
    torque_constant_nm_per_a: Number | None = quantity(
        "N·m/A", "K_t of the winding as set in the controller, which receives a torque", gt=0, le=10
    )

    @property
    def place(self) -> str:
        """The identifier of the controller, in words."""
        return describe_place(self.id)


class EmulatedMoteusMotor(EmulatedMotor):
    """A motor with an emulated moteus controller."""

    address_field: ClassVar[str] = "id"

    id: Whole = quantity("", _ID, ge=1, le=127)
    counts_per_rev: Whole = quantity(
        "1",
        "Counts per motor revolution",
        ge=COUNTS_PER_REV,
        le=COUNTS_PER_REV,
        default=COUNTS_PER_REV,
    )

    @property
    def place(self) -> str:
        """The identifier of the controller, in words."""
        return describe_place(self.id)
