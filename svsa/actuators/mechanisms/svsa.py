"""SVSA: a spring on a lever whose arm the second motor changes along a spiral (the paper).

U(φ, s) = K [1/(1 − s) − 1/n + ln((1 − s)/n)], n = 1 − s cos φ, with s = μ and κ = 1/(2πγ). The loop
and the control laws use the hand-written derivatives of `svsa.actuators.spring`, which lose no
digits at small deflection and keep earlier runs bit-identical. Tests compare them with the
derivatives of this energy.
"""

import math
from pathlib import Path
from typing import Any

from svsa.actuators.mechanism import ASSUMED_SPEED, Mechanism, Published, assume_speed
from svsa.actuators.parameters import SVSA, ActuatorParameters, Limits
from svsa.inputs.toml_file import read_toml

_SECTIONS = read_toml(Path(__file__).parents[1] / "prototype.toml", "parameter file")


def _read(section: str, part: str) -> dict[str, Any]:
    return {name: entry[part] for name, entry in _SECTIONS[section].items()}


def compute_energy(phi: Any, s: Any, p: Any, m: Any) -> Any:
    """U = K [1/(1 − s) − 1/n + ln((1 − s)/n)], J."""
    n = 1 - s * m.cos(phi)
    K = p.spring_stiffness_n_per_m * p.radius_m**2
    return K * (1 / (1 - s) - 1 / n + m.log((1 - s) / n))


SVSA_MECHANISM = Mechanism(
    name=SVSA,
    title="SVSA",
    source="Guo, Sun, Ling, Pan, Xiao, Frontiers in Neurorobotics, 2019",
    parameters=ActuatorParameters,
    elastic=("spring_stiffness_n_per_m", "radius_m"),
    energy=compute_energy,
    coordinate=(0.2, 0.9),
    compute_slope=lambda p: 1.0 / (2.0 * math.pi * p.spiral_reduction),
    prototype=ActuatorParameters(**_read("actuator", "value")),
    nominal=ActuatorParameters(**_read("nominal", "value")),
    limits=Limits(**_read("limits", "value")),
    sources=_read("actuator", "source")
    | _read("limits", "source")
    | {"speed_max_rad_per_s": ASSUMED_SPEED},
    speed_max_rad_per_s=assume_speed(50.0),
    published={
        "stiffness_range_nm_per_rad": Published((1.7, 150.56), "paper, Table 1"),
        "deflection_max_rad": Published((0.75,), "paper, Table 1"),
    },
)
