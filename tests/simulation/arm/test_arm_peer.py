"""The arm with series elastic joints against MuJoCo, which knows bodies and no equation of ours.

In MuJoCo the rotors are separate bodies, coupled to the links by springs (tendons).
"""

import numpy as np
import pytest

from svsa.actuators.arm.parameters import MACCEPA_ARM
from svsa.actuators.signals import State, Torque
from svsa.simulation.plant.loads.tip import TipForce

from .free_arm import build_arm, move

mujoco = pytest.importorskip("mujoco")

ARM = MACCEPA_ARM.changed(tip_mass_kg=0.15)
FORCE = (1.5, -0.8)
TORQUE = (0.9, -0.6)
TICKS = 500
START = (
    State(0.4, 1.0, 0.35, 0.5, 0.0, 0.0),
    State(-0.7, -1.5, -0.6, 2.0, 0.0, 0.0),
)


def describe(joints):
    """The model. joints: the constants of both plants, and the stiffness of their springs."""
    (p1, k1), (p2, k2) = joints
    a = ARM
    # A body lies along −z from its joint; the axis −y makes growing q move it towards +x.
    return f"""
    <mujoco>
      <option timestep="0.001" integrator="RK4" gravity="0 0 {-a.gravity_m_per_s2}">
        <flag contact="disable"/>
      </option>
      <worldbody>
        <body name="link1">
          <joint name="q1" type="hinge" axis="0 -1 0" damping="{p1.D}"/>
          <inertial pos="0 0 {-a.center1_m}" mass="{a.mass1_kg}"
            diaginertia="{a.inertia1_kg_m2} {a.inertia1_kg_m2} 1e-6"/>
          <body name="link2" pos="0 0 {-a.length1_m}">
            <joint name="q2" type="hinge" axis="0 -1 0" damping="{p2.D}"/>
            <inertial pos="0 0 {-a.center2_m}" mass="{a.mass2_kg}"
              diaginertia="{a.inertia2_kg_m2} {a.inertia2_kg_m2} 1e-6"/>
            <body name="tip" pos="0 0 {-a.length2_m}">
              <inertial pos="0 0 0" mass="{a.tip_mass_kg}" diaginertia="1e-15 1e-15 1e-15"/>
            </body>
          </body>
        </body>
        <body name="rotor1"><joint name="t1" type="hinge" axis="0 -1 0" damping="{p1.D1}"/>
          <inertial pos="0 0 0" mass="1" diaginertia="{p1.B1} {p1.B1} {p1.B1}"/></body>
        <body name="rotor2"><joint name="t2" type="hinge" axis="0 -1 0" damping="{p2.D1}"/>
          <inertial pos="0 0 0" mass="1" diaginertia="{p2.B1} {p2.B1} {p2.B1}"/></body>
      </worldbody>
      <tendon>
        <fixed stiffness="{k1}" springlength="0">
          <joint joint="q1" coef="1"/><joint joint="t1" coef="-1"/></fixed>
        <fixed stiffness="{k2}" springlength="0">
          <joint joint="q2" coef="1"/><joint joint="t2" coef="-1"/></fixed>
      </tendon>
    </mujoco>"""


@pytest.mark.exhaustive
def test_half_a_second_of_the_arm_is_that_of_mujoco_to_1e_6():
    blocks, inputs = build_arm(ARM, tip_loads=(TipForce(force_n=FORCE),), actuator="sea")
    torques = Torque(TORQUE[0], 0.0), Torque(TORQUE[1], 0.0)
    ours = move(blocks, inputs, START, TICKS, torques)
    springs = [(one.plant, one.plant.e0) for one in (blocks.joint1, blocks.joint2)]
    model = mujoco.MjModel.from_xml_string(describe(springs))
    data = mujoco.MjData(model)
    data.qpos[:] = [START[0].q, START[1].q, START[0].theta1, START[1].theta1]
    data.qvel[:] = [START[0].dq, START[1].dq, START[0].dtheta1, START[1].dtheta1]
    data.qfrc_applied[2:] = TORQUE
    tip = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, "tip")
    data.xfrc_applied[tip, :3] = [FORCE[0], 0.0, FORCE[1]]
    theirs = [data.qpos.copy()]
    for _ in range(TICKS):
        mujoco.mj_step(model, data)
        theirs.append(data.qpos.copy())
    ours = np.array([[x1.q, x2.q, x1.theta1, x2.theta1] for x1, x2 in ours])
    assert np.abs(ours - np.array(theirs)).max() < 1e-6
    assert np.ptp(ours, axis=0).min() > 0.1, "all four angles must move"
