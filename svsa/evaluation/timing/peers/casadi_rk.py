"""CasADi: Eq 1–5 as its expressions, its own Runge–Kutta integrator mapped over the periods.

Run by CasADi's virtual machine, and compiled from the C code that it writes.
"""

import contextlib
import tempfile
from importlib import import_module
from typing import Any

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.evaluation.timing.c_compiler import FLAGS, find_c_compiler
from svsa.evaluation.timing.peers.peer import Peer, Solver
from svsa.evaluation.timing.peers.problem import Problem

STEPS = (1, 2, 4, 8)
"""Steps a period."""
COMPILED = "rk, compiled"


def build(problem: Problem, method: str, steps: float) -> Solver:
    """The solver by so many Runge–Kutta steps a period."""
    casadi: Any = import_module("casadi")
    x, force = casadi.SX.sym("x", 6), casadi.SX.sym("force", 3)
    equations = {"x": x, "p": force, "ode": write_rate(casadi, problem.actuator, x, force)}
    options = {"number_of_finite_elements": int(steps), "simplify": True}
    period = casadi.integrator("period", "rk", equations, 0.0, problem.period, options)
    end = casadi.Function("end", [x, force], [period(x0=x, p=force)["xf"]])
    compiling = describe_compiler() if method == COMPILED else {}
    with tempfile.TemporaryDirectory(prefix="svsa-bench-") as folder, contextlib.chdir(folder):
        run = end.mapaccum("run", len(problem.forces), compiling)
    forces = problem.forces.T.copy()
    return lambda: np.asarray(run(problem.x, forces)).T


def write_rate(casadi: Any, actuator: Actuator, x: Any, force: Any) -> Any:
    """ẋ of Eq 1 with the energy-consistent τ_r as an expression of x, (6,), and force, (3,)."""
    a, (q, dq, theta1, dtheta1, theta2, dtheta2) = actuator, casadi.vertsplit(x)
    mu, c = a.mu0 + theta2 / (2.0 * np.pi * a.gamma), casadi.cos(q - theta1)
    n = 1.0 - mu * c
    torque = a.K * mu**2 * casadi.sin(q - theta1) * c / n**2
    reaction = a.K * mu * (1.0 / (1.0 - mu) ** 2 - c**2 / n**2) / (2.0 * np.pi * a.gamma)
    return casadi.vertcat(
        *(dq, (force[0] - a.D * dq - torque) / a.M),
        *(dtheta1, (force[1] - a.D1 * dtheta1 + torque) / a.B1),
        *(dtheta2, (force[2] - a.D2 * dtheta2 - reaction) / a.B2),
    )


def describe_compiler() -> dict[str, Any]:
    """CasADi's options that have a function compiled where we are, whose files it leaves there."""
    options = {"compiler": find_c_compiler(), "flags": list(FLAGS), "cleanup": False}
    return {"jit": True, "compiler": "shell", "jit_options": options, "jit_cleanup": False}


METHODS = ("rk", COMPILED) if find_c_compiler() else ("rk",)
CASADI = Peer("casadi", dict.fromkeys(METHODS, STEPS), build)
