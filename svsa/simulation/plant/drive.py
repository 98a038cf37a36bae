"""The motors: from the commanded torque to their actual torque, and their friction."""

from svsa.actuators.signals import Torque
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp, expm1, tanh
from svsa.numerics.simd.choice import choose, some


@compiled
def approach(start: Torque, delayed: Torque, rest: float) -> Torque:
    """`Torque` with this share (1) of the way from `start` to `delayed` left, N·m."""
    return Torque(
        delayed.u1 + (start.u1 - delayed.u1) * rest, delayed.u2 + (start.u2 - delayed.u2) * rest
    )


@compiled
def compute_lagged_torque(start: Torque, delayed: Torque, lag: float, since: float) -> Torque:
    """First-order lag of the current loop: u + (τ_0 − u) e^(−t/τ), N·m.

    start: `Torque` at the beginning of the period. delayed: `Torque` after the delay. lag: time
    constant, s; 0 is none. since: time in the period, s.
    """
    lags = lag > 0.0
    if not some(lags):
        return delayed
    return choose(lags, approach(start, delayed, exp(-since / lag)), delayed)


@compiled
def compute_mean_torque(start: Torque, delayed: Torque, lag: float, period: float) -> Torque:
    """The mean of `compute_lagged_torque` over a period (s): the input of the observer."""
    lags = lag > 0.0
    if not some(lags):
        return delayed
    rest = lag / period * -expm1(-period / lag)
    return choose(lags, approach(start, delayed, rest), delayed)


@compiled
def compute_late_torque(
    start: Torque, before: Torque, delayed: Torque, lag: float, latency: float, period: float
) -> tuple[Torque, Torque]:
    """The motors' torque where a new torque arrives `latency` (s) after the period began.

    start: `Torque` made at the beginning. before, delayed: what arrived until then and after, N·m.
    lag: time constant, s. 0 ≤ latency ≤ period, s. Returns (`Torque` at the end of the
    period, mean `Torque` over it).
    """
    rest = period - latency
    met = compute_lagged_torque(start, before, lag, latency)
    # The mean over an interval of zero length would be 0/0.
    early = compute_mean_torque(start, before, lag, latency) if latency > 0.0 else start
    late = compute_mean_torque(met, delayed, lag, rest) if rest > 0.0 else met
    mean = Torque(
        (early.u1 * latency + late.u1 * rest) / period,
        (early.u2 * latency + late.u2 * rest) / period,
    )
    return compute_lagged_torque(met, delayed, lag, rest), mean


@compiled
def compute_friction(
    velocity: float, coulomb: float, static: float, stribeck: float, creep: float
) -> float:
    """τ_f = [τ_c + (τ_s − τ_c) e^(−(v/v_s)²)] tanh(v/v_c), N·m, against the motion.

    velocity v: rad/s. coulomb τ_c, static τ_s: N·m. stribeck v_s: rad/s, > 0. creep v_c:
    rad/s, > 0, the velocity at which a motor that should stick creeps; the tanh stands for
    the sign, so that the equations stay differentiable.
    """
    ratio = velocity / stribeck
    level = coulomb + (static - coulomb) * exp(-ratio * ratio)
    return level * tanh(velocity / creep)
