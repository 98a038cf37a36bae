"""Conversion of a lane's configuration to constants of the compiled loop."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

from svsa.actuators.domain import build_domain
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import compute_coordinate_for_stiffness
from svsa.control.call import BoundLaw
from svsa.control.installed import get_law
from svsa.control.law import Setting
from svsa.control.observers.disturbance import compute_shares
from svsa.numerics.exponential import exp
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Lane
from svsa.simulation.loop.lane import Blocks
from svsa.simulation.plant.effects import build_effect_constants
from svsa.simulation.reference.kinds import compute_start_value

Bind: TypeAlias = Callable[[Configuration, Lane, Blocks], BoundLaw]
"""Binds the law of one lane among its blocks, as `bind_law` does."""


class Connection(NamedTuple):
    """The constants of the loop for one lane, and their sources.

    Attributes:
        parts: Settings that `build_blocks` reads.
        control: Name of the law, its parameters, `Setting`.
        blocks: `Blocks` of the lane.
        law: The bound law.
    """

    parts: tuple[Any, ...]
    control: tuple[Any, ...]
    blocks: Blocks
    law: BoundLaw


def build_blocks(configuration: Configuration, lane: Lane, mu0: float, steps: int = 1) -> Blocks:
    """Build the blocks of one lane.

    Args:
        configuration: The run.
        lane: The lane.
        mu0: Lever ratio at θ2 = 0, 1.
        steps: Runge–Kutta steps per period.

    Returns:
        `Blocks`.
    """
    c = configuration
    limited = c.effects.torque_limits
    estimation = c.effects.estimation
    return Blocks(
        plant=build_actuator(c.actuator, mu0),
        nominal=build_actuator(c.nominal, mu0),
        shares=compute_shares(lane.observer or c.observer, c.sampling.period_s),
        torque1_max=c.limits.torque1_nm if limited else math.inf,
        torque2_max=c.limits.torque2_nm if limited else math.inf,
        effects=build_effect_constants(c.effects, c.seed, c.actuator, c.sampling.period_s),
        decay=exp(-estimation.corner_rad_per_s * c.sampling.period_s) if estimation else 0.0,
        domain=build_domain(c.actuator, c.limits),
        period=c.sampling.period_s,
        steps=steps,
        spring=c.spring.build(c.sampling.period_s),
    )


def bind_law(configuration: Configuration, lane: Lane, blocks: Blocks) -> BoundLaw:
    """Bind the law of one lane; compiles it if necessary."""
    return get_law(lane.law).bind(configuration.get_parameters(lane), build_setting(blocks))


def build_constants(configuration: Configuration, lane: Lane, blocks: Blocks) -> tuple[Any, ...]:
    """The constants of one lane's law among its blocks."""
    return get_law(lane.law).build(configuration.get_parameters(lane), build_setting(blocks))


def connect_lane(
    before: Connection | None,
    configuration: Configuration,
    mu0: float,
    lane: Lane,
    steps: int,
    bind: Bind,
) -> Connection:
    """Build the blocks of one lane and bind its law, as far as either has changed.

    Args:
        before: Previous connection of the lane; None for a new lane.
        configuration: The new configuration of its joint.
        mu0: Lever ratio at θ2 = 0, 1.
        lane: One of its lanes.
        steps: Runge–Kutta steps per period.
        bind: Binds the law.

    Returns:
        Blocks and law; those of `before` if their sources are unchanged.

    Raises:
        LawError: If the code of the law fails.
    """
    c = configuration
    observer = lane.observer or c.observer
    parts = (
        c.actuator, c.nominal, observer, c.effects, c.limits, c.sampling, c.seed, mu0, steps,
        c.spring,
    )  # fmt: skip
    if before is not None and before.parts == parts:
        blocks = before.blocks
    else:
        blocks = build_blocks(c, lane, mu0, steps)
    control = lane.law, c.find_parameters(lane), build_setting(blocks)
    is_bound = before is not None and before.control == control
    law = before.law if before is not None and is_bound else bind(c, lane, blocks)
    return Connection(parts, control, blocks, law)


def build_setting(blocks: Blocks) -> Setting:
    """Build the setting of a law from these blocks."""
    b = blocks
    return Setting(b.nominal, b.domain, b.torque1_max, b.torque2_max, b.period)


def compute_start_ratio(configuration: Configuration) -> float:
    """Compute s0 (μ0 of the SVSA) of a run from rest: σ(0) = σ_d(0) at θ2 = 0."""
    actuator, sigma = configuration.actuator, compute_start_value(configuration.stiffness)
    return compute_coordinate_for_stiffness(build_actuator(actuator, 0.0), sigma)
