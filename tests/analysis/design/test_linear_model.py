"""Linear model at rest: compared with differences of the plant, A(x) of Eq 18 and a simulation."""

import numpy as np
import pytest

import svsa
from svsa.actuators.domain import build_domain
from svsa.actuators.dynamics import ExternalLoad, build_actuator, compute_deflection, compute_rate
from svsa.actuators.lever import compute_lever_ratio
from svsa.actuators.linearization import compute_linearization
from svsa.actuators.signals import State, Torque
from svsa.actuators.spring import compute_stiffness

SIGMAS = (2.0, 15.0, 60.0, 150.0)
STEP = 1e-5
REST = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def build_plant(model, parameters):
    """Return ẋ and y of the nonlinear plant at (x, u, w) as arrays."""
    actuator = build_actuator(parameters, model.lever_ratio)

    def rate(x, u):
        load = ExternalLoad(u[2], u[3], u[4], 0.0, 0.0)
        return np.array(compute_rate(actuator, State(*x), Torque(u[0], u[1]), load))

    def measure(x, _):
        state = State(*x)
        mu = compute_lever_ratio(state.theta2, actuator.mu0, actuator.gamma)
        return np.array([state.q, compute_stiffness(mu, compute_deflection(state), actuator.K)])

    return rate, measure


def differentiate(function, size, at):
    columns = [
        (function(at(STEP * e)) - function(at(-STEP * e))) / (2 * STEP) for e in np.eye(size)
    ]
    return np.column_stack(columns)


@pytest.mark.parametrize("sigma", SIGMAS)
@pytest.mark.parametrize("part", ["actuator", "nominal"])
def test_matrices_are_the_derivatives_of_the_plant(sigma, part):
    parameters = getattr(svsa.load_prototype(), part)
    model = svsa.design.linearize(sigma, actuator=parameters)
    rate, measure = build_plant(model, parameters)
    for matrix, function, of_input in (
        (model.A, rate, False),
        (model.B, rate, True),
        (model.C, measure, False),
        (model.D, measure, True),
    ):
        size = 5 if of_input else 6
        found = differentiate(
            lambda d, f=function, i=of_input: f(np.zeros(6), d) if i else f(d, np.zeros(5)),
            size,
            lambda e: e,
        )
        np.testing.assert_allclose(matrix, found, rtol=1e-6, atol=1e-6 * (1.0 + abs(found).max()))


@pytest.mark.parametrize("sigma", SIGMAS)
def test_decoupling_matrix_and_relative_degrees_match_the_theory(sigma):
    """C₁A³B = A(x) row 1 at degree 4, C₂AB = row 2 at degree 2 (Eq 18); lower degrees are zero."""
    nominal = svsa.load_prototype().nominal
    model = svsa.design.linearize(sigma, actuator=nominal)
    A, B, C, _ = model
    theory = compute_linearization(build_actuator(nominal, model.lever_ratio), REST)
    for k in range(3):
        assert np.all(C[0] @ np.linalg.matrix_power(A, k) @ B[:, :2] == 0.0)
    assert np.all(C[1] @ B[:, :2] == 0.0)
    position, stiffness = C[0] @ np.linalg.matrix_power(A, 3) @ B, C[1] @ A @ B
    np.testing.assert_allclose(position[:2], [theory.a11, theory.a12], rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(stiffness[:2], [theory.a21, theory.a22], rtol=1e-12, atol=1e-9)
    assert theory.sigma == pytest.approx(sigma, rel=1e-12)


def test_small_torque_pulse_moves_model_and_simulation_equally():
    """0.01 N·m on motor 1 for 50 ms, by a controller in Python, to 0.1 %."""
    from scipy.signal import StateSpace, dlsim

    model = svsa.design.linearize(15.0)
    count, push = 200, 0.01

    def torque(time, *_):
        return (push if time < 0.05 - 1e-9 else 0.0), 0.0

    result = svsa.simulate(
        "4a", torque, position=svsa.ConstantPosition(), loads=(), duration_s=count * 0.001
    )
    inputs = np.zeros((count, 5))
    inputs[:50, 0] = push
    discrete = StateSpace(*model).to_discrete(0.001)
    _, outputs, _ = dlsim(discrete, inputs)
    largest = np.abs(outputs[:, 0]).max()
    assert largest > 1e-4
    np.testing.assert_allclose(result.position_rad, outputs[:, 0], atol=1e-3 * largest)


def test_labels_name_the_rows_and_columns():
    model = svsa.design.linearize(60.0)
    shapes = [matrix.shape for matrix in model]
    assert shapes == [(6, 6), (6, 5), (2, 6), (2, 5)]
    names = (model.states, model.inputs, model.outputs)
    assert [len(part) for part in names] == [6, 5, 2]
    assert model.units["stiffness_nm_per_rad"] == "N·m/rad"
    assert set(model.units) == {name for part in names for name in part}
    domain = build_domain(svsa.load_prototype().actuator, svsa.load_prototype().limits)
    assert domain.mu_min < model.lever_ratio < domain.mu_max


@pytest.mark.parametrize("sigma", [1.0, 151.0, float("nan"), "soft"])
def test_stiffness_outside_the_range_is_rejected(sigma):
    with pytest.raises(svsa.ParameterError, match=r"from 1\.7 to 150\.56 N·m/rad"):
        svsa.design.linearize(sigma)
