"""The mass of the tip in its lightest direction, and the walls that the integration can follow."""

import math

import numpy as np
import pytest

from svsa.actuators.arm.dynamics import compute_mass_matrix, turn
from svsa.actuators.arm.parameters import MACCEPA_ARM, RODS
from svsa.errors import ParameterError
from svsa.simulation.arm.contact import (
    check_wall,
    compute_effective_mass,
    compute_least_tip_mass,
)
from svsa.simulation.plant.loads.tip import Wall


@pytest.mark.parametrize("links", [RODS, MACCEPA_ARM, RODS.changed(tip_mass_kg=0.4)])
def test_least_mass_is_that_of_the_inverse_of_the_mass_matrix(links):
    arm, found = links.build(), []
    l1, l2 = (link.length_m for link in links.chain)
    for q1, q2 in np.stack([np.linspace(-1.0, 2.0, 721), np.linspace(-math.pi, math.pi, 721)], 1):
        M = compute_mass_matrix(arm, turn((q1, q2)))
        p = q1 + q2
        J = np.array(
            [
                [l1 * math.cos(q1) + l2 * math.cos(p), l2 * math.cos(p)],
                [l1 * math.sin(q1) + l2 * math.sin(p), l2 * math.sin(p)],
            ]
        )
        mobility = J @ np.linalg.inv(M) @ J.T
        n = np.array([math.cos(p), math.sin(p)])
        mass = compute_effective_mass(arm, (q1, q2), p)
        assert mass == pytest.approx(1.0 / (n @ mobility @ n), rel=1e-9)
        found.append(1.0 / np.linalg.eigvalsh(mobility)[1])
    assert compute_least_tip_mass(arm) == pytest.approx(min(found), rel=1e-4)


@pytest.mark.parametrize(("stiffness", "damping"), [(100.0, 0.0), (2000.0, 200.0), (1e5, 240.0)])
def test_accepted_walls_have_stable_poles_and_twice_the_limit_has_not(stiffness, damping):
    """|R(s h)| ≤ 1 of the Runge–Kutta step for both poles of m s² + d s + k."""
    arm, step = RODS.build(), 0.001
    wall = Wall(
        normal_rad=0.0, distance_m=0.0, stiffness_n_per_m=stiffness, damping_ns_per_m=damping
    )
    check_wall(wall, arm, step)
    assert compute_growth(arm, wall, step) <= 1.0
    wild = wall.changed(damping_ns_per_m=2.0 * (0.0875 * 2600.0 + stiffness / 2600.0))
    with pytest.raises(ParameterError, match="set more steps"):
        check_wall(wild, arm, step)
    assert compute_growth(arm, wild, step) > 1.0


def compute_growth(arm, wall, step):
    z = step * np.roots(
        [compute_least_tip_mass(arm), wall.damping_ns_per_m, wall.stiffness_n_per_m]
    )
    return np.abs(1.0 + z + z**2 / 2 + z**3 / 6 + z**4 / 24).max()
