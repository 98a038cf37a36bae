"""The force of a wall on the tip, recomputed from the samples of a run."""

import math
import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import svsa
from svsa.actuators.signals import CHANNEL_INDEX, State
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.definition.command import ApplyLoad, RemoveLoad
from svsa.runs.execution.arm_run import ArmRun
from svsa.runs.result.arm import ArmResult
from svsa.runs.session.simulated import SimulatedSession
from tests.simulation.arm.free_arm import UNDAMPED, compute_energy

PERIOD_S = 0.0005


def collide(direction, sigma, wall_n_per_m, damping):
    """The tip moves along x by 0.4 m in 0.8 s, and hits the wall 0.1 m before the end."""
    wall = svsa.Wall(
        normal_rad=math.pi if direction > 0 else 0.0,
        distance_m=-0.1,
        stiffness_n_per_m=wall_n_per_m,
        damping_ns_per_m=damping,
    )
    move = svsa.TipMove(
        start_m=(-0.2 * direction, -0.4), end_m=(0.2 * direction, -0.4), duration_s=0.8
    )
    return svsa.simulate_arm(
        law="pd", actuator=UNDAMPED, sampling={"period_s": PERIOD_S}, steps=4, stiffness=sigma,
        tip=move, tip_loads=[wall], duration_s=1.2,
    )  # fmt: skip


CASES = {
    "direction": st.sampled_from([1, -1]),
    "sigma": st.floats(15.0, 140.0),
    "wall_n_per_m": st.floats(500.0, 5000.0),
}


@pytest.mark.long
@given(**CASES, damping=st.sampled_from([0.0, 5.0, 20.0]))
def test_wall_never_pulls_and_never_acts_before_contact(direction, sigma, wall_n_per_m, damping):
    result = collide(direction, sigma, wall_n_per_m, damping)
    force, depth = result.wall_force_n, direction * result.tip_position_m[:, 0] - 0.1
    assert np.all(-direction * force[:, 0] >= 0.0)
    assert np.abs(force[:, 1]).max() <= 1e-12 * np.abs(force[:, 0]).max()
    assert np.all(force[depth <= 0.0] == 0.0)
    assert np.abs(force).max() > 1.0, "the tip must reach the wall"


@pytest.mark.exhaustive
@given(**CASES)
def test_energy_changes_by_the_work_of_wall_and_motors(direction, sigma, wall_n_per_m):
    """Without damping of actuators and wall: motors work by u Δθ in each period, exactly."""
    result = collide(direction, sigma, wall_n_per_m, 0.0)
    blocks = ArmRun(result.configuration).arms[0]
    states = [read_states(joint) for joint in result.joints]
    energy = np.array(
        [compute_energy(blocks, (State(*x1), State(*x2))) for x1, x2 in zip(*states, strict=True)]
    )
    by_motors = sum(
        joint.torque1_nm[:-1] * np.diff(x[:, 2]) + joint.torque2_nm[:-1] * np.diff(x[:, 4])
        for joint, x in zip(result.joints, states, strict=True)
    )
    force, moved = result.wall_force_n, np.diff(result.tip_position_m, axis=0)
    by_wall = np.einsum("tk,tk->t", 0.5 * (force[1:] + force[:-1]), moved)
    left = energy - energy[0] - np.append(0.0, np.cumsum(by_motors + by_wall))
    taken = np.abs(np.cumsum(by_wall)).max()
    assert taken > 1e-3
    # The work of the wall is a sum over periods: its error at the onset is of first order.
    assert np.abs(left).max() < 1e-2 * taken


def read_states(joint):
    """The true states, (ticks, 6)."""
    return np.stack(
        [
            joint.position_rad,
            joint.velocity_rad_per_s,
            joint.motor1_position_rad,
            joint.motor1_velocity_rad_per_s,
            joint.motor2_position_rad,
            joint.motor2_velocity_rad_per_s,
        ],
        axis=1,
    )


def test_elastic_wall_returns_the_absorbed_energy():
    """Work of the wall up to each sample: −½ k depth²."""
    result = collide(1, 40.0, 2000.0, 0.0)
    depth = np.maximum(result.tip_position_m[:, 0] - 0.1, 0.0)
    force, moved = result.wall_force_n, np.diff(result.tip_position_m, axis=0)
    work = np.append(0.0, np.cumsum(np.einsum("tk,tk->t", 0.5 * (force[1:] + force[:-1]), moved)))
    assert work == pytest.approx(-0.5 * 2000.0 * depth**2, abs=1e-3 * np.abs(work).max())


MOVE = svsa.TipMove(start_m=(-0.2, -0.4), end_m=(0.2, -0.4), duration_s=1.2)
HARD = svsa.Wall(normal_rad=math.pi, distance_m=-0.1, stiffness_n_per_m=2000.0)


def hold(wall, steps=1):
    """Mean force and its deviation in the last 0.5 s, while the tip leans on the wall."""
    result = svsa.simulate_arm(law="pd", tip=MOVE, tip_loads=[wall], steps=steps, duration_s=3.0)
    force = -result.wall_force_n[-500:, 0]
    return force.mean(), force.std()


def test_damping_that_the_steps_cannot_follow_is_rejected():
    """1000 N·s/m would hold 5 N in place of 25 N: the tip rebounds at every step."""
    wall = HARD.changed(damping_ns_per_m=1000.0)
    with pytest.raises(svsa.ParameterError, match=r"^damping_ns_per_m is 1000.*at most 228"):
        hold(wall)
    with pytest.raises(svsa.ParameterError, match="at most 228"):
        hold(wall.changed(start_s=1.0))
    mean, deviation = hold(wall, steps=5)
    assert mean == pytest.approx(24.7, abs=0.1) and deviation < 0.1


def test_stiffness_that_the_steps_cannot_follow_is_rejected():
    coarse = {"sampling": {"period_s": 0.004}, "duration_s": 0.01, "tip": MOVE}
    wall = HARD.changed(stiffness_n_per_m=1e5)
    with pytest.raises(svsa.ParameterError, match=r"^stiffness_n_per_m is 100000.*at most 3\.69"):
        svsa.simulate_arm(tip_loads=[wall], **coarse)


def test_largest_damping_is_followed():
    mean, deviation = hold(HARD.changed(damping_ns_per_m=225.0))
    assert mean == pytest.approx(24.74, abs=0.01) and deviation < 1e-3


def test_wall_force_is_zero_without_a_wall():
    result = svsa.simulate_arm(tip_loads=[svsa.TipForce(force_n=(1.0, 0.0))], duration_s=0.01)
    assert result.wall_force_n.shape == (10, 2)
    assert not result.wall_force_n.any()


def test_impulse_removed_before_it_acts_does_not_disturb_the_force_of_the_wall():
    """An impulse divides by its duration, which is zero here."""
    wall = svsa.Wall(normal_rad=0.0, distance_m=5.0, stiffness_n_per_m=1.0)
    session = SimulatedSession("lab", build_arm_experiment("rods", {}, {}, tip_loads=[wall]))
    session.step(5)
    session.change(ApplyLoad(argument=svsa.TipImpulse(impulse_ns=(0.05, 0.0))))
    session.change(RemoveLoad(argument=2))
    session.step(5)
    journal = session.journal
    rows = journal.history.read(0, 1, list(CHANNEL_INDEX.values()), [0, 1]).transpose(1, 0, 2)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        force = ArmResult(journal.initial, rows, commands=tuple(journal.commands)).wall_force_n
    assert np.all(force[:, 0] > 1.0)


def test_wall_acts_from_its_onset():
    wall = svsa.Wall(normal_rad=0.0, distance_m=5.0, stiffness_n_per_m=1.0, start_s=0.004)
    force = svsa.simulate_arm(tip_loads=[wall], duration_s=0.01).wall_force_n
    assert not force[:4].any()
    assert np.all(force[4:, 0] > 1.0)
