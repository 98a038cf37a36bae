"""The sections of a bench file that describe the bus, a motor with its drive, and an encoder."""

from typing import Any, ClassVar, Literal

from svsa.inputs.checked import Checked, Flag, Number, Whole, quantity

AXIS_WORDS = {
    "link": "the link",
    "motor1": "motor 1",
    "motor2": "motor 2",
    "deflection": "the deflection",
}
"""Name of each axis in messages."""
DEFAULT_DRIVE = "robomodule"
"""The family of drives of a bench file without a family: earlier versions had one."""
Sign = Literal[-1, 1]


class BusSettings(Checked):
    """Arguments for python-can; `options` goes to `can.Bus` unchanged."""

    interface: str = quantity("", "Interface of python-can: socketcan, slcan, pcan, socketcand …")
    channel: str = quantity("", "Channel of that interface, such as can0 or /dev/ttyACM0")
    bitrate: Whole = quantity("bit/s", "Bit rate", ge=10_000, le=1_000_000, default=1_000_000)
    fd: Flag = quantity("", "CAN FD: frames of up to 64 bytes", default=False)
    data_bitrate: Whole = quantity(
        "bit/s",
        "Bit rate of the data of a CAN FD frame",
        ge=10_000,
        le=8_000_000,
        default=5_000_000,
    )
    options: dict[str, Any] = quantity("", "Further arguments of can.Bus", default={})
    timestamps: Literal["bus", "arrival"] = quantity(
        "",
        "Source of a frame's time: bus (the adapter) or arrival (when it was read)",
        default="bus",
    )


class MotorSettings(Checked):
    """A motor and its drive. Torque is at the gearbox output; None: not known yet.

    The family of the drive adds its own fields: its address and its configuration.
    """

    address_field: ClassVar[str] = ""
    """The field that distinguishes two drives of the family on one bus."""

    drive: str = quantity("", "Family of the drive", default=DEFAULT_DRIVE)
    counts_per_rev: Whole | None = quantity(
        "1", "Counts per motor revolution, after quadrature", ge=4, le=10**7, default=None
    )
    gear_ratio: Number | None = quantity(
        "1", "Gear ratio N of N : 1", gt=0, le=10_000, default=None
    )
    torque_constant_nm_per_a: Number | None = quantity(
        "N·m/A", "K_t of the winding", gt=0, le=10, default=None
    )
    efficiency: Number | None = quantity("1", "η of the gearbox", gt=0, le=1, default=None)
    sign: Sign | None = quantity(
        "", "1 if a positive current increases the angle of the model, otherwise −1", default=None
    )
    nominal_current_a: Number = quantity("A", "Continuous current", gt=0, le=32)
    peak_current_a: Number = quantity("A", "Maximum current", gt=0, le=32)
    thermal_time_s: Number = quantity("s", "Thermal time constant of the winding", gt=0, le=3600)
    speed_max_rad_per_s: Number = quantity("rad/s", "Maximum speed at the output", gt=0, le=1000)
    position_min_rad: Number = quantity("rad", "Minimum angle at the output", ge=-100, le=100)
    position_max_rad: Number = quantity("rad", "Maximum angle at the output", ge=-100, le=100)

    @property
    def place(self) -> str:
        """The address of the drive, for display."""
        return ""


class DeflectionSettings(Checked):
    """The deflection encoder; `options` are the settings of its source."""

    source: Literal["can", "serial", "nidaqmx", "replay"] = quantity("", "Source of the counts")
    counts_per_rev: Whole | None = quantity(
        "1", "Counts per revolution, after quadrature", ge=4, le=10**8, default=None
    )
    sign: Sign | None = quantity(
        "",
        "1 if counts increase with φ = q − θ1 (two antagonistic motors: with q), otherwise −1",
        default=None,
    )
    options: dict[str, Any] = quantity("", "Settings of the source", default={})
