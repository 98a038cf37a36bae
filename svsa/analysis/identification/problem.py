"""The sum of squares that identification minimises, its derivatives and its step."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import numpy as np

from svsa.analysis.identification.kernel import (
    OUTPUTS,
    STATES,
    Parameters,
    differentiate,
    simulate,
)
from svsa.analysis.identification.record import Evidence

UNKNOWNS = len(Parameters._fields)
_STATE_STEPS = np.array([1e-5, 1e-4, 1e-5, 1e-4, 1e-5, 1e-4])
_STEP = 1e-4
_INFINITE = np.inf

# The first pass keeps the guessed shape of the friction: while the other parameters are still far
# off, a fit of the shape would compensate for their errors.
SHAPE = ("static_ratio", "stribeck", "creep1", "creep2")
_HELD = 1e-6
_EXACT = 1e-9
"""Standard deviation of a lever ratio that is known, 1."""

# Prior knowledge: the standard deviation of each parameter about its first guess. The widths are so
# large that they matter only where the record contains no information.
_WIDTHS = Parameters(
    M=0.1, B1=0.1, B2=0.1, D=0.1, D1=0.1, D2=0.1, K=100.0, coulomb1=1.0, coulomb2=1.0,
    static_ratio=0.5, stribeck=0.1, creep1=0.02, creep2=0.02, gravity_moment=5.0, delay1=0.002,
    delay2=0.002, lever_error=0.01,
)  # fmt: skip
_MIN = Parameters(
    M=1e-6, B1=1e-6, B2=1e-6, D=0.0, D1=0.0, D2=0.0, K=1e-3, coulomb1=0.0, coulomb2=0.0,
    static_ratio=1.0, stribeck=1e-3, creep1=1e-3, creep2=1e-3,
    gravity_moment=-_INFINITE, delay1=-0.01, delay2=-0.01,
    lever_error=-_INFINITE,
)  # fmt: skip
_MAX = Parameters(
    *(_INFINITE,) * UNKNOWNS,
)._replace(static_ratio=5.0, stribeck=10.0, creep1=1.0, creep2=1.0, delay1=0.01, delay2=0.01)
_ALWAYS_POSITIVE = np.array([least > 0.0 for least in _MIN])
_MAX_FACTOR = 3.0
_CREEP_SHARE = 0.5


class Point(NamedTuple):
    """A point of the search.

    Attributes:
        values: `Parameters`, shape (17,).
        starts: State at the first row of each segment, shape (segments, 6).
    """

    values: np.ndarray
    starts: np.ndarray


class Normal(NamedTuple):
    """The normal equations of every segment, for its parameters and its initial state.

    Attributes:
        information: Shape (segments, 22, 22).
        score: Shape (segments, 22).
        squares: Sums of the squared errors of θ1, θ2, φ, rad², shape (segments, 3).
    """

    information: np.ndarray
    score: np.ndarray
    squares: np.ndarray


class Reduced(NamedTuple):
    """`Normal` with the start states eliminated: their step is offset − slope · (step of p)."""

    information: np.ndarray
    score: np.ndarray
    slope: np.ndarray
    offset: np.ndarray


class Problem:
    """The segments of a record, the deviations (3,) as weights, and a weak prior.

    `held` are the names of `Parameters` that stay at the center of the prior.
    """

    def __init__(
        self,
        evidence: Evidence,
        segments: np.ndarray,
        deviations: np.ndarray,
        centre: np.ndarray,
        held: tuple[str, ...] = (),
    ) -> None:
        self._evidence, self._segments, self._deviations = evidence, segments, deviations
        self._centre = centre
        widths = _WIDTHS._replace(lever_error=max(evidence.lever_deviation, _EXACT))
        self._widths = np.array(widths._replace(**dict.fromkeys(held, _HELD)))

    @property
    def prior_weight(self) -> np.ndarray:
        """(17,) the information that the prior adds to each parameter."""
        return self._widths**-2.0

    def compute_cost(self, squares: np.ndarray, values: np.ndarray) -> float:
        """The weighed sum of squares, with the prior's; infinite where it is not finite."""
        prior = (values - self._centre) / self._widths
        cost = float(np.sum(squares / self._deviations**2) + np.sum(prior**2))
        return cost if np.isfinite(cost) else _INFINITE

    def compute_squares(self, point: Point) -> np.ndarray:
        """`Normal.squares` without the derivatives."""
        e, squares = self._evidence, np.empty((len(self._segments), OUTPUTS))

        def work(i: int) -> None:
            outputs = np.empty((e.length, OUTPUTS))
            first = self._segments[i]
            simulate(e.setting, point.values, point.starts[i], e.torques, first, outputs)
            squares[i] = np.sum((e.angles[first : first + e.length] - outputs) ** 2, axis=0)

        _share_out(work, len(squares))
        return squares

    def linearize(self, point: Point) -> Normal:
        """The normal equations at a point."""
        e, size, count = self._evidence, UNKNOWNS + STATES, len(self._segments)
        steps = _STEP * np.maximum(np.abs(point.values), 0.01 * np.array(_WIDTHS))
        steps = np.concatenate([steps, _STATE_STEPS])
        normal = Normal(
            np.empty((count, size, size)), np.empty((count, size)), np.empty((count, OUTPUTS))
        )

        def work(i: int) -> None:
            outputs, slopes = np.empty((e.length, OUTPUTS)), np.empty((size, e.length, OUTPUTS))
            first, start = self._segments[i], point.starts[i]
            differentiate(e.setting, point.values, start, steps, e.torques, first, outputs, slopes)
            error = e.angles[first : first + e.length] - outputs
            weighed = (slopes / self._deviations).reshape(size, -1)
            normal.information[i] = weighed @ weighed.T
            normal.score[i] = weighed @ (error / self._deviations).ravel()
            normal.squares[i] = np.sum(error**2, axis=0)

        _share_out(work, count)
        return normal

    def reduce(self, normal: Normal, damping: float) -> Reduced:
        """The start states eliminated, their own information raised by the share `damping`."""
        n, diagonal = UNKNOWNS, np.arange(STATES)
        states, cross = normal.information[:, n:, n:].copy(), normal.information[:, n:, :n]
        states[:, diagonal, diagonal] *= 1.0 + damping
        solved = np.linalg.solve(states, np.concatenate([cross, normal.score[:, n:, None]], 2))
        slope, offset = solved[:, :, :n], solved[:, :, n]
        turned = cross.transpose(0, 2, 1)
        return Reduced(
            normal.information[:, :n, :n] - turned @ slope,
            normal.score[:, :n] - (turned @ offset[:, :, None])[:, :, 0],
            slope,
            offset,
        )

    def sum_up(self, reduced: Reduced, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Sum information (17, 17) and score (17,) of the parameters: all segments and the
        prior.
        """
        weight = self.prior_weight
        score = reduced.score.sum(axis=0) + weight * (self._centre - values)
        return reduced.information.sum(axis=0) + np.diag(weight), score

    def step(self, normal: Normal, point: Point, damping: float) -> Point:
        """The Levenberg–Marquardt step from a point, held within the bounds of every value."""
        reduced = self.reduce(normal, damping)
        total, score = self.sum_up(reduced, point.values)
        scale = 1.0 / np.sqrt(np.diag(total))
        scaled = total * np.outer(scale, scale) + damping * np.eye(UNKNOWNS)
        step = scale * np.linalg.solve(scaled, scale * score)
        values = _bound(point.values, step, self._evidence.setting.period)
        moved = reduced.offset - reduced.slope @ (values - point.values)
        return Point(values, point.starts + moved)


def _share_out(work: Callable[[int], None], count: int) -> None:
    """Run `work` for every segment on all cores; compiled code releases the GIL."""
    with ThreadPoolExecutor() as pool:
        for _ in pool.map(work, range(count)):
            pass


def _bound(values: np.ndarray, step: np.ndarray, period: float) -> np.ndarray:
    """Limit a step to bounds; the creep velocity stays large enough for the integration."""
    moved = values + step
    within = np.clip(moved, values / _MAX_FACTOR, values * _MAX_FACTOR)
    p = Parameters(*np.clip(np.where(_ALWAYS_POSITIVE, within, moved), _MIN, _MAX))
    least1 = _CREEP_SHARE * p.coulomb1 * p.static_ratio * period / p.B1
    least2 = _CREEP_SHARE * p.coulomb2 * p.static_ratio * period / p.B2
    bounded = p._replace(creep1=max(p.creep1, least1), creep2=max(p.creep2, least2))
    return np.array(bounded)
