"""The description of an actuator: parameters, energy U(φ, s) and transmission s = s0 + κ θ2.

    M q̈ + D q̇ + τ_e = τ_ext        τ_e = ∂U/∂φ, φ = q − θ1
    B1 θ̈1 + D1 θ̇1 − τ_e = u1        σ   = ∂²U/∂φ²
    B2 θ̈2 + D2 θ̇2 + τ_r = u2        τ_r = κ ∂U/∂s

The paper's SVSA belongs to this class, with s = μ and κ = 1/(2πγ). Loop, control laws and observers
use the functions that `svsa.actuators.energy` derives from U.
"""

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from svsa.actuators.drawing import Part
from svsa.actuators.parameters import Limits, MechanismParameters
from svsa.errors import ParameterError, Violation

NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")
MAX_ELASTIC = 6
"""Maximum number of parameters of an energy."""


class Published(NamedTuple):
    """A figure of an actuator from a publication: one number, or both ends of a range."""

    values: tuple[float, ...]
    source: str


@dataclass(frozen=True, eq=False)
class Mechanism:
    """An actuator, as described by one file.

    Attributes:
        name: Name of the entry point and in records.
        title: Name for users.
        source: Publication of the mechanism.
        parameters: Class of its parameters; a field `mechanism` holds the name.
        elastic: Fields of the parameters that the energy depends on, at most `MAX_ELASTIC`.
        energy: U in J, a function (φ, s, p, m) of symbols: p has the fields `elastic`, m is sympy.
            Smooth, with a torque ∂U/∂φ of zero at φ = 0.
        coordinate: Lower and upper end of s, between which σ(0, s) is positive and monotonic.
        compute_slope: κ = ds/dθ2 from the parameters, 1/rad (or m/rad if s is a length).
        prototype: Parameters of the true plant.
        nominal: Parameters of the model that the control laws receive.
        limits: Torque limits, stiffness range and deflection limit.
        sources: Source of each field of `prototype` and `limits`, or "assumed: …".
        antagonistic: Whether two real motors a and b pull against each other, θ1 = (θa + θb)/2 and
            θ2 = (θa − θb)/2. Then u1 = ua + ub, u2 = ua − ub, and the torque limits apply to ua and
            ub.
        poles_rad_per_s: Default closed-loop poles of position and stiffness: all real, each
            polynomial with one multiple pole. They suit encoders, a delay of one sample and the
            torque limits.
        observer_rad_per_s: Default bandwidth β of all channels of the disturbance observer.
        draw: Parts of its schematic, a function (parameters, s, φ); the same kinds in the same
            order for all s and φ. None: a torsion spring is drawn.
        published: Published figures by the field of the datasheet that measures the same quantity.
        speed_max_rad_per_s: Speed limit of motor 1, or of each of two motors that pull against each
            other, with its source among `sources`; None if it is not known. The plant has no such
            limit; the datasheet uses it.
        has_stiffness_motor: False for the limit case of a linear spring U(φ) = ½ k φ² with constant
            stiffness: the stiffness reference is always k, and motor 2 is a body without torques.
    """

    name: str
    title: str
    source: str
    parameters: type[MechanismParameters]
    elastic: tuple[str, ...]
    energy: Callable[[Any, Any, Any, Any], Any]
    coordinate: tuple[float, float]
    compute_slope: Callable[[Any], float]
    prototype: MechanismParameters
    nominal: MechanismParameters
    limits: Limits
    sources: Mapping[str, str]
    antagonistic: bool = False
    draw: Callable[[Any, float, float], tuple[Part, ...]] | None = None
    has_stiffness_motor: bool = True
    poles_rad_per_s: tuple[float, float] = (60.0, 40.0)
    observer_rad_per_s: float = 60.0
    published: Mapping[str, Published] = field(default_factory=dict)
    speed_max_rad_per_s: float | None = None

    def __post_init__(self) -> None:
        if not NAME.fullmatch(self.name):
            bound = "a lowercase letter, then up to 39 lowercase letters, digits or _"
            raise ParameterError(Violation("name", self.name, "", bound))
        if not 1 <= len(self.elastic) <= MAX_ELASTIC:
            bound = f"1 to {MAX_ELASTIC} names of parameters"
            raise ParameterError(Violation("elastic", list(self.elastic), "", bound))
        unknown = [name for name in self.elastic if name not in self.parameters.model_fields]
        if unknown:
            bound = f"names of parameters; there is none of the name {', '.join(unknown)}"
            raise ParameterError(Violation("elastic", list(self.elastic), "", bound))
        low, high = self.coordinate
        if not -math.inf < low < high < math.inf:
            bound = "two finite numbers, the lower end of s first"
            raise ParameterError(Violation("coordinate", self.coordinate, "", bound))
        fields = {*self.parameters.model_fields, *Limits.model_fields} - {"mechanism"}
        if self.speed_max_rad_per_s is not None:
            fields.add("speed_max_rad_per_s")
        missing = sorted(fields - {*self.sources})
        if missing:
            bound = f"a source of each value; missing: {', '.join(missing)}"
            raise ParameterError(Violation("sources", sorted(self.sources), "", bound))

    @property
    def largest_torque_nm(self) -> float:
        """Limit of u1, N·m; two motors that pull against each other add theirs: u1 = ua + ub."""
        return self.limits.torque1_nm * (2.0 if self.antagonistic else 1.0)

    def list_elastic(self, parameters: MechanismParameters) -> list[float]:
        """List the values of the parameters that the energy depends on."""
        return [float(getattr(parameters, name)) for name in self.elastic]


def perturb(
    parameters: MechanismParameters, inertia: tuple[float, float, float], damping: float
) -> Any:
    """Perturb the parameters of a nominal model as the paper does.

    Args:
        parameters: Parameters of the true plant.
        inertia: Factors of M, B1 and B2.
        damping: Damping that is added to D, D1 and D2, N·m·s/rad.

    Returns:
        Parameters of the same class.
    """
    p = parameters
    return p.changed(
        link_inertia_kg_m2=p.link_inertia_kg_m2 * inertia[0],
        motor1_inertia_kg_m2=p.motor1_inertia_kg_m2 * inertia[1],
        motor2_inertia_kg_m2=p.motor2_inertia_kg_m2 * inertia[2],
        link_damping_nms_per_rad=p.link_damping_nms_per_rad + damping,
        motor1_damping_nms_per_rad=p.motor1_damping_nms_per_rad + damping,
        motor2_damping_nms_per_rad=p.motor2_damping_nms_per_rad + damping,
    )


def assume_speed(gear_ratio: float) -> float:
    """Return the speed of `ASSUMED_SPEED`, rad/s, for a motor without a published one."""
    return float(f"{5950.0 * math.pi / 30.0 / gear_ratio:.3g}")


ASSUMED_SPEED = (
    "assumed: 5950 rpm, a Maxon RE 50 of 24 V without load, behind the gear of the emulated bench"
)
PAPERS_INERTIA = (1.49, 1.21, 1.36)
PAPERS_DAMPING_NMS_PER_RAD = 0.002
"""Rounded difference between the dampings of the paper's nominal model and its plant."""
