"""The plant solved by scipy's `solve_ivp` with the same accuracy: its CPU time in multiples of
ours.

Each method has the largest tolerance whose error is not above ours. The cheapest method is
reported. The torques jump between periods, so there is one call per period. Its first step is the
whole period, so that no time is spent on the search for a step. The right-hand side is our compiled
one.
"""

from functools import partial
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, ExternalLoad, compute_rate
from svsa.actuators.signals import State, Torque
from svsa.evaluation.timing.plant_problem import ANGLES, Problem, Solver, build_problem, solve
from svsa.evaluation.timing.turns import measure_in_turns
from svsa.numerics.compilation import compiled

OURS, SCIPY = "svsa", "scipy"
METHODS = ("RK45", "DOP853", "LSODA")
TOLERANCES = tuple(10.0**-decade for decade in range(3, 13))
"""Relative tolerances, the largest first; the absolute one is a hundredth of it."""
DURATION_S = 2.0
ROUNDING_RAD = 1e-12
"""Differences below this are rounding errors: the same method with the same step is as accurate in
any order of operations.
"""


class Comparison(NamedTuple):
    """The cost of a solver for the problem.

    Attributes:
        ratio: CPU time relative to ours.
        error_rad: Largest error of q, θ1, θ2 at the end of a period, relative to the exact
            solution, rad.
        setting: The method, and its tolerance or steps per period.
        cpu_us_per_period: CPU time, µs.
    """

    ratio: float
    error_rad: float
    setting: str
    cpu_us_per_period: float


class Candidate(NamedTuple):
    """A method of a solver at one setting, and its error, rad."""

    name: str
    setting: str
    solver: Solver
    error_rad: float


def compare_with_scipy(repeats: int, duration_s: float = DURATION_S) -> dict[str, Comparison]:
    """Measure our solver and scipy's on the same problem, alternately.

    Args:
        repeats: Number of repetitions; the minimum CPU time counts.
        duration_s: Length of the problem, s.

    Returns:
        By name our solver, first, and scipy.
    """
    problem = build_problem(duration_s)
    exact = solve_exactly(problem)
    own = partial(solve, problem)
    ours = Candidate(OURS, "RK4: 1", own, compute_error(own(), exact))
    alternatives = (find_tolerance(method, problem, exact, ours.error_rad) for method in METHODS)
    candidates = [ours, *(candidate for candidate in alternatives if candidate is not None)]
    costs = measure_in_turns(
        {f"{candidate.name} {candidate.setting}": candidate.solver for candidate in candidates},
        repeats,
    )
    comparisons: dict[str, Comparison] = {}
    for (name, setting, _, error), cost in zip(candidates, costs.values(), strict=True):
        ratio = cost / next(iter(costs.values()))
        if name not in comparisons or ratio < comparisons[name].ratio:
            each_us = 1e6 * cost / len(problem.forces)
            comparisons[name] = Comparison(ratio, error, setting, each_us)
    return comparisons


def find_tolerance(
    method: str, problem: Problem, exact: np.ndarray, error_rad: float
) -> Candidate | None:
    """Find the loosest tolerance of a method whose error is not above `error_rad`; None if none."""
    for tolerance in TOLERANCES:
        solver = partial(solve_by_scipy, problem, method, tolerance, problem.period)
        error = compute_error(solver(), exact)
        if error <= error_rad + ROUNDING_RAD:
            return Candidate(SCIPY, f"{method}: {tolerance:g}", solver, error)
    return None


def compute_error(states: np.ndarray, exact: np.ndarray) -> float:
    """Compute the largest difference of an angle, rad; `states` and `exact` are (periods, 6)."""
    return float(np.abs(states - exact)[:, ANGLES].max())


@compiled
def compute_held_rate(
    time: float, x: np.ndarray, actuator: Actuator, force: np.ndarray
) -> np.ndarray:
    """Compute ẋ, shape (6,), under constant torques on link, motor 1 and motor 2, N·m, (3,)."""
    state = State(x[0], x[1], x[2], x[3], x[4], x[5])
    torque, load = Torque(force[1], force[2]), ExternalLoad(force[0], 0.0, 0.0, 0.0, 0.0)
    rate = compute_rate(actuator, state, torque, load)
    return np.array((rate.q, rate.dq, rate.theta1, rate.dtheta1, rate.theta2, rate.dtheta2))


def solve_exactly(problem: Problem) -> np.ndarray:
    """Compute reference states, shape (periods, 6), as exact as double precision permits."""
    return solve_by_scipy(problem, "DOP853", 1e-13, 0.25 * problem.period)


def solve_by_scipy(problem: Problem, method: str, tolerance: float, step: float) -> np.ndarray:
    """Solve the problem by `solve_ivp`.

    Args:
        problem: The plant, its first state and its torques.
        method: Method of `solve_ivp`.
        tolerance: Relative tolerance; the absolute one is a hundredth of it.
        step: First and longest step, s.

    Returns:
        The states at the end of each period, (periods, 6).
    """
    from scipy.integrate import solve_ivp  # a slow import that other commands do not need

    x, states = problem.x, np.empty((len(problem.forces), len(problem.x)))
    for number, force in enumerate(problem.forces):
        x = states[number] = solve_ivp(
            compute_held_rate,
            (0.0, problem.period),
            x,
            method,
            args=(problem.actuator, force),
            rtol=tolerance,
            atol=0.01 * tolerance,
            first_step=step,
            max_step=step,
        ).y[:, -1]
    return states
