"""Spring and lever: Eq 2–5 compared with numerical derivatives and printed numbers."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from svsa.actuators.lever import (
    compute_lever_ratio,
    compute_lever_ratio_for_stiffness,
    compute_lever_ratio_slope,
    compute_zero_stiffness_deflection,
)
from svsa.actuators.spring import (
    compute_elastic_energy,
    compute_elastic_torque,
    compute_printed_reaction_torque,
    compute_reaction_torque,
    compute_spring_derivatives,
    compute_stiffness,
)

from .prototype import LEVER_RATIO_RANGE, K, differentiate, drawn, lever_ratios, springs

STEP = 1e-3
TOLERANCE = 2e-7
MU_60 = compute_lever_ratio_for_stiffness(60.0, K)


def assert_derivative(found, function, at, scale):
    """Compare with a difference of fourth order; scale: largest derivative in the domain."""
    assert abs(found - differentiate(function, at, STEP)) <= TOLERANCE * scale


@drawn
@given(springs())
def test_stiffness_is_the_derivative_of_the_elastic_torque(spring):
    mu, phi = spring
    level = compute_stiffness(mu, 0.0, K)
    found = compute_stiffness(mu, phi, K)
    assert_derivative(found, lambda angle: compute_elastic_torque(mu, angle, K), phi, level)


@drawn
@given(springs())
def test_elastic_torque_is_the_derivative_of_the_energy(spring):
    mu, phi = spring
    found = compute_elastic_torque(mu, phi, K)
    scale = compute_stiffness(mu, 0.0, K)
    assert_derivative(found, lambda angle: compute_elastic_energy(mu, angle, K), phi, scale)


@drawn
@given(springs(), st.sampled_from([1.0, 0.5, 3.0]))
def test_reaction_torque_is_the_derivative_of_the_energy_along_the_stiffness_motor(spring, gamma):
    """τ_r = ∂V/∂θ2 through μ(θ2): the replacement of Eq 5, with γ in it."""
    mu, phi = spring

    def compute_energy(theta2):
        return compute_elastic_energy(compute_lever_ratio(theta2, mu, gamma), phi, K)

    found = compute_reaction_torque(mu, phi, K, gamma)
    assert_derivative(found, compute_energy, 0.0, 1.0 + found)


@drawn
@given(lever_ratios, st.floats(-1.5, 1.5))
def test_reaction_torque_always_opposes_stiffening(mu, phi):
    """A stiffer spring at the same deflection holds more energy, so τ_r ≥ 0; zero at φ = 0."""
    assert compute_reaction_torque(mu, phi, K, 1.0) >= 0.0
    assert compute_reaction_torque(mu, 0.0, K, 1.0) == 0.0


@drawn
@given(lever_ratios, st.floats(-1.5, 1.5))
def test_elastic_energy_is_positive_and_even_in_the_deflection(mu, phi):
    energy = compute_elastic_energy(mu, phi, K)
    assert energy >= 0.0
    assert energy == compute_elastic_energy(mu, -phi, K)
    assert compute_elastic_torque(mu, -phi, K) == -compute_elastic_torque(mu, phi, K)


CHAIN = [
    ("torque_mu", "torque", "mu"),
    ("torque_mumu", "torque_mu", "mu"),
    ("sigma", "torque", "phi"),
    ("sigma_phi", "sigma", "phi"),
    ("sigma_mu", "sigma", "mu"),
    ("sigma_mu", "torque_mu", "phi"),
    ("sigma_phiphi", "sigma_phi", "phi"),
    ("sigma_phimu", "sigma_phi", "mu"),
    ("sigma_phimu", "sigma_mu", "phi"),
    ("sigma_mumu", "sigma_mu", "mu"),
]


@pytest.mark.parametrize(("derivative", "of", "variable"), CHAIN)
def test_each_partial_derivative_is_the_derivative_of_the_previous_one(derivative, of, variable):
    """All parts of the Lie derivatives, on a grid over the whole domain."""
    for mu in np.linspace(*LEVER_RATIO_RANGE, 7):
        for share in (-0.95, -0.5, -0.01, 0.0, 0.3, 0.7, 0.95):
            phi = share * compute_zero_stiffness_deflection(mu)
            found = getattr(compute_spring_derivatives(mu, phi, K), derivative)

            def compute(at, mu=mu, phi=phi):
                where = (at, phi) if variable == "mu" else (mu, at)
                return getattr(compute_spring_derivatives(*where, K), of)

            slope = differentiate(compute, mu if variable == "mu" else phi, 1e-4)
            scale = abs(found) + abs(compute(mu if variable == "mu" else phi)) + K
            assert abs(found - slope) <= 1e-8 * scale, (mu, phi)


def test_printed_reaction_torque_differs_from_the_energy_consistent_one_as_documented():
    """0.398 against 0.449 N·m at σ = 60 N·m/rad and φ = 0.1 rad."""
    assert compute_printed_reaction_torque(MU_60, 0.1, K) == pytest.approx(0.398, abs=5e-4)
    assert compute_reaction_torque(MU_60, 0.1, K, 1.0) == pytest.approx(0.449, abs=5e-4)


def test_printed_reaction_torque_is_eq_5_times_the_radius():
    """Eq 5 with R, a = μR and β = arctan(−2πμ) written out, its magnitude times R."""
    R, phi = 0.075, 0.1
    spring_stiffness, a, beta = K / R**2, MU_60 * R, math.atan(-2.0 * math.pi * MU_60)
    c, s = math.cos(phi), math.sin(phi)
    force = (spring_stiffness * R**2 * a**2 * math.sin(2.0 * beta) * s**2) / (
        2.0 * (R - a * c) * (a**2 + R**2 - 2.0 * a * R * c)
    )
    assert force < 0.0, "the printed sign is negative"
    assert compute_printed_reaction_torque(MU_60, phi, K) == pytest.approx(-R * force, rel=1e-12)


@pytest.mark.parametrize(("sigma", "angle"), [(15.0, 0.54), (60.0, 0.44), (150.0, 0.37)])
def test_angle_of_zero_stiffness_depends_on_the_lever_ratio(sigma, angle):
    """All three are below the 0.75 rad of Table 1; the torque peaks there, then decreases."""
    mu = compute_lever_ratio_for_stiffness(sigma, K)
    zero = compute_zero_stiffness_deflection(mu)
    assert zero == pytest.approx(angle, abs=5e-3)
    assert abs(compute_stiffness(mu, zero, K)) <= 1e-12 * sigma
    peak = compute_elastic_torque(mu, zero, K)
    assert peak > compute_elastic_torque(mu, zero - 0.01, K)
    assert peak > compute_elastic_torque(mu, zero + 0.01, K)
    assert compute_stiffness(mu, zero + 0.01, K) < 0.0


def test_stiffness_range_of_table_1_is_the_lever_range_of_the_spiral():
    """1.7 … 150.56 N·m/rad ⇔ μ 0.2861 … 0.7904."""
    ends = [compute_lever_ratio_for_stiffness(sigma, K) for sigma in (1.7, 150.56)]
    assert ends == pytest.approx(LEVER_RATIO_RANGE, abs=5e-5)


@drawn
@given(st.floats(0.0, 1e4))
def test_lever_ratio_of_a_stiffness_gives_this_stiffness(sigma):
    mu = compute_lever_ratio_for_stiffness(sigma, K)
    assert 0.0 <= mu < 1.0
    assert compute_stiffness(mu, 0.0, K) == pytest.approx(sigma, rel=1e-11)


def test_one_turn_of_the_stiffness_motor_moves_the_lever_ratio_by_one_over_gamma():
    """Eq 4: μ = μ0 + θ2/(2πγ)."""
    for gamma in (1.0, 2.5):
        moved = compute_lever_ratio(2.0 * math.pi, 0.1, gamma) - 0.1
        assert moved == pytest.approx(1.0 / gamma, rel=1e-14)
        assert compute_lever_ratio_slope(gamma) == pytest.approx(1 / (2 * math.pi * gamma))


def test_printed_form_of_the_energy_loses_digits_at_small_deflection():
    """The reason for forms of V and τ_r without cancelling terms: at φ = 1e-4 V is of order φ²."""
    mu, phi = 0.5, 1e-4
    n = 1.0 - mu * math.cos(phi)
    printed = K * (1.0 / (1.0 - mu) - 1.0 / n + math.log((1.0 - mu) / n))
    parabola = 0.5 * compute_stiffness(mu, 0.0, K) * phi**2
    assert compute_elastic_energy(mu, phi, K) == pytest.approx(parabola, rel=1e-6)
    assert abs(printed / parabola - 1.0) > 1e-9


def test_spring_derivatives_repeat_torque_and_stiffness_of_the_single_functions():
    """τ_e and σ exist twice in the compiled code, alone and among the derivatives."""
    for mu, phi in ((0.3, -0.4), (0.55, 0.2), (0.78, 0.31)):
        all_of_them = compute_spring_derivatives(mu, phi, K)
        assert all_of_them.torque == pytest.approx(compute_elastic_torque(mu, phi, K), rel=1e-14)
        assert all_of_them.sigma == pytest.approx(compute_stiffness(mu, phi, K), rel=1e-13)
