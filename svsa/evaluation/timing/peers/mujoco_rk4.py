"""MuJoCo: link and motors as three hinges, by its Runge–Kutta integrator of order 4.

Its own springs know neither a lever ratio that another joint moves nor Eq 2: the torques of the
spring, ours compiled, come from a callback in Python, four times a step, which is more
than half of what it costs here.
"""

from importlib import import_module
from typing import Any

import numpy as np

from svsa.actuators.dynamics import Actuator, compute_internal_torque
from svsa.actuators.signals import State
from svsa.evaluation.timing.peers.peer import Peer, Solver
from svsa.evaluation.timing.peers.problem import Problem
from svsa.numerics.compilation import compiled

STEPS = (1, 2, 4, 8)
"""Steps a period."""
MODEL = """
<mujoco>
  <option timestep="{step!r}" integrator="RK4" gravity="0 0 0">
    <flag contact="disable" constraint="disable"/>
  </option>
  <worldbody>{bodies}</worldbody>
</mujoco>
"""
BODY = """
<body>
  <joint type="hinge" axis="0 0 1" damping="{damping!r}"/>
  <inertial pos="0 0 0" mass="1" diaginertia="{inertia!r} {inertia!r} {inertia!r}"/>
</body>
"""


@compiled
def add_spring(actuator: Actuator, angles: np.ndarray, torques: np.ndarray) -> None:
    """Add τ_e and τ_r at q, θ1, θ2, rad, (3,), to the torques on them, N·m, (3,)."""
    F = compute_internal_torque(actuator, State(angles[0], 0.0, angles[1], 0.0, angles[2], 0.0))
    torques[0] += F.link
    torques[1] += F.motor1
    torques[2] += F.motor2


def build(problem: Problem, method: str, steps: float) -> Solver:
    """The solver by so many steps a period; the method is the one that there is."""
    mujoco: Any = import_module("mujoco")
    a, count = problem.actuator, int(steps)
    inertias, dampings = (a.M, a.B1, a.B2), (a.D, a.D1, a.D2)
    bodies = [
        BODY.format(inertia=inertia, damping=damping)
        for inertia, damping in zip(inertias, dampings, strict=True)
    ]
    written = MODEL.format(step=problem.period / count, bodies="".join(bodies))
    model = mujoco.MjModel.from_xml_string(written)
    data = mujoco.MjData(model)

    def add_spring_of(_: Any, data: Any) -> None:
        add_spring(a, data.qpos, data.qfrc_passive)

    def solve() -> np.ndarray:
        states = np.empty((len(problem.forces), len(problem.x)))
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.qvel[:] = problem.x[::2], problem.x[1::2]
        mujoco.set_mjcb_passive(add_spring_of)
        try:
            for state, force in zip(states, problem.forces, strict=True):
                data.qfrc_applied[:] = force
                mujoco.mj_step(model, data, count)
                state[::2], state[1::2] = data.qpos, data.qvel
        finally:
            mujoco.set_mjcb_passive(None)
        return states

    return solve


MUJOCO = Peer("mujoco", {"RK4": STEPS}, build)
