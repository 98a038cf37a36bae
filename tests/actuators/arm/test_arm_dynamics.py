"""M, C and g against Lagrange's equations of the links, derived from their energies by sympy."""

import math
from functools import cache

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from svsa.actuators.arm.dynamics import (
    Point,
    compute_arm_acceleration,
    compute_arm_energy,
    compute_arm_torque,
    compute_bias,
    compute_mass_matrix,
    compute_tip_position,
    compute_tip_torque,
    compute_tip_velocity,
    turn,
)
from svsa.actuators.arm.parameters import MACCEPA_ARM, RODS
from svsa.errors import ParameterError

ARM = MACCEPA_ARM.change_link(1, length_m=0.31).changed(tip_mass_kg=0.35)
angles = st.floats(-math.pi, math.pi)
speeds = st.floats(-8.0, 8.0)


@cache
def derive_torques():
    """τ(q, q̇, q̈) of two rigid bodies and a point mass, from d/dt ∂L/∂q̇ − ∂L/∂q."""
    t, p = sp.Symbol("t"), ARM
    q = [sp.Function(name)(t) for name in ("q1", "q2")]
    angle = [q[0], q[0] + q[1]]
    up = [sp.Matrix([sp.sin(a), -sp.cos(a)]) for a in angle]
    link1, link2 = p.chain
    elbow = link1.length_m * up[0]
    centers = [link1.center_m * up[0], elbow + link2.center_m * up[1]]
    places = [*centers, elbow + link2.length_m * up[1]]
    masses, lagrangian = [link1.mass_kg, link2.mass_kg, p.tip_mass_kg], 0
    for mass, place in zip(masses, places, strict=True):
        speed = place.diff(t)
        lagrangian += mass * speed.dot(speed) / 2 - mass * p.gravity_m_per_s2 * place[1]
    for inertia, a in zip([link1.inertia_kg_m2, link2.inertia_kg_m2], angle, strict=True):
        lagrangian += inertia * a.diff(t) ** 2 / 2
    torques = [lagrangian.diff(one.diff(t)).diff(t) - lagrangian.diff(one) for one in q]
    values = sp.symbols("a1 a2 v1 v2 x1 x2")
    orders = [one.diff(t, order) for order in (2, 1, 0) for one in q]
    replaced = [sp.sympify(one).subs(list(zip(orders, values, strict=True))) for one in torques]
    return sp.lambdify(values, replaced)


@given(angles, angles, speeds, speeds, speeds, speeds)
def test_equations_of_motion_match_lagrange_of_the_energies(q1, q2, dq1, dq2, ddq1, ddq2):
    arm, t, dq, ddq = ARM.build(), turn((q1, q2)), (dq1, dq2), (ddq1, ddq2)
    M, bias = compute_mass_matrix(arm, t), compute_bias(arm, t, dq)
    torque = tuple((np.array(M) @ ddq + bias).tolist())
    assert torque == pytest.approx(derive_torques()(ddq1, ddq2, dq1, dq2, q1, q2), abs=1e-11)
    assert torque == pytest.approx(compute_arm_torque(arm, t, dq, ddq), abs=1e-13)
    assert compute_arm_acceleration(arm, t, dq, torque) == pytest.approx(ddq, abs=1e-10)


@given(angles, angles, speeds, speeds)
def test_power_of_a_tip_force_equals_that_of_its_joint_torques(q1, q2, dq1, dq2):
    """f · v = τ · q̇ for the Jacobian, whose velocity is the derivative of the position."""
    arm, t, dq, force = ARM.build(), turn((q1, q2)), (dq1, dq2), Point(3.0, -2.0)
    velocity, torque = compute_tip_velocity(arm, t, dq), compute_tip_torque(arm, t, force)
    power = force.x * velocity.x + force.y * velocity.y
    assert power == pytest.approx(np.dot(torque, dq), abs=1e-11)
    h = 1e-6
    ends = [
        np.array(compute_tip_position(arm, turn((q1 + way * h * dq1, q2 + way * h * dq2))))
        for way in (1, -1)
    ]
    assert (ends[0] - ends[1]) / (2 * h) == pytest.approx(np.array(velocity), abs=1e-7)


def test_links_whose_mass_matrix_is_singular_are_rejected():
    """A link 2 without inertia about its joint, and two point masses, straight."""
    rod = RODS.chain[0]
    point, on_axis = rod.changed(inertia_kg_m2=0.0), rod.changed(center_m=0.0, inertia_kg_m2=0.0)
    for chain in ((rod, on_axis), (on_axis, point)):
        with pytest.raises(ParameterError, match=r"^chain\[1\]\.inertia_kg_m2 is 0\.0 kg·m²"):
            RODS.changed(chain=chain)
        arm = RODS.changed(chain=chain, tip_mass_kg=0.1).build()
        assert np.linalg.det(compute_mass_matrix(arm, turn((0.0, 0.0)))) > 1e-5


def test_hanging_arm_at_rest_has_zero_energy_and_zero_bias():
    arm, t, still = RODS.build(), turn((0.0, 0.0)), (0.0, 0.0)
    assert compute_arm_energy(arm, t, still) == 0.0
    assert compute_bias(arm, t, still) == (0.0, 0.0)
    lifted = turn((math.pi / 2, 0.0))
    m, length, g = 0.3, 0.3, 9.81
    assert compute_arm_energy(arm, lifted, still) == pytest.approx(2 * m * g * length)
    assert compute_bias(arm, lifted, still)[0] == pytest.approx(2 * m * g * length)
