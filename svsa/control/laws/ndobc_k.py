"""NDOBC with the estimated spring: the nominal K follows K̂ (NDOBC-K).

NDOBC rejects what a wrong spring does to the position, but not to the stiffness: σ = ∂τ_e/∂φ is
computed from the nominal K, so that a spring that is 30 % softer holds a stiffness that is 30 % too
low. Here law and observer use κ K_n with κ from the spring estimator (`control.observers.spring`):

    κ' = sat(κ̂ − κ, rate)   while  s.d.(κ̂) ≤ limit · κ̂,   κ in [least, greatest] and in the domain

Before the first load κ̂ is not known and κ = 1: the law is NDOBC. While κ is constant, the proofs
of the paper hold with another nominal model. While it changes, the model of the observer changes by
κ' τ_n per second, which it estimates as a disturbance: with β = 60 rad/s and κ' = 0.5/s its error
is κ' τ_n/β, below 1 % of τ_n. A wrong torque scale c moves κ to κ/c, and the stiffness by that
factor; a frozen sensor or another shape of the spring is a misfit, or leaves the interval wide, and
κ stays.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.actuators.elasticity import compute_stiffness_of, find_spring_scale, scale_spring
from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.control.gains import Gains
from svsa.control.law import Law, Setting
from svsa.control.laws.feedback_linearization import GainConstants, build_gains
from svsa.control.laws.ndobc import compute_ndobc
from svsa.control.observers.disturbance import compute_share
from svsa.control.observers.own import Observed, observe_disturbance
from svsa.control.observers.spring import (
    Spring,
    SpringConstants,
    SpringEstimation,
    read_spring,
    update_spring,
)
from svsa.control.parameters import LawParameters
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled

MARGIN = 0.02
"""Share of the stiffness range that κ leaves free at both ends."""


class AdaptiveSpring(LawParameters):
    """Poles, bandwidth, and how κ follows its estimate."""

    position_pole_rad_per_s: Number = quantity(
        "rad/s", "p of (s + p)⁴ of the position", symbol="p", ge=5, le=150, default=60.0
    )
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s", "p_σ of (s + p_σ)² of the stiffness", symbol="p_σ", ge=5, le=150, default=60.0
    )
    observer_rad_per_s: Number = quantity(
        "rad/s", "β of its observer", symbol="β", ge=1, le=500, default=60.0
    )
    deviation_limit: Number = quantity(
        "1", "Relative deviation of κ̂ up to which κ follows it", symbol="Deviation limit",
        gt=0, le=0.3, default=0.03, searched=False,
    )  # fmt: skip
    rate_per_s: Number = quantity(
        "1/s", "Largest rate of κ", symbol="Rate of κ", gt=0, le=5, default=0.5, searched=False
    )
    least: Number = quantity(
        "1", "Smallest κ", symbol="Least κ", gt=0, le=1, default=0.5, searched=False
    )
    greatest: Number = quantity(
        "1", "Greatest κ", symbol="Greatest κ", ge=1, le=5, default=2.0, searched=False
    )


class Constants(NamedTuple):
    """Constants of the law.

    Attributes:
        gains: `GainConstants`.
        share: 1 − e^(−βT).
        spring: Constants of the spring estimator.
        mask: See `find_spring_scale`.
        limit: Largest relative deviation of κ̂ that is followed.
        step: Largest change of κ in a period.
        least: Smallest κ.
        greatest: Greatest κ.
        softest: Smallest nominal stiffness of the domain, N·m/rad.
        stiffest: Greatest nominal stiffness of the domain, N·m/rad.
    """

    gains: GainConstants
    share: float
    spring: SpringConstants
    mask: tuple[float, ...]
    limit: float
    step: float
    least: float
    greatest: float
    softest: float
    stiffest: float


class Memory(NamedTuple):
    """Observer, spring estimator and κ."""

    observed: Observed = Observed()
    spring: Spring = Spring()
    ratio: float = 1.0


def build(parameters: AdaptiveSpring, setting: Setting) -> Constants:
    """Gains, observer, spring estimator and the range of κ."""
    p, period, domain = parameters, setting.period, setting.domain
    mask = find_spring_scale(setting.nominal)
    if mask is None:
        bound = "an actuator whose spring torque has a parameter as a factor"
        raise ParameterError(Violation("law", "ndobc_k", "", bound))
    ends = [compute_stiffness_of(setting.nominal, mu, 0.0) for mu in (domain.mu_min, domain.mu_max)]
    gains = Gains.from_poles([-p.position_pole_rad_per_s] * 4, [-p.stiffness_pole_rad_per_s] * 2)
    return Constants(
        gains=build_gains(gains),
        share=compute_share(p.observer_rad_per_s, period),
        spring=SpringEstimation().build(period),
        mask=mask,
        limit=p.deviation_limit,
        step=p.rate_per_s * period,
        least=p.least,
        greatest=p.greatest,
        softest=min(ends) * (1.0 + MARGIN),
        stiffest=max(ends) * (1.0 - MARGIN),
    )


@compiled
def follow_estimate(constants: Constants, memory: np.record, sigma: float) -> float:
    """Move κ towards its estimate, if that is known; return κ.

    Args:
        constants: `Constants`.
        memory: `Memory`, whose κ is written.
        sigma: σ_d, N·m/rad: σ_d/κ stays in the nominal range of the stiffness.
    """
    k, found = constants, read_spring(constants.spring, memory.spring)
    # False for NaN: no estimate is followed after a misfit.
    if found.deviation <= k.limit * found.ratio:
        low = max(k.least, sigma / k.stiffest)
        high = max(low, min(k.greatest, sigma / k.softest))
        target = min(max(found.ratio, low), high)
        memory.ratio += min(max(target - memory.ratio, -k.step), k.step)
    return memory.ratio


@compiled
def control(
    nominal: Actuator,
    constants: Constants,
    memory: np.record,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
    measured: Positions,
) -> Torque:
    """NDOBC with the model κ K_n as the loop calls it: see `Law`."""
    k = constants
    update_spring(k.spring, memory.spring, nominal, measured, x.dtheta1, applied.u1, period)
    ratio = follow_estimate(k, memory, reference.sigma)
    model = scale_spring(nominal, ratio, k.mask)
    w = observe_disturbance(model, k.share, 0.0, memory.observed, x, applied, period)
    return compute_ndobc(model, k.gains, x, reference, w)


NDOBC_K = Law(
    name="ndobc_k",
    title="NDOBC-K",
    summary="NDOBC whose nominal spring follows the estimated one: after the first load the"
    " stiffness is right, too.",
    equation=r"u=A_{\hat K}^{-1}\,(b-v-\Gamma\hat w)",
    source="Eq 24, with K of the spring estimator: the composite adaptive control that the paper"
    " names as future work",
    parameters=AdaptiveSpring,
    build=build,
    control=control,
    memory=Memory,
    estimate="own",
)
