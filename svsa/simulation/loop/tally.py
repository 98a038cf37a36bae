"""The running summary of a vectorised run, instead of its samples."""

import math
from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.dynamics import InternalTorque, compute_deflection
from svsa.actuators.elasticity import compute_coordinate, compute_stiffness_of
from svsa.actuators.signals import Reference, State, Torque
from svsa.control.limits import are_at_limit
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose, greatest
from svsa.simulation.loop.lane import Action, Blocks, LaneState

RECOVERY_SHARE = 0.02
STEADY_STATE_S = 0.5
LAST_S = 1.0
AT_LIMIT = 0.999


class Window(NamedTuple):
    """The measured ticks.

    Attributes:
        begin: First measured tick.
        end: Tick after the last measured one.
        settled: Number of ticks in 0.5 s.
        last: Number of ticks in 1 s.
    """

    begin: int
    end: int
    settled: int
    last: int


class Tally(NamedTuple):
    """Summary of a run's measured ticks: sums of squares and absolute values, peaks, last values,
    SI.

    Attributes:
        steady_state_squares: Squares of the position error in the last 0.5 s;
            `stiffness_steady_squares` likewise.
        position_last_peak: Peak of the position error in the last 1 s; `share_last_peak` of the
            stiffness share.
        share_peak: Peak of |σ_d − σ|/σ_d.
        inside: Measured tick from which on the position error is within 2 % of its peak.
        recovered: Measured tick from which on the position error stayed within 2 % of its peak for
            0.5 s; −1 before.
        limited: Number of ticks in which a motor is within 0.1 % of its limit.
        torque1_variation: Sum of |Δu1| between consecutive measured ticks.
        torque1_last: u1 of the last tick.
        power: Sum of |u1 θ̇1| + |u2 θ̇2|, the mechanical power of the motors without recuperation.
    """

    position_squares: float
    stiffness_squares: float
    torque1_squares: float
    torque2_squares: float
    position_absolute: float
    position_peak: float
    stiffness_peak: float
    torque1_peak: float
    torque2_peak: float
    position_last: float
    stiffness_last: float
    steady_state_squares: float
    inside: float
    recovered: float
    limited: float
    stiffness_steady_squares: float
    share_peak: float
    position_last_peak: float
    share_last_peak: float
    torque1_variation: float
    torque1_last: float
    power: float


class TallyState(NamedTuple):
    """The summary of a vectorised run: the `Tally` of the ticks in the `Window`."""

    tally: Tally
    window: Window


SUMMARY = np.dtype(
    [("code", np.int64), ("ticks", np.int64)]
    + [(name, np.float64) for name in (*Tally._fields, *State._fields)]
)
"""For each run: `INSIDE` or the reason for its end, number of ticks, `Tally`, and the final state.
"""


@compiled
def build_window(begin: int, end: int, period: float) -> Window:
    """`Window` of a run of `end` ticks of `period`, s."""
    # Rounding may put the quotient just above a whole number; `ceil` would then add a tick.
    settled = math.ceil(STEADY_STATE_S / period - 1e-9)
    return Window(begin, end, settled, math.ceil(LAST_S / period - 1e-9))


@compiled
def start_tally(nothing: float) -> Tally:
    """`Tally` before the first tick; `nothing` is 0, a float or a vector."""
    n = nothing
    return Tally(
        n, n, n, n, n, n, n, n, n, n, n, n, n, n - 1.0, n, n, n, n, n, n, n, n
    )  # fmt: skip


@compiled
def follow_recovery(
    counts: bool,
    error: float,
    peak: float,
    passed: float,
    settled: float,
    inside: float,
    recovered: float,
) -> tuple[float, float]:
    """Update the 2 % rule of the recovery time by one tick; its only implementation.

    Args:
        counts: Whether the tick is measured.
        error: |q_d − q| of the tick, rad.
        peak: Largest error so far, rad.
        passed: Number of measured ticks including this one.
        settled: Number of ticks in 0.5 s.
        inside: Measured tick from which on the error is within 2 % of its peak.
        recovered: Measured tick from which on it stayed so for 0.5 s; −1 before.

    Returns:
        (inside, recovered) after the tick.
    """
    inside = choose(counts & (error > RECOVERY_SHARE * peak), passed, inside)
    stayed = counts & (recovered < 0.0) & (passed - inside >= settled)
    return inside, choose(stayed, inside, recovered)


class Moment(NamedTuple):
    """The quantities of one tick that metrics use.

    Attributes:
        position: q_d − q, rad.
        stiffness: σ_d − σ, N·m/rad.
        sigma: σ_d, N·m/rad.
        u1: Actual torque of motor 1, N·m.
        u2: Actual torque of motor 2, N·m.
        dtheta1: Velocity of motor 1, rad/s.
        dtheta2: Velocity of motor 2, rad/s.
    """

    position: float
    stiffness: float
    sigma: float
    u1: float
    u2: float
    dtheta1: float
    dtheta2: float


@compiled
def add_moment(
    tally: Tally,
    runs: bool,
    window: Window,
    is_limited: bool,
    moment: Moment,
    tick: int,
) -> Tally:
    """Add one tick to the `Tally` of a running lane; `is_limited` is whether a motor is at its
    limit.
    """
    t, m = tally, moment
    e, s = choose(runs, abs(m.position), 0.0), choose(runs, abs(m.stiffness), 0.0)
    u1, u2 = choose(runs, abs(m.u1), 0.0), choose(runs, abs(m.u2), 0.0)
    peak, passed = greatest(t.position_peak, e), float(tick - window.begin + 1)
    settled = float(window.settled)
    inside, recovered = follow_recovery(runs, e, peak, passed, settled, t.inside, t.recovered)
    share = s / m.sigma
    squares, stiffness_squares = t.steady_state_squares, t.stiffness_steady_squares
    if tick >= window.end - window.settled:
        squares, stiffness_squares = squares + e * e, stiffness_squares + s * s
    last_peak, share_last_peak = t.position_last_peak, t.share_last_peak
    if tick >= window.end - window.last:
        last_peak, share_last_peak = greatest(last_peak, e), greatest(share_last_peak, share)
    variation = t.torque1_variation
    if tick > window.begin:
        variation = variation + choose(runs, abs(m.u1 - t.torque1_last), 0.0)
    return Tally(
        t.position_squares + e * e,
        t.stiffness_squares + s * s,
        t.torque1_squares + u1 * u1,
        t.torque2_squares + u2 * u2,
        t.position_absolute + e,
        peak,
        greatest(t.stiffness_peak, s),
        greatest(t.torque1_peak, u1),
        greatest(t.torque2_peak, u2),
        choose(runs, m.position, t.position_last),
        choose(runs, m.stiffness, t.stiffness_last),
        squares,
        inside,
        recovered,
        choose(runs & is_limited, t.limited + 1.0, t.limited),
        stiffness_squares,
        greatest(t.share_peak, share),
        last_peak,
        share_last_peak,
        variation,
        m.u1,
        t.power + choose(runs, u1 * abs(m.dtheta1) + u2 * abs(m.dtheta2), 0.0),
    )


@compiled
def measure(
    tally: Tally,
    runs: bool,
    window: Window,
    blocks: Blocks,
    reference: Reference,
    x: State,
    torque: Torque,
    tick: int,
) -> Tally:
    """Add the tick that begins at x to the `Tally` of each running lane; `torque` is the actual
    torque, N·m.
    """
    if tick < window.begin:
        return tally
    plant = blocks.plant
    mu = compute_coordinate(plant, x.theta2)
    sigma = compute_stiffness_of(plant, mu, compute_deflection(x))
    errors = reference.q - x.q, reference.sigma - sigma
    moment = Moment(*errors, reference.sigma, torque.u1, torque.u2, x.dtheta1, x.dtheta2)
    most = Torque(AT_LIMIT * blocks.torque1_max, AT_LIMIT * blocks.torque2_max)
    is_limited = are_at_limit(plant, torque, most)
    return add_moment(tally, runs, window, is_limited, moment, tick)


@compiled
def publish_tally(
    runs: bool,
    blocks: Blocks,
    reference: Reference,
    lane: LaneState,
    F: InternalTorque,
    call: Any,
    action: Action,
    tick: int,
    kept: TallyState,
) -> TallyState:
    """Add this tick to `TallyState`, in place of `svsa.simulation.loop.publish.publish`."""
    window = kept.window
    tally = measure(kept.tally, runs, window, blocks, reference, lane.x, action.actual, tick)
    return TallyState(tally, window)
