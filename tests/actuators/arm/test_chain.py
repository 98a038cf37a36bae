"""Arms of one to four links: MuJoCo, energy balance, the single actuator."""

import numpy as np
import pytest

from svsa.actuators.arm.dynamics import (
    Arm,
    Link,
    Point,
    add_tip_mass,
    build_arm,
    compute_arm_acceleration,
    compute_arm_energy,
    compute_mass_matrix,
    compute_tip_position,
    compute_tip_torque,
    compute_tip_velocity,
    turn,
)
from svsa.actuators.arm.motion import Motion
from svsa.actuators.dynamics import ExternalLoad, InternalTorque, accelerate
from svsa.actuators.signals import State, Torque
from svsa.control.arm_feedforward import compute_torques_along
from svsa.numerics.compilation import compiled
from svsa.numerics.fields import full_like, replace_item
from svsa.runs.definition.paper import get_figure
from svsa.runs.execution.run import Run
from svsa.simulation.arm.contact import compute_least_tip_mass

mujoco = pytest.importorskip("mujoco")

GRAVITY, TIP_MASS, NUMBERS, STATES = 9.81, 0.15, (1, 2, 3, 4), 100
FORCE = Point(1.5, -0.8)
LINKS = (
    Link(0.31, 0.8, 0.14, 0.009),
    Link(0.27, 0.5, 0.11, 0.004),
    Link(0.22, 0.4, 0.13, 0.003),
    Link(0.18, 0.2, 0.07, 0.001),
)


def build(number):
    """An arm of the first links, with a mass at its tip."""
    return add_tip_mass(build_arm(LINKS[:number], GRAVITY), TIP_MASS)


@compiled
def accelerate_arm(arm, q, dq, torque, force):
    """q̈ under joint torques and a force at the tip."""
    t = turn(q)
    total = compute_tip_torque(arm, t, force)
    for j in range(len(q)):
        total = replace_item(total, j, total[j] + torque[j])
    return compute_arm_acceleration(arm, t, dq, total)


@compiled
def evaluate(arm: Arm, q, dq, torque, force):
    """q̈, the torques τ_d along a motion with this q̈, M, and position and velocity of the tip."""
    t, ddq = turn(q), accelerate_arm(arm, q, dq, torque, force)
    motions = full_like(q, Motion(0.0, 0.0, 0.0, 0.0, 0.0))
    for j in range(len(q)):
        motions = replace_item(motions, j, Motion(q[j], dq[j], ddq[j], 0.0, 0.0))
    along = full_like(q, 0.0)
    for j, torques in enumerate(compute_torques_along(arm, motions)):
        along = replace_item(along, j, torques[0])
    tip, velocity = compute_tip_position(arm, t), compute_tip_velocity(arm, t, dq)
    return ddq, along, compute_mass_matrix(arm, t), tip, velocity


@compiled
def move(arm: Arm, q, dq, torque, force, ticks, step):
    """Angles, speeds and the energy before and after, of Runge–Kutta steps of order 4."""
    before = compute_arm_energy(arm, turn(q), dq)
    for _ in range(ticks):
        at, rate, next_q, next_dq = q, dq, q, dq
        for share, weight in ((0.5, 1.0), (0.5, 2.0), (1.0, 2.0), (0.0, 1.0)):
            ddq = accelerate_arm(arm, at, rate, torque, force)
            for j in range(len(q)):
                next_q = replace_item(next_q, j, next_q[j] + step * weight / 6.0 * rate[j])
                next_dq = replace_item(next_dq, j, next_dq[j] + step * weight / 6.0 * ddq[j])
                at = replace_item(at, j, q[j] + step * share * rate[j])
                rate = replace_item(rate, j, dq[j] + step * share * ddq[j])
        q, dq = next_q, next_dq
    return q, before, compute_arm_energy(arm, turn(q), dq)


def build_peer(number):
    """Nested bodies with a hinge each: q turns a hanging link towards +x."""
    head = f'<mujoco><option gravity="0 0 {-GRAVITY}"/><worldbody>'
    body, place = "", 0.0
    for length, mass, center, inertia in LINKS[:number]:
        body += (
            f'<body pos="0 0 {-place}"><joint type="hinge" axis="0 -1 0"/>'
            f'<inertial pos="0 0 {-center}" mass="{mass}"'
            f' diaginertia="{inertia} {inertia} {inertia}"/>'
        )
        place = length
    tip = (
        f'<body name="tip" pos="0 0 {-place}"><inertial pos="0 0 0" mass="{TIP_MASS}"'
        ' diaginertia="1e-12 1e-12 1e-12"/></body>'
    )
    text = f"{head}{body}{tip}{'</body>' * number}</worldbody></mujoco>"
    model = mujoco.MjModel.from_xml_string(text)
    return model, mujoco.MjData(model)


@pytest.mark.parametrize("number", NUMBERS)
def test_dynamics_match_mujoco_at_random_states(number):
    """q̈, M, the torques of the motion, position and velocity of the tip."""
    arm, (model, data) = build(number), build_peer(number)
    random, M = np.random.default_rng(number), np.empty((number, number))
    tip = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, "tip")
    data.xfrc_applied[tip, :3] = [FORCE.x, 0.0, FORCE.y]
    for _ in range(STATES):
        q, dq, torque = (random.uniform(-most, most, number) for most in (np.pi, 8.0, 5.0))
        data.qpos[:], data.qvel[:], data.qfrc_applied[:] = q, dq, torque
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, M)
        ddq, along, matrix, at, velocity = evaluate(
            arm, *(tuple(values.tolist()) for values in (q, dq, torque)), FORCE
        )
        assert np.array(matrix) == pytest.approx(M, abs=1e-11)
        assert ddq == pytest.approx(data.qacc, rel=1e-8, abs=1e-8)
        mujoco.mj_inverse(model, data)
        assert along == pytest.approx(data.qfrc_inverse, rel=1e-9, abs=1e-9)
        x, _, y = data.xpos[tip]
        assert at == pytest.approx((x, y), abs=1e-12)
        speed = np.empty(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, tip, speed, 0)
        assert velocity == pytest.approx((speed[3], speed[5]), abs=1e-11)


@pytest.mark.parametrize("number", NUMBERS)
def test_energy_of_a_second_changes_by_the_work_of_torques_and_force(number):
    """Without damping."""
    arm, torque = build(number), (0.9, -0.6, 0.4, -0.2)[:number]
    start, rates = (0.9, -0.5, 0.7, 0.3)[:number], (1.0, -2.0, 1.5, 0.5)[:number]
    end, before, after = move(arm, start, rates, torque, FORCE, 4000, 0.00025)
    moved = np.subtract(*(compute_tip_position(arm, turn(q)) for q in (end, start)))
    work = np.dot(FORCE, moved) + np.dot(torque, np.subtract(end, start))
    assert after - before == pytest.approx(work, abs=1e-8)
    assert abs(work) > 0.01


def test_joint_of_one_link_accelerates_as_a_single_actuator():
    """To the bit: M, the gravity of the link and its torque are those of a mass on the link."""
    arm, run = build(1), Run(get_figure("4a").build_configuration("ndobc"))
    (inertia,), (weight,) = arm.inertia[0], arm.weights
    actuator = run.blocks[0].plant._replace(M=inertia)
    for q, dq, torque in np.random.default_rng(1).uniform(-3.0, 3.0, (20, 3)).tolist():
        x, F = State(q, dq, 0.0, 0.0, 0.0, 0.0), InternalTorque(torque, 0.0, 0.0)
        load = ExternalLoad(0.0, 0.0, 0.0, 0.0, weight)
        alone = accelerate(actuator, x, F, Torque(0.0, 0.0), load).ddq
        assert compute_arm_acceleration(arm, turn((q,)), (dq,), (torque,)) == (alone,)


@pytest.mark.parametrize("number", NUMBERS)
def test_least_tip_mass_is_that_of_the_inverse_of_the_mass_matrix(number):
    arm, random, masses = build(number), np.random.default_rng(number), []
    for _ in range(300):
        t = turn(tuple(random.uniform(-np.pi, np.pi, number).tolist()))
        forces = Point(1.0, 0.0), Point(0.0, 1.0)
        J = np.array([compute_tip_torque(arm, t, force) for force in forces])
        mobility = J @ np.linalg.solve(compute_mass_matrix(arm, t), J.T)
        masses.append(1.0 / np.linalg.eigvalsh(mobility)[1])
    assert 0.9 * min(masses) < compute_least_tip_mass(arm) <= min(masses) * (1.0 + 1e-3)
