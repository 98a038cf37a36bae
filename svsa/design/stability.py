"""Theorem 1, shown: is the loop stable, how wrong may the model be, what does ẇ cost?"""

from typing import NamedTuple

from svsa.design.closed_loop import ClosedLoop, connect, linearize_law
from svsa.design.iss import (
    RateGain,
    compute_floor,
    compute_formula,
    compute_rate_gain,
)
from svsa.design.loop_noise import choose_sensing
from svsa.design.robustness import StableRange, find_stable_ranges
from svsa.design.sampling import find_fastest_observer
from svsa.run.configuration import Configuration


class Stability(NamedTuple):
    """A design about rest at one σ.

    loop: in continuous time, with the true plant. ranges: see `find_stable_ranges`. gain: from
    ẇ2 to e. formula, floor: the same in closed form, and as β → ∞; None for laws other than NDOBC.
    fastest_observer: β, rad/s, see `find_fastest_observer`, with the configuration's own sensing or
    the rig's; None where any is stable, or where the law acts on no observer.
    """

    loop: ClosedLoop
    ranges: list[StableRange]
    gain: RateGain
    formula: float | None
    floor: float | None
    fastest_observer: float | None


def assess(configuration: Configuration, sigma: float) -> Stability:
    """All of it for a configuration's first lane at σ_d = `sigma`, N·m/rad; about half a second."""
    law = linearize_law(configuration, sigma)
    loop = connect(configuration, sigma, law)
    sensing = configuration.changed(effects=choose_sensing(configuration.effects))
    return Stability(
        loop=loop,
        ranges=find_stable_ranges(configuration, sigma, law),
        gain=compute_rate_gain(loop),
        formula=compute_formula(configuration, sigma),
        floor=compute_floor(configuration),
        fastest_observer=find_fastest_observer(sensing, sigma),
    )
