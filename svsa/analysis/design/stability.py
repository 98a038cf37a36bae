"""Theorem 1 numerically: stability, tolerated model error, and the effect of ẇ."""

import math
from typing import NamedTuple

import numpy as np

from svsa.analysis.design.closed_loop import ClosedLoop, connect, linearize_law
from svsa.analysis.design.loop_noise import choose_sensing
from svsa.analysis.design.rate_gain import (
    RateGain,
    compute_floor,
    compute_formula,
    compute_rate_gain,
)
from svsa.analysis.design.robustness import StableRange, find_stable_ranges
from svsa.analysis.design.sampled_loop import find_fastest_observer, linearize_tick
from svsa.control.installed import get_title
from svsa.errors import ParameterError, Violation
from svsa.runs.definition.configuration import Configuration
from svsa.simulation.plant.effects import IDEAL

_SHORT_S = 1e-4
_SLOW_RAD_PER_S = 120.0
_MIN_RADIUS = 0.5
_STANDING_RAD_PER_S = 1e-2
_CLOSE = 0.05


class Stability(NamedTuple):
    """Stability results of a design about rest at one σ.

    Attributes:
        loop: The loop in continuous time, with the true plant.
        ranges: See `find_stable_ranges`.
        gain: From ẇ2 to e.
        formula: The same in closed form; None for laws other than NDOBC.
        floor: The closed form for β → ∞; None for laws other than NDOBC.
        fastest_observer: β, rad/s, see `find_fastest_observer`, with the sensing of the
            configuration or of the rig; None if any bandwidth is stable, or the law uses no
            observer.
    """

    loop: ClosedLoop
    ranges: list[StableRange]
    gain: RateGain
    formula: float | None
    floor: float | None
    fastest_observer: float | None


def assess(configuration: Configuration, sigma: float) -> Stability:
    """Compute the stability of a configuration's first lane, in about 0.5 s.

    Args:
        configuration: The run; its first lane, plant, nominal model and effects are used.
        sigma: Stiffness σ_d, N·m/rad.

    Returns:
        The closed loop, stable parameter ranges, the gain from ẇ, and the margins.

    Raises:
        ParameterError: If continuous time does not describe the law: it switches, or its memory
            contains more than its integral and filters.
    """
    law = linearize_law(configuration, sigma)
    loop = connect(configuration, sigma, law)
    if len(law.rate):
        _check_continuous(configuration, sigma, loop)
    sensing = configuration.changed(effects=choose_sensing(configuration.effects))
    return Stability(
        loop=loop,
        ranges=find_stable_ranges(configuration, sigma, law),
        gain=compute_rate_gain(loop),
        formula=compute_formula(configuration, sigma),
        floor=compute_floor(configuration),
        fastest_observer=find_fastest_observer(sensing, sigma),
    )


def _check_continuous(configuration: Configuration, sigma: float, loop: ClosedLoop) -> None:
    """Check against the loop itself at a short period: slow poles s = ln z / T, and e at rest."""
    c = configuration
    short = c.changed(effects=IDEAL, sampling=c.sampling.changed(period_s=_SHORT_S))
    sampled = linearize_tick(short, sigma)
    z = np.linalg.eigvals(sampled.A).astype(complex)
    poles = np.log(z[np.abs(z) > _MIN_RADIUS]) / _SHORT_S
    slow = loop.poles[np.abs(loop.poles) < _SLOW_RAD_PER_S]
    is_found = all(np.min(np.abs(poles - s)) < _CLOSE * max(1.0, abs(s)) for s in slow)
    is_moving = min(np.min(np.abs(poles)), np.min(np.abs(loop.poles))) > _STANDING_RAD_PER_S
    if is_found and is_moving:
        slowest = float(np.max(poles.real))
        still = np.linalg.solve(np.eye(len(sampled.A)) - sampled.A, sampled.W[:, 0])[0]
        state = np.linalg.solve(loop.A, loop.B[:, 0])
        is_same_error = math.isclose(still, float(loop.C[0] @ state), rel_tol=_CLOSE, abs_tol=1e-5)
        if is_same_error and math.isclose(slowest, loop.slowest, rel_tol=_CLOSE, abs_tol=_CLOSE):
            return
    bound = "a law whose continuous model has the poles and steady state of its sampled loop"
    raise ParameterError(Violation("law", get_title(c.law), "", bound))
