"""The problem of the comparison with scipy: the plant of a run under that run's torques.

Each torque is constant for a period. The loop is open, so that only the solvers are compared and no
law: the torques are those that the paper's law commanded in Figure 4A, from before the load to well
after it.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.actuators.signals import CHANNEL_INDEX, TORQUES, State, Torque
from svsa.analysis.design.linear_model import STATES
from svsa.numerics.borrowed import borrow
from svsa.numerics.compilation import compiled
from svsa.runs.definition.paper import LOAD_TIME_S, get_figure
from svsa.runs.execution.run import Run
from svsa.runs.result.simulate import simulate
from svsa.simulation.plant.effects import EffectConstants
from svsa.simulation.plant.integration import integrate_period
from svsa.simulation.plant.load_table import LoadTable, compute_load

FIGURE, LAW = "4a", "ndobc"
COLUMNS = [CHANNEL_INDEX[name] for name in STATES]
ANGLES = [0, 2, 4]
"""Indices of q, θ1, θ2 in a state."""
Solver = Callable[[], np.ndarray]
"""Solves one problem; returns the states at the end of each period, (periods, 6)."""


class Problem(NamedTuple):
    """The plant from one state on, period after period.

    Attributes:
        actuator: Actuator of the plant.
        effects: Effects of the plant.
        loads: Loads on the plant.
        first: Tick of the first state.
        period: T, s.
        x: First state, shape (6,).
        torques: Torques of the motors, N·m, constant for a period, shape (periods, 2).
        forces: Torques and loads on link, motor 1 and motor 2, N·m, constant for a period, shape
            (periods, 3).
    """

    actuator: Actuator
    effects: EffectConstants
    loads: LoadTable
    first: int
    period: float
    x: np.ndarray
    torques: np.ndarray
    forces: np.ndarray


def build_problem(duration_s: float) -> Problem:
    """Build the problem over `duration_s`, with the load in its middle."""
    run = Run(get_figure(FIGURE).build_configuration(LAW))
    first = round((LOAD_TIME_S - 0.5 * duration_s) / run.period_s)
    samples = simulate(FIGURE, LAW, duration_s=LOAD_TIME_S + 0.5 * duration_s).samples[first:]
    torques = samples[:, TORQUES].copy()
    loads = [
        compute_load(run.inputs.loads, tick, run.period_s, tick * run.period_s)
        for tick in range(first, first + len(samples))
    ]
    forces = np.array([(load.w2, load.w4, load.w6) for load in loads])
    forces[:, 1:] += torques
    blocks = run.blocks[0]
    return Problem(
        blocks.plant,
        blocks.effects,
        run.inputs.loads,
        first,
        run.period_s,
        samples[0, COLUMNS],
        torques,
        forces,
    )


@compiled
def integrate(problem: Problem, steps: int, states: np.ndarray) -> None:
    """Integrate the plant by several Runge–Kutta steps per period, into states (periods, 6)."""
    p, rows, torques = problem, borrow(states), borrow(problem.torques)
    loads = LoadTable(borrow(p.loads.rows), borrow(p.loads.points), p.loads.changing)
    x = State(p.x[0], p.x[1], p.x[2], p.x[3], p.x[4], p.x[5])
    for i in range(len(rows)):
        u = Torque(torques[i, 0], torques[i, 1])
        x = integrate_period(p.actuator, p.effects, x, u, u, loads, p.first + i, p.period, steps)
        rows[i] = x


def solve(problem: Problem, steps: int = 1) -> np.ndarray:
    """Solve the problem by `steps` Runge–Kutta steps per period; a run takes one.

    Returns:
        The states at the end of each period, shape (periods, 6).
    """
    states = np.empty((len(problem.torques), len(STATES)))
    integrate(problem, steps, states)
    return states
