"""Actuators and arms as models of other programs, read by MuJoCo."""

import numpy as np
import pytest

import svsa
from svsa.actuators.arm.parameters import RODS
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.definition.experiment import build_actuator_experiment
from svsa.runs.definition.shorthand import change_configuration

mujoco = pytest.importorskip("mujoco")


@pytest.mark.parametrize(
    ("actuator", "stiffness", "torque_nm", "share"),
    [("svsa", 10.0, 8.0, 0.01), ("maccepa", 2.5, 1.5, 0.002)],
)
def test_second_of_an_actuator_is_that_of_mujoco(actuator, stiffness, torque_nm, share):
    """The cubic spring differs from the true one. Motor 2 is heavy, so that it rests."""
    changes = {"stiffness": stiffness, "actuator": {"motor2_inertia_kg_m2": 10.0}}
    experiment = build_actuator_experiment(actuator, "fl", False)
    configuration = change_configuration(experiment, changes)
    ours = svsa.simulate(
        configuration,
        lambda t, reference, x, w: (torque_nm * np.sin(20.0 * t) - 0.05 * x.dtheta1, 0.0),
        duration_s=1.0,
    )
    model = mujoco.MjModel.from_xml_string(svsa.describe_robot(configuration))
    data, theirs = mujoco.MjData(model), []
    for torque in ours.torque1_nm:
        theirs.append(data.qpos.copy())
        data.ctrl[0] = torque
        mujoco.mj_step(model, data)
    angles = np.stack([ours.position_rad, ours.motor1_position_rad], axis=1)
    assert np.ptp(ours.deflection_rad) > 0.2, "the spring must bend"
    assert np.abs(np.array(theirs) - angles).max() < share * np.ptp(angles[:, 0])


def test_bodies_of_urdf_are_those_of_mjcf():
    links = {"links": RODS.changed(tip_mass_kg=0.2)}
    arm = build_arm_experiment("rods", links, {})
    models = [
        mujoco.MjModel.from_xml_string(svsa.describe_robot(arm, file_format))
        for file_format in ("mjcf", "urdf")
    ]
    torques = []
    for model in models:
        data, moved = mujoco.MjData(model), np.zeros(4)
        model.opt.gravity[:] = 0.0, 0.0, -9.81
        data.qpos[:], data.qvel[:] = (0.3, -1.1, 0.2, 0.1), (1.0, -2.0, 0.5, 0.7)
        mujoco.mj_forward(model, data)
        for unit in np.eye(4):
            mujoco.mj_mulM(model, data, moved, unit)
            torques.append(moved.copy())
        torques += [data.qfrc_bias.copy(), model.dof_damping]
    np.testing.assert_allclose(torques[:6], torques[6:], rtol=1e-8, atol=1e-12)


@pytest.mark.parametrize(("actuator", "torque_nm"), [("svsa", 15.0), ("qbmove", 12.0)])
def test_limit_of_u1_is_the_sum_of_both_motors_that_pull_against_each_other(actuator, torque_nm):
    text = svsa.describe_robot(build_actuator_experiment(actuator, "fl", False))
    model = mujoco.MjModel.from_xml_string(text)
    assert model.actuator_ctrlrange.tolist() == [[-torque_nm, torque_nm]]
