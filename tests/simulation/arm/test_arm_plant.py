"""The coupled plant: energy, momentum, impulse, contact, order of the integrator."""

import numpy as np
import pytest

from svsa.actuators.arm.dynamics import Point, compute_mass_matrix, compute_tip_torque, turn
from svsa.actuators.arm.parameters import RODS
from svsa.actuators.dynamics import ExternalLoad
from svsa.actuators.signals import Torque
from svsa.simulation.arm.plant import compute_arm_rate
from svsa.simulation.plant.loads.tip import TipForce, TipImpulse, TipMass, Wall

from .free_arm import AT_REST, NO_LOAD, START, build_arm, compute_energy, move


@pytest.mark.exhaustive
def test_energy_is_kept_without_damping_and_its_drift_is_of_fourth_order():
    periods, drifts = np.array([0.004, 0.002, 0.001, 0.0005]), []
    for period in periods:
        blocks, inputs = build_arm(period=period, damped=False)
        states = move(blocks, inputs, START, round(0.2 / period))
        energies = np.array([compute_energy(blocks, x) for x in states])
        drifts.append(np.abs(energies / energies[0] - 1.0).max())
    assert drifts[2] < 1e-6
    assert np.polyfit(np.log(periods), np.log(drifts), 1)[0] > 3.8, drifts


@pytest.mark.exhaustive
@pytest.mark.long
def test_damping_loses_the_power_of_the_velocities():
    """Ė = −Σ (D q̇² + D1 θ̇1² + D2 θ̇2²)."""
    blocks, inputs = build_arm(period=1e-4)
    states = move(blocks, inputs, START, 2)
    power = 0.0
    for x, joint in zip(states[1], blocks.joints, strict=True):
        p = joint.plant
        power += p.D * x.dq**2 + p.D1 * x.dtheta1**2 + p.D2 * x.dtheta2**2
    lost = compute_energy(blocks, states[0]) - compute_energy(blocks, states[2])
    assert lost / 2e-4 == pytest.approx(power, rel=1e-3)


def compute_momentum(blocks, x):
    """∂T/∂q̇ of both links, N·m·s."""
    M = compute_mass_matrix(blocks.arm, turn((x[0].q, x[1].q)))
    return np.array(M) @ [x[0].dq, x[1].dq]


def test_momentum_about_joint_1_is_kept_in_the_horizontal_plane():
    """Nothing outside turns the arm: links and principal motor 1 exchange momentum only."""
    blocks, inputs = build_arm(RODS.changed(gravity_m_per_s2=0.0), damped=False)
    states = move(blocks, inputs, START, 300)
    B1 = blocks.joints[0].plant.B1
    totals = [compute_momentum(blocks, x)[0] + B1 * x[0].dtheta1 for x in states]
    alone = [compute_momentum(blocks, x)[0] for x in states]
    assert np.ptp(totals) < 1e-8
    assert np.ptp(alone) > 0.05, "the momentum of the links alone must change"


def test_tip_impulse_changes_the_generalized_momentum_by_its_joint_torques():
    impulse = TipImpulse(impulse_ns=(0.2, -0.1), start_s=0.001)
    blocks, inputs = build_arm(
        RODS.changed(gravity_m_per_s2=0.0), damped=False, tip_loads=(impulse,)
    )
    still = tuple(x._replace(dq=0.0, dtheta1=0.0, theta1=x.q) for x in START)
    states = move(blocks, inputs, still, 8)
    angles = turn((still[0].q, still[1].q))
    wanted = compute_tip_torque(blocks.arm, angles, Point(0.2, -0.1))
    # The springs take a part of it meanwhile, and the arm turns.
    assert compute_momentum(blocks, states[6]) == pytest.approx(np.array(wanted), rel=0.02)
    assert np.all(compute_momentum(blocks, states[1]) == 0.0)


def test_work_of_a_tip_force_equals_the_gain_in_energy():
    force = TipForce(force_n=(2.0, 1.0), duration_s=0.05)
    blocks, inputs = build_arm(damped=False, tip_loads=(force,))
    states = move(blocks, inputs, START, 60)
    l1, l2 = (link.length_m for link in RODS.chain)

    def compute_tip(x):
        p = x[0].q + x[1].q
        return np.array(
            [l1 * np.sin(x[0].q) + l2 * np.sin(p), -l1 * np.cos(x[0].q) - l2 * np.cos(p)]
        )

    work = np.dot((2.0, 1.0), compute_tip(states[50]) - compute_tip(states[0]))
    gained = compute_energy(blocks, states[50]) - compute_energy(blocks, states[0])
    assert gained == pytest.approx(work, abs=1e-6)
    assert compute_energy(blocks, states[60]) == pytest.approx(
        compute_energy(blocks, states[50]), rel=1e-7
    )


def test_tip_mass_load_equals_a_tip_mass_of_the_arm():
    blocks, inputs = build_arm(tip_loads=(TipMass(mass_kg=0.2),))
    other, others = build_arm(RODS.changed(tip_mass_kg=0.2))
    for x, y in zip(
        move(blocks, inputs, START, 50)[-1], move(other, others, START, 50)[-1], strict=True
    ):
        assert x == pytest.approx(y, abs=1e-13)


def test_wall_returns_the_energy_only_without_damping():
    """The tip hits a wall of 10 kN/m on its way up: the energy before is that after the contact."""
    kept = []
    for damping in (0.0, 20.0):
        wall = Wall(
            normal_rad=np.pi, distance_m=-0.12, stiffness_n_per_m=1e4, damping_ns_per_m=damping
        )
        blocks, inputs = build_arm(damped=False, period=2e-4, steps=4, tip_loads=(wall,))
        energies = [compute_energy(blocks, x) for x in move(blocks, inputs, START, 1500)]
        kept.append(energies[-1] / energies[0])
        assert min(energies) < 0.9 * energies[0], "the wall holds energy during the contact"
    assert kept[0] == pytest.approx(1.0, abs=1e-4)
    assert kept[1] < 0.97


def test_external_load_on_joint_2_accelerates_both_links():
    """An `ExternalLoad` on joint 2 accelerates both links as M⁻¹ (0, w) does."""
    blocks, inputs = build_arm()
    load, free, none = NO_LOAD._replace(w2=0.7), Point(0.0, 0.0), (AT_REST, AT_REST)

    def compute_accelerations(on2):
        loads = (ExternalLoad(*NO_LOAD), on2)
        rate = compute_arm_rate(blocks, blocks.arm, inputs.tip, 0, START, none, loads, free)
        return np.array([rate[0].dq, rate[1].dq])

    M = compute_mass_matrix(blocks.arm, turn((START[0].q, START[1].q)))
    change = compute_accelerations(load) - compute_accelerations(NO_LOAD)
    assert np.array(M) @ change == pytest.approx(np.array([0.0, 0.7]), abs=1e-12)


def test_motors_of_an_arm_accelerate_as_those_of_a_single_joint():
    blocks, inputs = build_arm()
    rate = compute_arm_rate(
        blocks,
        blocks.arm,
        inputs.tip,
        0,
        START,
        (Torque(1.5, -0.4), AT_REST),
        (NO_LOAD, NO_LOAD),
        Point(0.0, 0.0),
    )
    without = compute_arm_rate(
        blocks,
        blocks.arm,
        inputs.tip,
        0,
        START,
        (AT_REST, AT_REST),
        (NO_LOAD, NO_LOAD),
        Point(0.0, 0.0),
    )
    plant = blocks.joints[0].plant
    assert rate[0].dtheta1 - without[0].dtheta1 == pytest.approx(1.5 / plant.B1)
    assert rate[0].dtheta2 - without[0].dtheta2 == pytest.approx(-0.4 / plant.B2)
    assert rate[1] == without[1]
    assert rate[0].dq == without[0].dq
