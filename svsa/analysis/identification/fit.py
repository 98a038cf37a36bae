"""Output error by multiple shooting: parameters with which the plant reproduces the record.

The record is divided into short segments, each with its own initial state, so that neither drift
nor an instability grows (Bock 1983). Levenberg–Marquardt estimates all unknowns at once; the
initial states are eliminated segment by segment, so that the cost is linear in the length of the
record.

The covariance is the sandwich estimator with the segments as clusters, corrected for their leverage
(CR3, the jackknife): encoder counts are not white noise, and the only assumption is that segments
are independent.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from svsa.analysis.identification.initial_guess import guess_parameters, guess_states
from svsa.analysis.identification.problem import SHAPE, UNKNOWNS, Point, Problem
from svsa.analysis.identification.record import Evidence, IdentificationError

_FIRST_DEVIATION = np.array([2e-5, 2e-5, 2e-4])
_MIN_DEVIATION = 1e-9
_MAX_PASSES = 6
_STEADY = 0.02
_MAX_ITERATIONS = 30
_ROUGH, _FINE = 0.05, 1e-6
_ROUGH_SHARE = 3
_MIN_DAMPING, _MAX_DAMPING = 1e-9, 1e6
_OUTLIER = 5.0
_MAX_DROPPED = 0.2
_MODEL_SHARE = 1e-4

Progress = Callable[[float], None]


class Fit(NamedTuple):
    """The result of a fit.

    Attributes:
        values: `Parameters`, shape (17,).
        deviations: Standard deviations, shape (17,); a ten-thousandth of the value is added, for
            torques between samples.
        residual: rms residuals of θ1, θ2, φ, rad, shape (3,).
        used: Number of segments used.
        dropped: Number of segments dropped because the model explains them far worse than the
            others.
    """

    values: np.ndarray
    deviations: np.ndarray
    residual: np.ndarray
    used: int
    dropped: int


def fit(evidence: Evidence, progress: Progress = lambda _: None) -> Fit:
    """Fit the parameters to a record; `progress` receives the finished share.

    The first pass uses some of the segments; the following passes use all, and weight the angles by
    the residuals of the previous pass.

    Raises:
        IdentificationError: If the model does not explain the record.
    """
    segments, residual = evidence.segments, _FIRST_DEVIATION
    centre, starts = guess_parameters(evidence), guess_states(evidence)[segments]
    few = slice(None, None, _ROUGH_SHARE)
    problem = Problem(evidence, segments[few], residual, centre, SHAPE)
    report = _build_teller(progress, 0)
    point, _ = _minimize(problem, Point(centre, starts[few]), _ROUGH, report)
    point = Point(point.values, starts)
    for step in range(1, _MAX_PASSES):
        problem = Problem(evidence, segments, residual, centre)
        point, squares = _minimize(problem, point, _FINE, _build_teller(progress, step))
        before, share = residual, np.sum(squares / residual**2, axis=1)
        kept = share <= _OUTLIER**2 * np.median(share)
        segments, point = segments[kept], Point(point.values, point.starts[kept])
        _check_dropped(evidence, len(segments))
        mean = squares[kept].sum(axis=0) / (len(segments) * evidence.length)
        residual = np.maximum(np.sqrt(mean), _MIN_DEVIATION)
        if kept.all() and np.all(np.abs(residual - before) <= _STEADY * before):
            break
    problem = Problem(evidence, segments, residual, centre)
    covariance = compute_covariance(problem, point)
    floor = _MODEL_SHARE * np.abs(point.values)
    deviations = np.sqrt(np.diag(covariance) + floor**2)
    progress(1.0)
    dropped = len(evidence.segments) - len(segments)
    return Fit(point.values, deviations, residual, len(segments), dropped)


def compute_covariance(problem: Problem, point: Point) -> np.ndarray:
    """Compute the covariance of the parameters: A⁻¹ (Σ s sᵀ + P) A⁻¹.

    A is their information, including that of the prior P. s = (1 − A_k A⁻¹)⁻¹ g_k is the score of a
    segment without its own leverage on the result.
    """
    reduced = problem.reduce(problem.linearize(point), 0.0)
    total, _ = problem.sum_up(reduced, point.values)
    scale = 1.0 / np.sqrt(np.diag(total))
    inverse = np.linalg.inv(total * np.outer(scale, scale))
    share = np.eye(UNKNOWNS) - reduced.information * np.outer(scale, scale) @ inverse
    scores = np.linalg.solve(share, (reduced.score * scale)[:, :, None])[:, :, 0]
    half = scores @ inverse * scale
    prior = np.sqrt(problem.prior_weight)[:, None] * scale[:, None] * inverse * scale
    return half.T @ half + prior.T @ prior


def _minimize(
    problem: Problem, point: Point, tolerance: float, report: Callable[[int], None]
) -> tuple[Point, np.ndarray]:
    """Minimise by Levenberg–Marquardt until the relative decrease of the cost is below `tolerance`.

    Returns the best point and its squares (segments, 3), see `Normal`.
    """
    normal = problem.linearize(point)
    cost, damping = problem.compute_cost(normal.squares, point.values), 1e-3
    for iteration in range(_MAX_ITERATIONS):
        report(iteration)
        while True:
            trial = problem.step(normal, point, damping)
            trial_cost = problem.compute_cost(problem.compute_squares(trial), trial.values)
            if trial_cost <= cost:
                break
            if damping > _MAX_DAMPING:
                return point, normal.squares
            damping *= 10.0
        fall, point, cost = cost - trial_cost, trial, trial_cost
        normal = problem.linearize(point)
        damping = max(0.1 * damping, _MIN_DAMPING)
        if fall <= tolerance * cost:
            break
    return point, normal.squares


def _build_teller(progress: Progress, step: int) -> Callable[[int], None]:
    """Build a progress function over both passes, whose number of iterations is unknown."""
    return lambda iterations: progress(1.0 - 0.5**step * (0.5 + 0.5 * 0.85**iterations))


def _check_dropped(evidence: Evidence, kept: int) -> None:
    count = len(evidence.segments)
    if count - kept > _MAX_DROPPED * count:
        raise IdentificationError(
            f"The model does not explain {count - kept} of {count} pieces of this run: was"
            " there a load, a contact or a wrong geometry?"
        )
