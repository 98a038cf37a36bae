"""The report of `svsa stability` on a law at one stiffness."""

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from svsa.analysis.design.attraction import (
    Cell,
    Slice,
    StartOutcome,
    build_map,
    compute_share,
    find_start_outcomes,
    order_cells,
)
from svsa.analysis.design.rate_gain import RAMPS_NM_PER_S, RampRun, simulate_ramp
from svsa.analysis.design.sampled_loop import find_fastest_observer
from svsa.analysis.design.stability import Stability, assess
from svsa.control.gains import Gains
from svsa.control.installed import get_law
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design_file import load_prototype, read_design
from svsa.simulation.plant.effects import IDEAL, RIG
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness

DELAYS = {0: IDEAL, 1: RIG, 2: RIG.changed(delay_samples=2)}


class Report(NamedTuple):
    """The report at one stiffness.

    Attributes:
        sigma: σ_d, N·m/rad.
        fastest: Stable bandwidth β, rad/s, by samples of delay (0: ideal loop).
        rigid: Outcomes of the "rigid" map on the paper's rig; empty without a map.
        deflected: Outcomes of the "deflected" map on the paper's rig; empty without a map.
    """

    sigma: float
    stability: Stability
    ramps: list[RampRun]
    fastest: dict[int, float | None]
    is_observed: bool
    rigid: dict[Cell, StartOutcome]
    deflected: dict[Cell, StartOutcome]

    def to_json(self) -> dict[str, Any]:
        """Convert to numbers named with their units; null for missing ones."""
        loop, gain = self.stability.loop, self.stability.gain
        return {
            "stiffness_nm_per_rad": self.sigma,
            "poles_rad_per_s": [[pole.real, pole.imag] for pole in loop.poles.tolist()],
            "slowest_rad_per_s": loop.slowest,
            "least_damping": loop.least_damping,
            "ranges": [vars(stable_range) for stable_range in self.stability.ranges],
            "error_deg_per_nm_per_s": {
                "linear": _finite(math.degrees(gain.ramp)),
                "l1": _finite(math.degrees(gain.l1)),
                "formula": _degrees(self.stability.formula),
                "floor": _degrees(self.stability.floor),
                "simulated": [_finite(math.degrees(ramp.gain)) for ramp in self.ramps],
            },
            "estimate_lag_s": [ramp.lag for ramp in self.ramps],
            "fastest_observer_rad_per_s": {
                f"{delay}_samples_of_delay": beta for delay, beta in self.fastest.items()
            },
            "share_that_comes_to_rest": _share(self.rigid),
            "share_with_deflection": _share(self.deflected),
        }


def build_configuration(
    law: str, pole: float | None, beta: float | None, parameters: Path | None
) -> Configuration:
    """Build a design at rest, by default the paper's.

    Raises:
        ParameterError: If the file or a value is invalid.
    """
    design = read_design(parameters) if parameters else load_prototype()
    least = design.limits.stiffness_min_nm_per_rad
    c = Configuration(
        **dict(design),
        law=get_law(law).name,
        position=ConstantPosition(),
        stiffness=ConstantStiffness(stiffness_nm_per_rad=least),
    )
    if pole is not None:
        stiffness = c.gains.stiffness_roots
        c = c.changed(gains=Gains.from_poles([-pole] * 4, stiffness))
    if beta is not None:
        c = c.changed(observer=ObserverBandwidth(bandwidth_rad_per_s=(beta, beta, beta)))
    return c


def build_report(
    configuration: Configuration,
    sigmas: Sequence[float],
    starts: int,
    report: Callable[[float], None] = lambda share: None,
) -> list[Report]:
    """Build a report for each stiffness, N·m/rad; `report` receives the share of finished maps."""
    for sigma in sigmas:
        configuration.limits.check_stiffness("stiffness", sigma, sigma)
    done, total = 0, max(1, 2 * len(sigmas) * starts**2)
    reports = []

    def fill(sigma: float, chosen: Slice) -> dict[Cell, StartOutcome]:
        nonlocal done
        outcomes: dict[Cell, StartOutcome] = {}
        on_rig, cells = configuration.changed(effects=RIG), order_cells(starts)
        for cell, outcome in find_start_outcomes(on_rig, sigma, build_map(starts, chosen), cells):
            outcomes[cell], done = outcome, done + 1
            report(done / total)
        return outcomes

    for sigma in sigmas:
        stability = assess(configuration, sigma)
        ramps = [simulate_ramp(configuration, sigma, rate) for rate in RAMPS_NM_PER_S]
        fastest = {
            delay: find_fastest_observer(configuration.changed(effects=effects), sigma)
            for delay, effects in DELAYS.items()
        }
        rigid, deflected = fill(sigma, "rigid"), fill(sigma, "deflected")
        is_observed = get_law(configuration.law).estimate == "observer"
        reports.append(Report(sigma, stability, ramps, fastest, is_observed, rigid, deflected))
    return reports


def _share(outcomes: dict[Cell, StartOutcome]) -> float | None:
    return compute_share(list(outcomes.values())) if outcomes else None


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _degrees(value: float | None) -> float | None:
    return None if value is None else math.degrees(value)
