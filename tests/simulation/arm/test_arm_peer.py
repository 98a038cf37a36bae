"""The arm with series elastic joints against MuJoCo, which knows bodies and no equation of ours.

MuJoCo reads the file of `svsa export-model`: rotors are bodies, coupled to the links by springs.
"""

import numpy as np
import pytest

from svsa.actuators.arm.parameters import MACCEPA_ARM
from svsa.actuators.signals import State, Torque
from svsa.analysis.exchange.robot_model import describe_robot
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.simulation.plant.loads.tip import TipForce

from .free_arm import build_arm, move

mujoco = pytest.importorskip("mujoco")

ARM = MACCEPA_ARM.changed(tip_mass_kg=0.15)
FORCE = (1.5, -0.8)
TORQUE = (0.9, -0.6)
TICKS = 1000
START = (
    State(0.4, 1.0, 0.35, 0.5, 0.0, 0.0),
    State(-0.7, -1.5, -0.6, 2.0, 0.0, 0.0),
)


@pytest.mark.exhaustive
def test_second_of_the_arm_is_that_of_mujoco_to_1e_6():
    blocks, inputs = build_arm(ARM, tip_loads=(TipForce(force_n=FORCE),), actuator="sea")
    torques = Torque(TORQUE[0], 0.0), Torque(TORQUE[1], 0.0)
    ours = move(blocks, inputs, START, TICKS, torques)
    arm = build_arm_experiment("rods", {"links": ARM}, {"actuator": "sea"})
    model = mujoco.MjModel.from_xml_string(describe_robot(arm))
    data = mujoco.MjData(model)
    data.qpos[:] = [START[0].q, START[1].q, START[0].theta1, START[1].theta1]
    data.qvel[:] = [START[0].dq, START[1].dq, START[0].dtheta1, START[1].dtheta1]
    data.ctrl[:] = TORQUE
    tip = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, "tip")
    data.xfrc_applied[tip, :3] = [FORCE[0], 0.0, FORCE[1]]
    theirs = [data.qpos.copy()]
    for _ in range(TICKS):
        mujoco.mj_step(model, data)
        theirs.append(data.qpos.copy())
    ours = np.array([[x1.q, x2.q, x1.theta1, x2.theta1] for x1, x2 in ours])
    assert np.abs(ours - np.array(theirs)).max() < 1e-6
    assert np.ptp(ours, axis=0).min() > 0.1, "all four angles must move"
