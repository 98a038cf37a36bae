"""numbalsoda: LSODA and DOP853 called from compiled code, a call a period, its rate of ours.

Nothing of Python runs between the periods, where scipy's `solve_ivp` is slow.
"""

from functools import partial
from importlib import import_module
from typing import Any

import numba
import numpy as np
from numba.np.numpy_support import carray

from svsa.actuators.dynamics import Actuator, ExternalLoad, compute_rate
from svsa.actuators.signals import State, Torque
from svsa.evaluation.timing.peers.peer import Peer, Solver
from svsa.evaluation.timing.peers.problem import Problem
from svsa.evaluation.timing.peers.scipy_ivp import TOLERANCES


def build(problem: Problem, method: str, tolerance: float) -> Solver:
    """The solver by a method at a relative tolerance, the absolute one a hundredth of it."""
    package: Any = import_module("numbalsoda")
    rate = compile_rate(package, problem.actuator)
    run = compile_periods(getattr(package, method.lower()), rate.address)
    return partial(run, problem.x, problem.forces, problem.period, tolerance)


def compile_rate(package: Any, actuator: Actuator) -> Any:
    """ẋ of the state x, (6,), under the torques on link, motor 1 and motor 2, N·m, (3,), as C's."""

    @numba.cfunc(package.lsoda_sig)
    def compute(time, x_address, rate_address, force_address):  # noqa: ANN001, ANN202
        x, force = carray(x_address, 6), carray(force_address, 3)
        state = State(x[0], x[1], x[2], x[3], x[4], x[5])
        torque, load = Torque(force[1], force[2]), ExternalLoad(force[0], 0.0, 0.0, 0.0, 0.0)
        rate = compute_rate(actuator, state, torque, load)
        rates = carray(rate_address, 6)
        rates[0], rates[1], rates[2] = rate.q, rate.dq, rate.theta1
        rates[3], rates[4], rates[5] = rate.dtheta1, rate.theta2, rate.dtheta2

    return compute


def compile_periods(solve: Any, rate: int) -> Any:
    """The states at the end of each period, (periods, 6), by numbalsoda's `solve`."""

    @numba.njit
    def run(x, forces, period, tolerance):  # noqa: ANN001, ANN202
        ends, states = np.array((0.0, period)), np.empty((len(forces), len(x)))
        for number in range(len(forces)):
            solved, _ = solve(rate, x, ends, forces[number], rtol=tolerance, atol=0.01 * tolerance)
            x = states[number] = solved[-1]
        return states

    return run


NUMBALSODA = Peer("numbalsoda", dict.fromkeys(("LSODA", "DOP853"), TOLERANCES), build)
