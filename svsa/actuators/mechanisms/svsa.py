"""SVSA: a spring on a lever whose arm the second motor changes along a spiral (the paper).

U(φ, s) = K [1/(1 − s) − 1/n + ln((1 − s)/n)], n = 1 − s cos φ, with s = μ and κ = 1/(2πγ). The loop
and the control laws use the hand-written derivatives of `svsa.actuators.spring`: they keep every
digit at small deflection, and earlier runs their bits. Those of this energy test them.
"""

import math
from pathlib import Path
from typing import Any

from svsa.actuators.mechanism import Mechanism
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
    sources=_read("actuator", "source") | _read("limits", "source"),
)
