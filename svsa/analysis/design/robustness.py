"""Ranges of parameter errors for which the closed loop about rest stays stable."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from svsa.analysis.design.closed_loop import LawDerivatives, connect, linearize_law
from svsa.runs.definition.configuration import Configuration

PARAMETERS = {
    "link_inertia_kg_m2": "M",
    "motor1_inertia_kg_m2": "B1",
    "motor2_inertia_kg_m2": "B2",
    "link_damping_nms_per_rad": "D",
    "motor1_damping_nms_per_rad": "D1",
    "motor2_damping_nms_per_rad": "D2",
    "spring_stiffness_n_per_m": "Ks",
}
MIN_RATIO, MAX_RATIO = 0.05, 20.0
_STRIDE = 1.12
_CLOSE = 1e-4


@dataclass(frozen=True)
class StableRange:
    """True over nominal value of one parameter for which the loop is Hurwitz; all others nominal.

    Attributes:
        parameter: Its name in `ActuatorParameters`.
        symbol: The paper's symbol.
        low: Lower end of the stable range; None if stable down to the least ratio.
        high: Upper end of the stable range; None if stable up to the greatest ratio.
        present: The ratio in the configuration.
    """

    parameter: str
    symbol: str
    low: float | None
    high: float | None
    present: float


def find_stable_ranges(
    configuration: Configuration, sigma: float, law: LawDerivatives | None = None
) -> list[StableRange]:
    """Find for each parameter the range in which the loop about rest at σ_d = `sigma`, N·m/rad, is
    Hurwitz.

    `law` is the linearized law, if it is already known. Empty if the nominal loop itself is
    unstable.
    """
    c, nominal = configuration, configuration.nominal
    derivatives = law or linearize_law(c, sigma)

    def is_stable(name: str, ratio: float) -> bool:
        actuator = nominal.model_copy(update={name: ratio * getattr(nominal, name)})
        return connect(c, sigma, derivatives, actuator).is_hurwitz

    if not connect(c, sigma, derivatives, nominal).is_hurwitz:
        return []
    return [
        StableRange(
            name,
            symbol,
            find_end(partial(is_stable, name), MIN_RATIO),
            find_end(partial(is_stable, name), MAX_RATIO),
            getattr(c.actuator, name) / getattr(nominal, name),
        )
        for name, symbol in PARAMETERS.items()
        if getattr(nominal, name) > 0.0
    ]


def find_end(is_stable: Callable[[float], bool], end: float) -> float | None:
    """Find the factor from 1 towards `end` up to which the loop is stable; None if at all."""
    step = _STRIDE if end > 1.0 else 1.0 / _STRIDE
    inside = outside = 1.0
    while is_stable(outside):
        inside = outside
        if inside == end:
            return None
        outside = min(inside * step, end) if end > 1.0 else max(inside * step, end)
    while abs(outside - inside) > _CLOSE * inside:
        middle = 0.5 * (inside + outside)
        if is_stable(middle):
            inside = middle
        else:
            outside = middle
    return inside
