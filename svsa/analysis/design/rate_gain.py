"""Position error per disturbance rate: gains from ẇ to e of the loop about rest.

Theorem 1 states that the loop is locally input-to-state stable, without a number. These gains are
those of the *linear* loop and valid for small motions; an ISS gain of the nonlinear loop is not
computed.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.analysis.design.closed_loop import ClosedLoop
from svsa.control.installed import get_law
from svsa.control.laws.feedback_linearization import build_gains
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from svsa.simulation.plant.effects import IDEAL
from svsa.simulation.plant.loads.series import SeriesLoad
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness

RAMPS_NM_PER_S = (0.2, 1.0)
RAMP_S = 1.0
_SETTLED = 1e-9
_MIN_RATE = 1e-6
_LONGEST_S = 20.0
_POINTS = 4000


class RateGain(NamedTuple):
    """Position error per rate of the link's torque, rad per N·m/s.

    Both are infinite if a constant torque leaves an error, or the loop is unstable.

    Attributes:
        ramp: |e| after a constant ramp of rate ẇ2, divided by |ẇ2|.
        l1: L1 gain ∫|g(t)| dt of the impulse response g from ẇ2 to e: the largest |e| for any w2
            with |ẇ2| ≤ 1 N·m/s in the linear loop.
    """

    ramp: float
    l1: float


def compute_rate_gain(loop: ClosedLoop) -> RateGain:
    """From the linear loop: |C A⁻² B| and ∫|C A⁻¹ e^{At} B| dt, for w2 and the position."""
    if loop.slowest > -_MIN_RATE:
        return RateGain(math.inf, math.inf)
    A, b, c = loop.A, loop.B[:, 0], loop.C[0]
    from scipy.linalg import expm  # imported here: the import is slow

    before = np.linalg.solve(A.T, c)
    ramp = float(before @ np.linalg.solve(A, b))
    if abs(float(before @ b)) > 1e-6 * abs(ramp * loop.slowest):
        return RateGain(math.inf, math.inf)
    longest = min(_LONGEST_S, -math.log(_SETTLED) / -loop.slowest)
    step = longest / _POINTS
    advance, z, total = expm(A * step), b.copy(), 0.0
    last = abs(float(before @ z))
    for _ in range(_POINTS):
        z = advance @ z
        now = abs(float(before @ z))
        total, last = total + 0.5 * step * (last + now), now
    return RateGain(abs(ramp), total)


def compute_formula(configuration: Configuration, sigma: float) -> float | None:
    """|e| / |ẇ2| of NDOBC in closed form, rad per N·m/s; None for a law without a formula.

        e / ẇ2 = (Γ12/β2 + (c3 − D/M)/M) / c0,   Γ12 = (c2 − c3 D/M + (D²/M − σ)/M)/M

    from the error dynamics (Eq 23, 24) under a ramp, for which ŵ2 lags by ẇ2/β2. For β → ∞ the
    floor (c3 − D/M)/(M c0) remains, because ŵ is constant in the error's third derivative.
    """
    gains = build_gains(configuration.gains)
    if configuration.law != "ndobc" or gains.p0 <= 0.0:
        return None
    M, D = (
        configuration.nominal.link_inertia_kg_m2,
        configuration.nominal.link_damping_nms_per_rad,
    )
    beta = configuration.observer.bandwidth_rad_per_s[0]
    gamma = (gains.p2 - gains.p3 * D / M + (D * D / M - sigma) / M) / M
    return abs(gamma / beta + (gains.p3 - D / M) / M) / gains.p0


def compute_floor(configuration: Configuration) -> float | None:
    """Limit of `compute_formula` for β → ∞."""
    gains = build_gains(configuration.gains)
    if configuration.law != "ndobc" or gains.p0 <= 0.0:
        return None
    M = configuration.nominal.link_inertia_kg_m2
    D = configuration.nominal.link_damping_nms_per_rad
    return abs(gains.p3 - D / M) / (M * gains.p0)


class RampRun(NamedTuple):
    """A simulated ramp.

    Attributes:
        rate: ẇ2, N·m/s.
        gain: |e|/|ẇ2| at its end, rad per N·m/s.
        lag: |w2 − ŵ2|/|ẇ2| at its end, s; None for a law without ŵ.
        fault: Fault at the end of the run, or "".
    """

    rate: float
    gain: float
    lag: float | None
    fault: str


def simulate_ramp(configuration: Configuration, sigma: float, rate: float) -> RampRun:
    """The nonlinear loop at rest at σ_d = `sigma` under w2 = rate · t for `RAMP_S`."""
    end = rate * RAMP_S
    run = Run(
        configuration.changed(
            position=ConstantPosition(),
            stiffness=ConstantStiffness(stiffness_nm_per_rad=sigma),
            effects=IDEAL,
            comparisons=(),
            loads=(SeriesLoad(time_s=(0.0, RAMP_S), torque_nm=((0.0, 0.0, 0.0), (end, 0.0, 0.0))),),
        )
    )
    samples = np.empty((1, round(RAMP_S / run.period_s), len(CHANNELS)))
    done = run.advance(samples)
    if run.fault is not None or done == 0:
        return RampRun(rate, math.inf, None, run.fault.message if run.fault else "")
    last = samples[0, -1]
    error = abs(last[CHANNEL_INDEX["position_error_rad"]])
    w = last[CHANNEL_INDEX["disturbance_link_nm"]]
    estimate = last[CHANNEL_INDEX["estimate_link_nm"]]
    is_observed = get_law(configuration.law).estimate != "none"
    return RampRun(
        rate, float(error / rate), float(abs(w - estimate) / rate) if is_observed else None, ""
    )
