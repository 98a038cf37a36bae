"""The arm with series elastic joints against MuJoCo, which knows bodies and no equation of ours.

MuJoCo reads the file of `svsa export-model`: rotors are bodies, coupled to the links by springs.
"""

import numpy as np
import pytest

from svsa.actuators.arm.parameters import FOUR_RODS, MACCEPA_ARM
from svsa.actuators.signals import State, Torque
from svsa.analysis.exchange.robot_model import describe_robot
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.simulation.plant.loads.tip import TipForce

from .free_arm import build_arm, move

mujoco = pytest.importorskip("mujoco")

TICKS = 1000
FORCE = (1.5, -0.8)
TORQUES = (0.9, -0.6, 0.4, -0.2)
ANGLES, RATES = (0.4, -0.7, 0.5, -0.3), (1.0, -1.5, 0.8, -1.0)
BENT, ROTORS = (0.05, -0.1, 0.04, -0.03), (0.5, 2.0, -0.5, 1.0)
"""Deflections, and velocities of the motors, at the start."""


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    "links", [MACCEPA_ARM.changed(tip_mass_kg=0.15), FOUR_RODS.changed(tip_mass_kg=0.1)]
)
def test_second_of_the_arm_is_that_of_mujoco_to_1e_6(links):
    joints = len(links.chain)
    start = tuple(
        State(q, dq, q - phi, dtheta, 0.0, 0.0)
        for q, dq, phi, dtheta in zip(ANGLES, RATES, BENT, ROTORS, strict=True)
    )[:joints]
    blocks, inputs = build_arm(links, tip_loads=(TipForce(force_n=FORCE),), actuator="sea")
    torques = tuple(Torque(torque, 0.0) for torque in TORQUES[:joints])
    ours = move(blocks, inputs, start, TICKS, torques)
    arm = build_arm_experiment("rods", {"links": links}, {"actuator": "sea"})
    model = mujoco.MjModel.from_xml_string(describe_robot(arm))
    data = mujoco.MjData(model)
    data.qpos[:] = [*(x.q for x in start), *(x.theta1 for x in start)]
    data.qvel[:] = [*(x.dq for x in start), *(x.dtheta1 for x in start)]
    data.ctrl[:] = TORQUES[:joints]
    tip = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, "tip")
    data.xfrc_applied[tip, :3] = [FORCE[0], 0.0, FORCE[1]]
    theirs = [data.qpos.copy()]
    for _ in range(TICKS):
        mujoco.mj_step(model, data)
        theirs.append(data.qpos.copy())
    ours = np.array([[*(x.q for x in row), *(x.theta1 for x in row)] for row in ours])
    assert np.abs(ours - np.array(theirs)).max() < 1e-6
    assert np.ptp(ours, axis=0).min() > 0.1, "all angles must move"
