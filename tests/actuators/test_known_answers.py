"""Every quantity of the equations against values computed independently in 50 digits.

The file holds 24 states with brute-force Lie derivatives. If the environment variable
SVSA_KNOWN_ANSWERS names another file of the same format, that file is read instead.
"""

import json
import os
from pathlib import Path

import numpy as np
import pytest

from svsa.actuators.dynamics import build_actuator, compute_deflection, compute_internal_torque
from svsa.actuators.lever import compute_lever_ratio
from svsa.actuators.linearization import compute_linearization
from svsa.actuators.parameters import ActuatorParameters
from svsa.actuators.signals import Disturbance, Reference, State
from svsa.actuators.spring import (
    compute_elastic_energy,
    compute_elastic_torque,
    compute_reaction_torque,
    compute_stiffness,
)
from svsa.control.gains import Gains
from svsa.control.laws.feedback_linearization import (
    build_gains,
    compute_feedback_linearization,
)
from svsa.control.laws.ndobc import compute_disturbance_gain, compute_ndobc

RELATIVE = 1e-10
DEFAULT_FILE = Path(__file__).parent.parent / "data" / "known_answers.json"
ANSWERS = json.loads(
    Path(os.environ.get("SVSA_KNOWN_ANSWERS") or DEFAULT_FILE).read_text(encoding="utf-8")
)
CASES = range(len(ANSWERS["cases"]))
FIELD_OF_SYMBOL = {
    "M": "link_inertia_kg_m2",
    "B_1": "motor1_inertia_kg_m2",
    "B_2": "motor2_inertia_kg_m2",
    "D": "link_damping_nms_per_rad",
    "D_1": "motor1_damping_nms_per_rad",
    "D_2": "motor2_damping_nms_per_rad",
    "K_s": "spring_stiffness_n_per_m",
    "R": "radius_m",
    "gamma": "spiral_reduction",
}


def compute_quantities(answers, case):
    """Compute each quantity that a case of the file lists under `expect`."""
    values = {FIELD_OF_SYMBOL[symbol]: value for symbol, value in answers["parameters"].items()}
    parameters = ActuatorParameters(**values, reaction_torque="energy")
    nominal = build_actuator(parameters, case["mu_0"])
    gains = build_gains(
        Gains.from_poles([-answers["position_poles"]] * 4, [-answers["stiffness_poles"]] * 2)
    )
    x = State(*case["state"])
    reference = Reference(*case["position_reference"], *case["stiffness_reference"])
    estimate = Disturbance(*case["disturbance_estimate"])
    mu, phi = compute_lever_ratio(x.theta2, nominal.mu0, nominal.gamma), compute_deflection(x)
    lie = compute_linearization(nominal, x)
    gain = compute_disturbance_gain(nominal, gains, lie)
    return {
        "lever_ratio": mu,
        "elastic_torque": compute_elastic_torque(mu, phi, nominal.K),
        "stiffness": compute_stiffness(mu, phi, nominal.K),
        "reaction_torque": compute_reaction_torque(mu, phi, nominal.K, nominal.gamma),
        "elastic_energy": compute_elastic_energy(mu, phi, nominal.K),
        "lie_position": [lie.q, lie.dq, lie.ddq, lie.dddq, lie.ddddq],
        "lie_stiffness": [lie.sigma, lie.dsigma, lie.ddsigma],
        "decoupling_matrix": [[lie.a11, lie.a12], [lie.a21, lie.a22]],
        "disturbance_gain": [[gain.g12, gain.g14, gain.g16], [gain.g22, gain.g24, gain.g26]],
        "feedback_linearization_torque": compute_feedback_linearization(
            nominal, gains, x, reference
        ),
        "ndobc_torque": compute_ndobc(nominal, gains, x, reference, estimate),
    }


@pytest.mark.parametrize("index", CASES)
def test_every_quantity_matches_the_known_answer_entry_by_entry(index):
    """Relative to each entry, so that a large entry does not hide the error of a small one."""
    case = ANSWERS["cases"][index]
    found = compute_quantities(ANSWERS, case)
    assert set(found) == set(case["expect"]), "the file lists a quantity that is not compared"
    for name, expected in case["expect"].items():
        expected = np.asarray(expected, dtype=float)
        floor = np.where(expected == 0.0, 1e-14, 0.0)
        error = np.abs(np.asarray(found[name], dtype=float) - expected)
        assert error.shape == expected.shape
        assert np.all(error <= RELATIVE * np.abs(expected) + floor), (name, found[name], expected)


@pytest.mark.parametrize("index", CASES)
def test_printed_sign_of_both_laws_is_the_negative_of_the_corrected_sign(index):
    """Eq 24 and 36 as printed, A⁻¹[−b + v + Γŵ], solved here by numpy from b, v, Γ and A."""
    case = ANSWERS["cases"][index]
    expect, p = case["expect"], ANSWERS["position_poles"]
    s = ANSWERS["stiffness_poles"]
    e1 = np.array(case["position_reference"][:4]) - expect["lie_position"][:4]
    e2 = np.array(case["stiffness_reference"][:2]) - expect["lie_stiffness"][:2]
    b = np.array(
        [
            case["position_reference"][4] - expect["lie_position"][4],
            case["stiffness_reference"][2] - expect["lie_stiffness"][2],
        ]
    )
    v = -np.array([np.dot([p**4, 4 * p**3, 6 * p**2, 4 * p], e1), np.dot([s**2, 2 * s], e2)])
    compensation = np.array(expect["disturbance_gain"]) @ case["disturbance_estimate"]
    printed = np.linalg.solve(expect["decoupling_matrix"], -b + v + compensation)
    corrected = compute_quantities(ANSWERS, case)["ndobc_torque"]
    np.testing.assert_allclose(-printed, corrected, rtol=0.0, atol=1e-9 * np.abs(printed).max())


def test_internal_torque_is_that_of_eq_1():
    """F = (−D q̇ − τ_e, −D1 θ̇1 + τ_e, −D2 θ̇2 − τ_r): signs and indices of one case by hand."""
    case = ANSWERS["cases"][0]
    expect, symbols = case["expect"], ANSWERS["parameters"]
    values = {FIELD_OF_SYMBOL[symbol]: value for symbol, value in symbols.items()}
    parameters = ActuatorParameters(**values, reaction_torque="energy")
    x = State(*case["state"])
    F = compute_internal_torque(build_actuator(parameters, case["mu_0"]), x)
    torque, reaction = expect["elastic_torque"], expect["reaction_torque"]
    by_hand = (
        -symbols["D"] * x.dq - torque,
        -symbols["D_1"] * x.dtheta1 + torque,
        -symbols["D_2"] * x.dtheta2 - reaction,
    )
    np.testing.assert_allclose(F, by_hand, rtol=1e-12)
