"""What is summed up of a run of a batch as it goes, in place of its samples."""

from typing import NamedTuple

import numpy as np

from svsa.compilation import compiled
from svsa.model.dynamics import Actuator, compute_deflection
from svsa.model.lever import compute_lever_ratio
from svsa.model.spring import compute_stiffness
from svsa.signals import Reference, State, Torque
from svsa.simd.choice import choose, greatest


class Tally(NamedTuple):
    """Of a run's measured ticks: sums of squares and sizes, peaks and what came last, SI."""

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


SUMMARY = np.dtype(
    [("code", np.int64), ("ticks", np.int64)]
    + [(name, np.float64) for name in (*Tally._fields, *State._fields)]
)
"""Of each run: `INSIDE` or why it ended, after how many ticks, `Tally`, and the state reached."""


@compiled
def start_tally(nothing: float) -> Tally:
    """`Tally` before the first tick. nothing: 0."""
    n = nothing
    return Tally(n, n, n, n, n, n, n, n, n, n, n)


@compiled
def measure(
    tally: Tally, counts: bool, plant: Actuator, reference: Reference, x: State, torque: Torque
) -> Tally:
    """`Tally` with the tick that begins at x. counts: whether it does, of each run."""
    t = tally
    mu = compute_lever_ratio(x.theta2, plant.mu0, plant.gamma)
    sigma = compute_stiffness(mu, compute_deflection(x), plant.K)
    position, stiffness = reference.q - x.q, reference.sigma - sigma
    e, s = choose(counts, abs(position), 0.0), choose(counts, abs(stiffness), 0.0)
    u1, u2 = choose(counts, abs(torque.u1), 0.0), choose(counts, abs(torque.u2), 0.0)
    return Tally(
        t.position_squares + e * e,
        t.stiffness_squares + s * s,
        t.torque1_squares + u1 * u1,
        t.torque2_squares + u2 * u2,
        t.position_absolute + e,
        greatest(t.position_peak, e),
        greatest(t.stiffness_peak, s),
        greatest(t.torque1_peak, u1),
        greatest(t.torque2_peak, u2),
        choose(counts, position, t.position_last),
        choose(counts, stiffness, t.stiffness_last),
    )
