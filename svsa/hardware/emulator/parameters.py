"""The emulated bench as a value: the true plant of an actuator, its drives and encoders."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import BeforeValidator, Field, SerializeAsAny, model_validator

from svsa.actuators.domain import build_domain
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import compute_coordinate_for_stiffness, compute_torques
from svsa.actuators.installed import InstalledActuator, find_mechanism, get_mechanism
from svsa.actuators.mechanism import Mechanism
from svsa.actuators.parameters import SVSA, MechanismParameters
from svsa.errors import ParameterError, Violation
from svsa.hardware.bench.settings import DEFAULT_DRIVE, Sign
from svsa.hardware.drives.emulated import EmulatedMotor, EmulatorClock
from svsa.hardware.drives.installed import get_family, read_emulated_motor
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.inputs.toml_file import read_toml
from svsa.runs.definition.design_file import load_prototype
from svsa.runs.definition.experiment import choose_stiffness
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.effects.gravity import LinkGravity

HOME_STIFFNESS_NM_PER_RAD = 30.0
"""Of the SVSA; another actuator is at its default stiffness."""
STOP_MARGIN = 0.02
"""Distance of the stops of s from the ends of the domain, as a share of its range."""
GEAR_RATIOS = (50.0, 100.0, 200.0)
HOLDING, HOLDING_RAD_PER_S = 2.0, 0.01
"""Breakaway torque over the preload of the springs, and the Stribeck velocity then."""
RE50_NM_PER_A, RE25_NM_PER_A = 0.0396, 0.0234
LARGEST_CURRENT_A = 12.0
_PHASES_S = (0.0003, 0.0005)


class EmulatedDeflection(EmulatorClock):
    """The deflection encoder, a separate node: counts as i32 big-endian, every ms."""

    can_id: Whole = quantity("", "Standard CAN identifier", ge=0, le=0x7FF, default=0x700)
    counts_per_rev: Whole = quantity("1", "Counts per revolution", ge=4, le=10**8, default=8000)
    sign: Sign = quantity("", "1 if counts increase with φ = q − θ1, otherwise −1", default=1)
    offset_counts: Whole = quantity("counts", "Counts at φ = 0", ge=-(2**30), le=2**30, default=0)


Given = Mapping[str, Any]
"""The fields of `EmulatorParameters` that are known already."""


def _choose_home(fields: Given) -> float:
    """The stiffness coordinate at θ2 = 0."""
    actuator: MechanismParameters = fields["actuator"]
    mechanism = find_mechanism(actuator)
    is_svsa = mechanism.name == SVSA
    sigma = HOME_STIFFNESS_NM_PER_RAD if is_svsa else choose_stiffness(mechanism)
    return float(compute_coordinate_for_stiffness(build_actuator(actuator, 0.0), sigma))


def _choose_stops(fields: Given) -> tuple[float, float]:
    """Lower and upper stop of s: outside the domain, and where the energy is described."""
    mechanism = find_mechanism(fields["actuator"])
    if mechanism.name == SVSA:
        return 0.25, 0.83
    domain = build_domain(fields["actuator"], mechanism.limits)
    margin = STOP_MARGIN * (domain.mu_max - domain.mu_min)
    low, high = mechanism.coordinate
    return max(low, domain.mu_min - margin), min(high, domain.mu_max + margin)


Motor = Annotated[SerializeAsAny[EmulatedMotor], BeforeValidator(read_emulated_motor)]


def build_motor(
    number: int, drive: str = DEFAULT_DRIVE, actuator: MechanismParameters | None = None
) -> EmulatedMotor:
    """Build a motor with a drive of this family.

    Args:
        number: 0 or 1.
        drive: Family of the drive.
        actuator: Whose torque limit it makes. The SVSA has an RE50 and an RE25, as the paper's;
            for another actuator both are RE50, behind the smallest gearbox that is enough.
    """
    mechanism = get_mechanism(SVSA) if actuator is None else find_mechanism(actuator)
    constant, ratio = RE25_NM_PER_A if number else RE50_NM_PER_A, GEAR_RATIOS[0]
    if mechanism.name != SVSA:
        constant, ratio = RE50_NM_PER_A, _choose_gear(mechanism)
    return read_emulated_motor(
        {
            "drive": drive,
            "torque_constant_nm_per_a": constant,
            "gear_ratio": ratio,
            "phase_s": _PHASES_S[number],
            **get_family(drive).examples[number],
        }
    )


def _choose_gear(mechanism: Mechanism) -> float:
    torque = max(mechanism.limits.torque1_nm, mechanism.limits.torque2_nm)
    per_ratio = (
        RE50_NM_PER_A * LARGEST_CURRENT_A * float(EmulatedMotor.model_fields["efficiency"].default)
    )
    return next((ratio for ratio in GEAR_RATIOS if ratio * per_ratio >= torque), GEAR_RATIOS[-1])


def _choose_friction(fields: Given) -> Friction:
    """Friction in proportion to the torque limits, and enough to hold the preload at home.

    Springs that are tensioned at φ = 0 turn the stiffness motor, which has no current before a run
    and must stay at its zero mark.
    """
    friction, of_svsa = Friction(), get_mechanism(SVSA).limits
    actuator: MechanismParameters = fields["actuator"]
    limits, s = find_mechanism(actuator).limits, fields["lever_ratio"]
    preload = abs(compute_torques(build_actuator(actuator, s), s, 0.0).reaction)
    scaled = friction.coulomb2_nm * limits.torque2_nm / of_svsa.torque2_nm
    held = HOLDING * preload / friction.static_ratio
    return friction.changed(
        coulomb1_nm=friction.coulomb1_nm * limits.torque1_nm / of_svsa.torque1_nm,
        coulomb2_nm=max(scaled, held),
        stribeck_rad_per_s=HOLDING_RAD_PER_S if held > scaled else friction.stribeck_rad_per_s,
    )


class EmulatorParameters(Checked):
    """All parameters of the emulated bench; by default those of the actuator's prototype.

    The actuator is by default the SVSA of Table 1. The nodes send at different times of each ms,
    none synchronous with the loop. The supply voltage is assumed to be sufficient: no back-EMF
    limits the current.
    """

    actuator: InstalledActuator = Field(default_factory=lambda: load_prototype().actuator)
    lever_ratio: Number = Field(
        default_factory=_choose_home,
        description="Stiffness coordinate s (of the SVSA μ) where θ2 = 0; default: the s of 30"
        " N·m/rad, of another actuator the s of its default stiffness",
        json_schema_extra={"unit": "1"},
    )
    lever_ratio_min: Number = Field(
        default_factory=lambda fields: _choose_stops(fields)[0],
        description="Lower stop of s (of the SVSA of μ)",
        json_schema_extra={"unit": "1"},
    )
    lever_ratio_max: Number = Field(
        default_factory=lambda fields: _choose_stops(fields)[1],
        description="Upper stop of s (of the SVSA of μ)",
        json_schema_extra={"unit": "1"},
    )
    deflection_max_rad: Number = Field(
        default_factory=lambda fields: find_mechanism(fields["actuator"]).limits.deflection_max_rad,
        description="Stop of |φ|",
        json_schema_extra={"unit": "rad"},
        gt=0,
        le=1.5,
    )
    motor1: Motor = Field(
        default_factory=lambda fields: build_motor(0, actuator=fields["actuator"])
    )
    motor2: Motor = Field(
        default_factory=lambda fields: build_motor(1, actuator=fields["actuator"])
    )
    deflection: EmulatedDeflection = EmulatedDeflection(phase_s=0.0008)
    current_lag: CurrentLag | None = quantity("", "Lag of the current loops", default=CurrentLag())
    friction: Friction | None = Field(
        default_factory=_choose_friction,
        description="Motor friction; default: a gearbox that suits the torque limits",
        json_schema_extra={"unit": ""},
    )
    gravity: LinkGravity | None = quantity("", "Weight of the link", default=None)
    seed: Whole = quantity("", "Seed of the random numbers of faults", ge=0, le=2**31, default=0)

    @model_validator(mode="after")
    def _check(self) -> Self:
        if not self.lever_ratio_min < self.lever_ratio < self.lever_ratio_max:
            bound = f"between its stops, {self.lever_ratio_min:g} and {self.lever_ratio_max:g}"
            raise ParameterError(Violation("lever_ratio", self.lever_ratio, "1", bound))
        mechanism = find_mechanism(self.actuator)
        if not mechanism.has_stiffness_motor:
            bound = "an actuator with two motors: a bench has two drives"
            raise ParameterError(Violation("actuator.mechanism", mechanism.name, "", bound))
        motor1, motor2 = self.motor1, self.motor2
        if (motor1.drive, motor1.place) == (motor2.drive, motor2.place):
            name = motor2.address_field
            bound = "different from motor1's"
            raise ParameterError(Violation(f"motor2.{name}", getattr(motor2, name), "", bound))
        return self


def build_emulator_parameters(actuator: str) -> EmulatorParameters:
    """Build the emulated bench of an installed actuator; raises `ParameterError` for another."""
    prototype: Any = get_mechanism(actuator).prototype
    return EmulatorParameters(actuator=prototype)


def read_emulator_parameters(path: Path | str) -> EmulatorParameters:
    """Read an emulator's file (TOML).

    Raises:
        ParameterError: If a value is invalid.
    """
    return EmulatorParameters(**read_toml(path, "rig file"))
