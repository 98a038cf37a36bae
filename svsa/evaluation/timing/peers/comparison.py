"""The plant solved by others as exactly as here: what it costs them, by what it costs us.

Each method has the least accurate of its settings whose error is no larger than ours, and each peer
the cheapest of its methods. By CPU time, the least of many, in turns.
"""

from functools import partial
from importlib.util import find_spec
from typing import NamedTuple

import numpy as np

from svsa.evaluation.timing.peers.casadi_rk import CASADI
from svsa.evaluation.timing.peers.mujoco_rk4 import MUJOCO
from svsa.evaluation.timing.peers.numbalsoda_ivp import NUMBALSODA
from svsa.evaluation.timing.peers.peer import Solver
from svsa.evaluation.timing.peers.problem import ANGLES, Problem, build_problem, solve
from svsa.evaluation.timing.peers.scipy_ivp import SCIPY, solve_exactly
from svsa.evaluation.timing.turns import measure_in_turns

PEERS = {"scipy": SCIPY, "numbalsoda": NUMBALSODA, "casadi": CASADI, "mujoco": MUJOCO}
OURS = "svsa"
DURATION_S = 2.0
ROUNDING_RAD = 1e-12
"""The same method at the same step is as accurate, whatever the order of its operations."""


class Comparison(NamedTuple):
    """What the problem costs somebody.

    ratio: to our CPU time. error_rad: the greatest of q, θ1, θ2 at the end of a period, against
    the exact solution. setting: the method, and its tolerance or steps a period.
    cpu_us_per_period: CPU time, µs.
    """

    ratio: float
    error_rad: float
    setting: str
    cpu_us_per_period: float


class Candidate(NamedTuple):
    """A method of somebody's at one setting, and the error that it has, rad."""

    name: str
    setting: str
    solver: Solver
    error_rad: float


def measure_peers(repeats: int, duration_s: float = DURATION_S) -> dict[str, Comparison]:
    """By name ourselves, first, and every peer that is installed and gets as exact."""
    problem = build_problem(duration_s)
    exact = solve_exactly(problem)
    own = partial(solve, problem)
    ours = Candidate(OURS, "RK4: 1", own, compute_error(own(), exact))
    candidates = [ours]
    for name, peer in PEERS.items():
        if find_spec(peer.package) is not None:
            for method in peer.methods:
                candidates += find_setting(name, method, problem, exact, ours.error_rad)
    costs = measure_in_turns(
        {f"{each.name} {each.setting}": each.solver for each in candidates}, repeats
    )
    comparisons: dict[str, Comparison] = {}
    for (name, setting, _, error), cost in zip(candidates, costs.values(), strict=True):
        ratio = cost / next(iter(costs.values()))
        if name not in comparisons or ratio < comparisons[name].ratio:
            each_us = 1e6 * cost / len(problem.forces)
            comparisons[name] = Comparison(ratio, error, setting, each_us)
    return comparisons


def find_setting(
    name: str, method: str, problem: Problem, exact: np.ndarray, error_rad: float
) -> list[Candidate]:
    """The first setting of a peer's method whose error is no larger; none where none is."""
    for setting in PEERS[name].methods[method]:
        solver = PEERS[name].build(problem, method, setting)
        error = compute_error(solver(), exact)
        if error <= error_rad + ROUNDING_RAD:
            return [Candidate(name, f"{method}: {setting:g}", solver, error)]
    return []


def compute_error(states: np.ndarray, exact: np.ndarray) -> float:
    """The greatest difference of an angle, rad; states, exact: (periods, 6)."""
    return float(np.abs(states - exact)[:, ANGLES].max())
