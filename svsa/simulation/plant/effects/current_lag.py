"""The current loop of the drives: from the delayed torque to the actual one."""

from svsa.actuators.signals import Torque
from svsa.inputs.checked import Checked, Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp, expm1
from svsa.numerics.simd.choice import choose, some
from svsa.simulation.plant.effects.effect import Effect, Surroundings


class CurrentLag(Checked):
    """The current loop of the drives as a first-order lag."""

    time_constant_s: Number = quantity("s", "Time constant", ge=1e-5, le=0.05, default=0.0005)


def _build(lag: CurrentLag, _: Surroundings) -> float:
    return lag.time_constant_s


@compiled
def approach(start: Torque, delayed: Torque, rest: float) -> Torque:
    """`Torque` with this share (1) of the way from `start` to `delayed` left, N·m."""
    return Torque(
        delayed.u1 + (start.u1 - delayed.u1) * rest, delayed.u2 + (start.u2 - delayed.u2) * rest
    )


@compiled
def compute_lagged_torque(start: Torque, delayed: Torque, lag: float, since: float) -> Torque:
    """First-order lag of the current loop: u + (τ_0 − u) e^(−t/τ).

    Args:
        start: `Torque` at the beginning of the period, N·m.
        delayed: `Torque` after the delay, N·m.
        lag: Time constant τ, s; 0 for none.
        since: Time since the beginning of the period, s.

    Returns:
        `Torque`, N·m.
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
    """The motors' torque if a new torque arrives `latency` after the beginning of the period.

    Args:
        start: `Torque` at the beginning, N·m.
        before: Commanded `Torque` until the arrival, N·m.
        delayed: Commanded `Torque` after the arrival, N·m.
        lag: Time constant, s.
        latency: Delay within the period, 0 to `period`, s.
        period: T, s.

    Returns:
        `Torque` at the end of the period, and mean `Torque` over it, N·m.
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


EFFECT = Effect(
    name="current_lag",
    place=40,
    kind=CurrentLag | None,
    field=quantity("", "Lag of the current loop", default=None),
    words="current lag",
    preset="full",
    on=CurrentLag(),
    phrase="the lag of the current loop",
    off=0.0,
    build=_build,
)
