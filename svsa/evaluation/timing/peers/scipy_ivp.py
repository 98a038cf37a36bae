"""scipy's `solve_ivp`: one call a period, since the torque jumps there, its rate of ours compiled.

The first step tried is the whole period, so that none is lost on looking for it.
"""

from functools import partial

import numpy as np

from svsa.actuators.dynamics import Actuator, ExternalLoad, compute_rate
from svsa.actuators.signals import State, Torque
from svsa.evaluation.timing.peers.peer import Peer, Solver
from svsa.evaluation.timing.peers.problem import Problem
from svsa.numerics.compilation import compiled

TOLERANCES = tuple(10.0**-decade for decade in range(3, 13))


@compiled
def compute_held_rate(
    time: float, x: np.ndarray, actuator: Actuator, force: np.ndarray
) -> np.ndarray:
    """ẋ, (6,), of the state x under the torques on link, motor 1 and motor 2, N·m, (3,)."""
    state = State(x[0], x[1], x[2], x[3], x[4], x[5])
    torque, load = Torque(force[1], force[2]), ExternalLoad(force[0], 0.0, 0.0, 0.0, 0.0)
    rate = compute_rate(actuator, state, torque, load)
    return np.array((rate.q, rate.dq, rate.theta1, rate.dtheta1, rate.theta2, rate.dtheta2))


def build(problem: Problem, method: str, tolerance: float) -> Solver:
    """The solver by `solve_ivp` at a relative tolerance, the absolute one a hundredth of it."""
    return partial(solve, problem, method, tolerance, problem.period)


def solve_exactly(problem: Problem) -> np.ndarray:
    """The states as exact as doubles allow, by which all others are judged."""
    return solve(problem, "DOP853", 1e-13, 0.25 * problem.period)


def solve(problem: Problem, method: str, tolerance: float, step: float) -> np.ndarray:
    """The states at the end of each period; step: the first that is tried, and the longest, s."""
    from scipy.integrate import solve_ivp  # what only looks at the table need not wait for it

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


SCIPY = Peer("scipy", dict.fromkeys(("RK45", "DOP853", "LSODA"), TOLERANCES), build)
