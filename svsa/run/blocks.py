"""A lane of a configuration as constants of the compiled loop."""

import math

from svsa.control.call import BoundLaw
from svsa.control.installed import get_law
from svsa.control.law import Setting
from svsa.loop.lane import Blocks
from svsa.model.domain import build_domain
from svsa.model.dynamics import build_actuator
from svsa.model.exponential import exp
from svsa.observer.disturbance import compute_shares
from svsa.plant.effects import build_bench
from svsa.run.configuration import Configuration, Lane


def build_blocks(configuration: Configuration, lane: Lane, mu0: float, steps: int = 1) -> Blocks:
    """The blocks of one lane. mu0: lever ratio at θ2 = 0. steps: RK4 steps a period."""
    c = configuration
    limited = c.effects.torque_limits
    estimation = c.effects.estimation
    return Blocks(
        plant=build_actuator(c.actuator, mu0),
        nominal=build_actuator(c.nominal, mu0),
        shares=compute_shares(lane.observer or c.observer, c.sampling.period_s),
        torque1_max=c.limits.torque1_nm if limited else math.inf,
        torque2_max=c.limits.torque2_nm if limited else math.inf,
        bench=build_bench(c.effects, c.seed, c.actuator, c.sampling.period_s),
        decay=exp(-estimation.corner_rad_per_s * c.sampling.period_s) if estimation else 0.0,
        domain=build_domain(c.actuator, c.limits),
        period=c.sampling.period_s,
        steps=steps,
    )


def bind_law(configuration: Configuration, lane: Lane, blocks: Blocks) -> BoundLaw:
    """The law of one lane among its blocks; compiled where it has not been before."""
    b = blocks
    setting = Setting(b.nominal, b.domain, b.torque1_max, b.torque2_max, b.period)
    return get_law(lane.law).bind(configuration.get_parameters(lane), setting)
