"""The paper's result on every actuator: errors of an independent prototype, to its digits."""

import math

import numpy as np
import pytest

from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import compute_torques
from svsa.actuators.installed import get_mechanism
from svsa.actuators.signals import CHANNEL_INDEX
from tests.actuators.members import follow

# From an independent prototype: σ_d, load, amplitude, and the rms errors of FL and NDOBC from 8 to
# 20 s in degrees and N·m/rad, with all digits of its output.
KNOWN = [
    ("svsa", 15, -2.0, math.radians(60), ("11.884", "1.742"), ("0.0025", "0.0001")),
    ("svsa", 60, -2.0, math.radians(60), ("10.239", "2.921"), ("0.0024", "0.0002")),
    ("qbmove", 1.5, -0.05, 0.8, ("0.166", "0.0043"), ("0.0019", "0.00002")),
    ("qbmove", 8, -0.3, 0.8, ("0.949", "0.153"), ("0.0019", "0.0001")),
    ("maccepa", 0.8, -0.05, 0.8, ("0.628", "0.0005"), ("0.0021", "0.00000")),
    ("awas2", 30, -4.0, 0.8, ("12.190", "1.342"), ("0.0019", "0.0001")),
    ("awas2", 150, -4.0, 0.8, ("9.800", "1.342"), ("0.0018", "0.0001")),
    ("leaf_spring", 20, -2.0, 0.8, ("6.181", "0.000"), ("0.0019", "0.000")),
]


@pytest.mark.parametrize(("name", "sigma", "load", "amplitude", "fl", "ndobc"), KNOWN)
def test_errors_match_the_prototype_to_its_digits(name, sigma, load, amplitude, fl, ndobc):
    for law, known in (("fl", fl), ("ndobc", ndobc)):
        result = follow(name, law, sigma, load, amplitude)
        assert result.fault is None
        last = result.samples[8000:]
        errors = [
            float(np.sqrt(np.mean(last[:, CHANNEL_INDEX[channel]] ** 2)))
            for channel in ("position_error_rad", "stiffness_error_nm_per_rad")
        ]
        errors[0] = math.degrees(errors[0])
        for error, text in zip(errors, known, strict=True):
            assert f"{error:.{len(text.split('.')[1])}f}" == text, (law, errors)


@pytest.mark.parametrize(("s", "phi"), [(0.0, 0.1), (0.06, -0.07), (0.13, 0.13)])
def test_bavs_has_the_torques_of_its_two_pairs_of_springs(s, phi):
    """Each pair: k (b e^{cd} − a e^{−cd}) at the deflection d = ±s − φ, with a and b exchanged."""
    p = get_mechanism("bavs").prototype
    c, weak, strong = p.rate_per_rad, p.weak_torque_nm, p.strong_torque_nm
    first = strong * math.exp(c * (s - phi)) - weak * math.exp(-c * (s - phi))
    second = weak * math.exp(c * (-s - phi)) - strong * math.exp(-c * (-s - phi))
    found = compute_torques(build_actuator(p, 0.0), s, phi)
    assert found.torque == pytest.approx(-(first + second), rel=1e-12)
    assert found.reaction == pytest.approx(first - second, rel=1e-12)
