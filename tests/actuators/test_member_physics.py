"""Derivatives of every actuator's energy, its balance, passivity and Lie derivatives."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from svsa.actuators.dynamics import (
    ExternalLoad,
    build_actuator,
    compute_acceleration,
    compute_internal_torque,
)
from svsa.actuators.elasticity import (
    compute_coordinate,
    compute_coordinate_for_stiffness,
    compute_derivatives,
    compute_stiffness_of,
)
from svsa.actuators.energy import compile_energy
from svsa.actuators.installed import get_mechanism
from svsa.actuators.linearization import compute_linearization
from svsa.actuators.signals import State, Torque
from svsa.actuators.spring import compute_elastic_energy, compute_spring_derivatives
from tests.actuators.members import NAMES, STIFFNESS, list_values
from tests.actuators.prototype import (
    NO_LOADS,
    NO_TORQUE,
    differentiate,
    integrate_ideal,
    springs,
)

WITH_STIFFNESS_MOTOR = [name for name in NAMES if get_mechanism(name).has_stiffness_motor]
UNLOADED = ExternalLoad(0.0, 0.0, 0.0, 0.0, 0.0)


@pytest.mark.exhaustive
@settings(max_examples=200)
@given(springs())
def test_hand_written_derivatives_of_the_svsa_match_its_energy(drawn):
    mu, phi = drawn
    mechanism = get_mechanism("svsa")
    functions = compile_energy(mechanism).functions
    K = mechanism.prototype.rotational_stiffness_nm_per_rad
    values = list_values(mechanism)
    by_hand = compute_spring_derivatives(mu, phi, K)
    # Both round: the unit of a difference is the largest value of the derivative here.
    most = compute_spring_derivatives(mu, 0.0, K)
    for name, one, other in zip(
        by_hand._fields,
        by_hand,
        functions["compute_state"](mu, phi, *values).derivatives,
        strict=True,
    ):
        scale = max(abs(one), abs(getattr(most, name)), K)
        assert abs(one - other) <= 1e-12 * scale, name
    energy = functions["compute_energy"](mu, phi, *values)
    assert abs(energy - compute_elastic_energy(mu, phi, K)) <= 1e-12 * K / (1 - mu)


@st.composite
def sample_states(draw, name):
    """Sample (actuator, s, φ) inside the domain of an actuator."""
    mechanism = get_mechanism(name)
    limits = mechanism.limits
    sigma = draw(st.floats(limits.stiffness_min_nm_per_rad, limits.stiffness_max_nm_per_rad))
    actuator = build_actuator(mechanism.prototype, 0.0)
    s = compute_coordinate_for_stiffness(actuator, sigma)
    return actuator, s, draw(st.floats(-0.3, 0.3)), sigma


@pytest.mark.parametrize("name", WITH_STIFFNESS_MOTOR)
@settings(max_examples=40)
@given(data=st.data())
def test_derivatives_match_numerical_derivatives_of_the_torque(name, data):
    actuator, s, phi, sigma = data.draw(sample_states(name))
    assert compute_stiffness_of(actuator, s, 0.0) == pytest.approx(sigma, rel=1e-9)
    found = compute_derivatives(actuator, s, phi)
    assert found.sigma == pytest.approx(compute_stiffness_of(actuator, s, phi), rel=1e-12)
    near = 1e-4
    for of, wrt in (
        ("torque", "sigma"),
        ("sigma", "sigma_phi"),
        ("sigma_phi", "sigma_phiphi"),
        ("sigma_mu", "sigma_phimu"),
        ("torque_mu", "sigma_mu"),
    ):
        slope = differentiate(
            lambda x, of=of: getattr(compute_derivatives(actuator, s, x), of), phi, near
        )
        assert getattr(found, wrt) == pytest.approx(slope, rel=1e-5, abs=1e-5 * abs(found.sigma))
    for of, wrt in (("torque", "torque_mu"), ("torque_mu", "torque_mumu"), ("sigma", "sigma_mu")):
        slope = differentiate(
            lambda x, of=of: getattr(compute_derivatives(actuator, x, phi), of), s, near * s
        )
        scale = max(abs(found.sigma_mu), abs(found.torque_mumu))
        assert getattr(found, wrt) == pytest.approx(slope, rel=1e-5, abs=1e-6 * scale)


def compute_total_energy(mechanism, actuator, x):
    """Return the kinetic and elastic energy, J."""
    s = compute_coordinate(actuator, x.theta2)
    elastic = compile_energy(mechanism).functions["compute_energy"](
        s, x.q - x.theta1, *list_values(mechanism)
    )
    moving = actuator.M * x.dq**2 + actuator.B1 * x.dtheta1**2 + actuator.B2 * x.dtheta2**2
    return float(elastic + 0.5 * moving)


@pytest.mark.long
@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=40)
@given(data=st.data())
def test_energy_decreases_by_damping_power_without_torque(name, data):
    """d/dt (T + U) = −D q̇² − D1 θ̇1² − D2 θ̇2² ≤ 0: the energy balance and passivity."""
    mechanism = get_mechanism(name)
    actuator, s, phi, _ = data.draw(sample_states(name))
    actuator = actuator._replace(mu0=s)
    speeds = [data.draw(st.floats(-3.0, 3.0)) for _ in range(3)]
    x = State(phi, speeds[0], 0.0, speeds[1], 0.0, speeds[2])
    a = compute_acceleration(actuator, x, Torque(0.0, 0.0), UNLOADED)
    rate = State(x.dq, a.ddq, x.dtheta1, a.ddtheta1, x.dtheta2, a.ddtheta2)
    power = differentiate(
        lambda t: compute_total_energy(
            mechanism, actuator, State(*(v + t * d for v, d in zip(x, rate, strict=True)))
        ),
        0.0,
        1e-6,
    )
    lost = -(actuator.D * x.dq**2 + actuator.D1 * x.dtheta1**2 + actuator.D2 * x.dtheta2**2)
    flow = abs(compute_internal_torque(actuator, x).link * x.dq) + compute_total_energy(
        mechanism, actuator, x
    )
    assert power == pytest.approx(lost, abs=1e-6 * (1.0 + flow))
    assert lost <= 0.0


@pytest.mark.parametrize("name", NAMES)
def test_actuator_without_torque_comes_to_rest(name):
    mechanism = get_mechanism(name)
    sigma = STIFFNESS[name]
    actuator = build_actuator(mechanism.prototype, 0.0)
    actuator = actuator._replace(mu0=compute_coordinate_for_stiffness(actuator, sigma))
    x = State(0.05, 0.0, 0.0, 0.0, 0.0, 0.0)
    stored = [compute_total_energy(mechanism, actuator, x)]
    for tick in range(2000):
        x = integrate_ideal(actuator, x, NO_TORQUE, NO_LOADS, tick, 0.0005, 4)
        stored.append(compute_total_energy(mechanism, actuator, x))
    assert np.all(np.diff(stored) <= 1e-9 * abs(stored[0]))
    assert stored[-1] < stored[0]


@pytest.mark.parametrize("name", NAMES)
def test_lie_derivatives_match_rates_along_the_flow(name):
    """σ̇ of the linearization is the rate of σ along ẋ = f(x)."""
    mechanism = get_mechanism(name)
    nominal = build_actuator(mechanism.nominal, 0.0)
    s = compute_coordinate_for_stiffness(nominal, STIFFNESS[name])
    nominal = nominal._replace(mu0=s)
    x = State(0.1, 0.3, 0.05, -0.2, 0.0, 0.1 if mechanism.has_stiffness_motor else 0.0)
    a = compute_acceleration(nominal, x, Torque(0.0, 0.0), UNLOADED)
    rate = (x.dq, a.ddq, x.dtheta1, a.ddtheta1, x.dtheta2, a.ddtheta2)

    def move(field):
        return differentiate(
            lambda t: getattr(
                compute_linearization(
                    nominal, State(*(v + t * d for v, d in zip(x, rate, strict=True)))
                ),
                field,
            ),
            0.0,
            1e-5,
        )

    found = compute_linearization(nominal, x)
    for of, derived in (
        ("ddq", "dddq"),
        ("dddq", "ddddq"),
        ("sigma", "dsigma"),
        ("dsigma", "ddsigma"),
    ):
        value = getattr(found, derived)
        assert value == pytest.approx(move(of), rel=1e-5, abs=1e-5 * abs(found.ddddq)), derived
