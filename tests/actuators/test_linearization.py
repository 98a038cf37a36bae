"""Lie derivatives, A(x) and Γ(x) compared with numerical directional derivatives."""

import numpy as np
import pytest
from hypothesis import given

from svsa.actuators.dynamics import compute_deflection
from svsa.actuators.lever import compute_lever_ratio
from svsa.actuators.linearization import compute_linearization, solve_decoupling
from svsa.actuators.signals import State
from svsa.actuators.spring import compute_stiffness
from svsa.control.laws.ndobc import compute_disturbance_gain
from svsa.simulation.plant.integration import compute_rate
from svsa.simulation.plant.load_table import compute_load

from .prototype import (
    GAINS,
    NO_LOADS,
    NO_TORQUE,
    NOMINAL,
    build_state,
    differentiate_along,
    drawn,
    states,
)

POSITION = ("q", "dq", "ddq", "dddq", "ddddq")
STIFFNESS = ("sigma", "dsigma", "ddsigma")
NO_LOAD = compute_load(NO_LOADS, 0, 0.001, 0.0)
TORQUE_WAYS = {
    "u1": State(0.0, 0.0, 0.0, 1.0 / NOMINAL.B1, 0.0, 0.0),
    "u2": State(0.0, 0.0, 0.0, 0.0, 0.0, 1.0 / NOMINAL.B2),
}
DISTURBANCE_WAYS = {
    "w2": State(0.0, 1.0 / NOMINAL.M, 0.0, 0.0, 0.0, 0.0),
    "w4": TORQUE_WAYS["u1"],
    "w6": TORQUE_WAYS["u2"],
}


def select(names):
    """Return the function from State to these fields of the linearization."""
    return lambda x: [getattr(compute_linearization(NOMINAL, x), name) for name in names]


def compute_drift(x):
    """f(x) of Eq 9: the rate with u = 0 and w = 0."""
    return compute_rate(NOMINAL, x, NO_TORQUE, NO_LOAD)


def assert_close(found, expected, scale):
    error = np.abs(np.subtract(found, expected))
    assert np.all(error <= 1e-7 * scale), (found, expected)


@drawn
@given(states())
def test_outputs_are_position_and_stiffness(x):
    """L_f⁰ h = h(x): h1 = q, h2 = σ."""
    lie = compute_linearization(NOMINAL, x)
    mu = compute_lever_ratio(x.theta2, NOMINAL.mu0, NOMINAL.gamma)
    assert lie.q == x.q
    assert lie.sigma == pytest.approx(
        compute_stiffness(mu, compute_deflection(x), NOMINAL.K), rel=1e-10, abs=1e-9
    )


@pytest.mark.parametrize("names", [POSITION, STIFFNESS], ids=["position", "stiffness"])
@drawn
@given(x=states())
def test_each_lie_derivative_is_the_derivative_of_the_previous_one_along_f(names, x):
    """L_f^k h = ∂(L_f^{k−1} h)/∂x · f: q to the 4th, σ to the 2nd."""
    drift = compute_drift(x)
    step = 3e-3 / (1.0 + np.linalg.norm(drift))
    slopes = differentiate_along(select(names[:-1]), x, drift, step)
    found = np.array(select(names[1:])(x))
    assert np.all(np.abs(found - slopes) <= 1e-7 * (1.0 + np.abs(found))), (found, slopes)


@pytest.mark.parametrize(
    ("names", "entries"), [(POSITION, ("a11", "a12")), (STIFFNESS, ("a21", "a22"))]
)
@drawn
@given(x=states())
def test_torques_first_appear_through_the_decoupling_matrix(names, entries, x):
    """A(x) = L_g L_f^{r−1} h column by column; lower derivatives do not depend on u."""
    for way, entry in zip(TORQUE_WAYS.values(), entries, strict=True):
        slopes = differentiate_along(select(names[:-1]), x, way, 1e-3)
        found = getattr(compute_linearization(NOMINAL, x), entry)
        highest = np.abs(select(names[:-1])(x)).max()
        assert_close(slopes[:-1], 0.0, 1.0 + highest)
        assert_close(slopes[-1], found, 1.0 + highest + abs(found))


@pytest.mark.parametrize(
    ("names", "row", "coefficients"),
    [
        (POSITION, ("g12", "g14", "g16"), (0.0, GAINS.p1, GAINS.p2, GAINS.p3)),
        (STIFFNESS, ("g22", "g24", "g26"), (0.0, GAINS.s1)),
    ],
    ids=["position", "stiffness"],
)
@drawn
@given(x=states())
def test_disturbance_gain_is_the_sum_of_eq_24(names, row, coefficients, x):
    """γ_ij = Σ_{k=0}^{r−2} c_{k+1} L_pj L_f^k h + L_pj L_f^{r−1} h, each L_p by a difference.

    c_{k+1} belongs to e_{k+2}, the error of L_f^{k+1} h: because of the disturbance, this error
    differs from the derivative of the previous error.
    """
    gain = compute_disturbance_gain(NOMINAL, GAINS, compute_linearization(NOMINAL, x))
    weights = np.array([*coefficients[1:], 1.0])
    for way, entry in zip(DISTURBANCE_WAYS.values(), row, strict=True):
        slopes = differentiate_along(select(names[:-1]), x, way, 1e-4)
        terms = weights * slopes
        assert_close(getattr(gain, entry), terms.sum(), 1.0 + np.abs(terms).sum())


@drawn
@given(x=states())
def test_torque_solution_inverts_the_decoupling_matrix(x):
    """A u = y for the torque found, compared with numpy's solution."""
    lie = compute_linearization(NOMINAL, x)
    A = np.array([[lie.a11, lie.a12], [lie.a21, lie.a22]])
    y = np.array([1.5e4, -70.0])
    torque = solve_decoupling(lie, *y)
    np.testing.assert_allclose(A @ torque, y, rtol=1e-9, atol=1e-9 * np.abs(A).max())


def test_decoupling_matrix_is_regular_at_rest_and_singular_at_zero_lever_ratio():
    """With the printed μ0 = 0 and x = 0, A(x) = 0: the reason why each run sets μ0."""
    lie = compute_linearization(NOMINAL, build_state(mu=0.5, phi=0.0))
    assert lie.a11 * lie.a22 - lie.a12 * lie.a21 > 0.0
    lie = compute_linearization(NOMINAL._replace(mu0=0.0), State(*np.zeros(6)))
    assert (lie.a11, lie.a12, lie.a21, lie.a22) == (0.0, 0.0, 0.0, 0.0)
