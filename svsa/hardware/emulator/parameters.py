"""The emulated bench as a value: the plant of Table 1, and its drives and encoders."""

from functools import cache
from pathlib import Path
from typing import Annotated, Self

from pydantic import BeforeValidator, Field, SerializeAsAny, model_validator

from svsa.actuators.lever import compute_lever_ratio_for_stiffness
from svsa.actuators.parameters import ActuatorParameters
from svsa.errors import ParameterError, Violation
from svsa.hardware.drives.emulated import EmulatedMotor, EmulatorClock
from svsa.hardware.drives.installed import get_family, read_emulated_motor
from svsa.hardware.settings import DEFAULT_DRIVE, Sign
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.inputs.toml_file import read_toml
from svsa.runs.configuration import load_prototype
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.effects.gravity import LinkGravity

HOME_STIFFNESS_NM_PER_RAD = 30.0
_MOTORS = (
    {"torque_constant_nm_per_a": 0.0396, "phase_s": 0.0003},
    {"torque_constant_nm_per_a": 0.0234, "phase_s": 0.0005},
)


class EmulatedDeflection(EmulatorClock):
    """The deflection encoder, a node of its own: counts as i32 big-endian, every ms."""

    can_id: Whole = quantity("", "Its standard identifier", ge=0, le=0x7FF, default=0x700)
    counts_per_rev: Whole = quantity("1", "Counts a turn", ge=4, le=10**8, default=8000)
    sign: Sign = quantity("", "1 where counts grow with φ = q − θ1", default=1)
    offset_counts: Whole = quantity(
        "counts", "What it counts at φ = 0", ge=-(2**30), le=2**30, default=0
    )


@cache
def _compute_home_ratio() -> float:
    K = load_prototype().actuator.rotational_stiffness_nm_per_rad
    return float(compute_lever_ratio_for_stiffness(HOME_STIFFNESS_NM_PER_RAD, K))


Motor = Annotated[SerializeAsAny[EmulatedMotor], BeforeValidator(read_emulated_motor)]


def build_motor(number: int, drive: str = DEFAULT_DRIVE) -> EmulatedMotor:
    """A motor of the prototype with a drive of this family; number: 0 or 1."""
    address = get_family(drive).examples[number]
    return read_emulated_motor({"drive": drive, **_MOTORS[number], **address})


class EmulatorParameters(Checked):
    """All parameters of the emulated bench; by default the prototype of Table 1.

    The parts speak at different moments of each ms, none of them at the loop's. Supply
    voltage is taken as ample: no back-EMF limits the current.
    """

    actuator: ActuatorParameters = Field(default_factory=lambda: load_prototype().actuator)
    lever_ratio: Number = Field(
        default_factory=_compute_home_ratio,
        description="μ at θ2 = 0; left out, that of σ = 30 N·m/rad, 1",
        json_schema_extra={"unit": "1"},
        gt=0,
        lt=1,
    )
    lever_ratio_min: Number = quantity("1", "Lower stop of μ", gt=0, lt=1, default=0.25)
    lever_ratio_max: Number = quantity("1", "Upper stop of μ", gt=0, lt=1, default=0.83)
    deflection_max_rad: Number = quantity("rad", "Stop of |φ|", gt=0, le=1.5, default=0.75)
    motor1: Motor = Field(default_factory=lambda: build_motor(0))
    motor2: Motor = Field(default_factory=lambda: build_motor(1))
    deflection: EmulatedDeflection = EmulatedDeflection(phase_s=0.0008)
    current_lag: CurrentLag | None = quantity("", "Lag of the current loops", default=CurrentLag())
    friction: Friction | None = quantity("", "Motor friction", default=Friction())
    gravity: LinkGravity | None = quantity("", "Weight of the link", default=None)
    seed: Whole = quantity("", "Seed of what is random in faults", ge=0, le=2**31, default=0)

    @model_validator(mode="after")
    def _check(self) -> Self:
        if not self.lever_ratio_min < self.lever_ratio < self.lever_ratio_max:
            bound = f"between its stops, {self.lever_ratio_min:g} and {self.lever_ratio_max:g}"
            raise ParameterError(Violation("lever_ratio", self.lever_ratio, "1", bound))
        one, two = self.motor1, self.motor2
        if (one.drive, one.place) == (two.drive, two.place):
            name = two.address_field
            bound = "another than motor1's"
            raise ParameterError(Violation(f"motor2.{name}", getattr(two, name), "", bound))
        return self


def read_emulator_parameters(path: Path | str) -> EmulatorParameters:
    """Read an emulator's file (TOML); raises `ParameterError` for every wrong value."""
    return EmulatorParameters(**read_toml(path, "rig file"))
