"""Invalid energies and actuators are rejected with the reason."""

import math

import pytest
from sympy import Rational, pi, sqrt, symbols

import svsa
from svsa.actuators.energy import compile_energy
from svsa.actuators.installed import get_mechanism
from tests.actuators.members import build_wrong, list_values


def bend(phi, s, p, m):
    return m.Abs(phi) ** 3 * s


def stay(phi, s, p, m):
    return p.bending_nm_m3 * phi**2 + s**2


def push(phi, s, p, m):
    return -p.bending_nm_m3 * s * phi**2


def turn(phi, s, p, m):
    return p.bending_nm_m3 * (2 + (s - m.Rational(1, 4)) ** 2) * phi**2


def strange(phi, s, p, m):
    return m.gamma(2 + s) * m.besselj(0, phi)


def widen(phi, s, p, m):
    return p.bending_nm_m3 * s * m.tan(phi) ** 2


def preload(phi, s, p, m):
    return p.bending_nm_m3 * s * (phi + phi**2)


def kink(phi, s, p, m):
    return p.bending_nm_m3 * s * (phi**2 + phi ** m.Rational(5, 2))


def compute_with_floats(phi, s, p, m):
    return s * math.cosh(phi)


def misspell(phi, s, p, m):
    return p.bending * s * phi**2


def rotate(phi, s, p, m):
    return m.I * s * phi**2


def compare(phi, s, p, m):
    return phi > s


def bend_to_a_third(phi, s, p, m):
    return s ** m.Rational(1, 3) * phi**2


def shorten(phi, s, p, m):
    """Roots and whole powers of the same base, with either sign."""
    return m.pi * s**1.5 * phi**2 + p.bending_nm_m3 * (3 - m.sqrt(4 + s - phi**2))


@pytest.mark.parametrize(
    ("energy", "reason"),
    [
        (bend, "it is not smooth"),
        (stay, "does not depend on s"),
        (push, "its stiffness at φ = 0 .* not > 0"),
        (turn, "is not monotonic in s"),
        (strange, "it contains the function"),
        (widen, "it contains the function tan; the lab computes exp, log, tanh, sin"),
        (preload, r"its torque at φ = 0 and s = 0\.02 is 0\.0004 N·m, not 0"),
        (kink, "it is not smooth: a derivative is not finite at φ = 0"),
        (compute_with_floats, "it is not an expression of symbols: TypeError"),
        (misspell, "AttributeError: .* no attribute 'bending'"),
        (rotate, "it contains I"),
        (compare, "it is not an expression of symbols, but of type StrictGreaterThan"),
        (bend_to_a_third, r"it contains the power s\*\*"),
    ],
)
def test_invalid_energy_is_rejected_with_reason(energy, reason):
    with pytest.raises(svsa.ParameterError, match=reason):
        compile_energy(build_wrong(energy))


def test_roots_floating_point_powers_and_constants_of_an_energy_are_computed():
    mechanism = build_wrong(shorten)
    s, phi, c = symbols("s phi c")
    U = pi * s ** Rational(3, 2) * phi**2 + c * (3 - sqrt(4 + s - phi**2))
    sigma = U.diff(phi, 2)
    at = {s: 0.3, phi: 0.2, c: mechanism.prototype.bending_nm_m3}
    state = compile_energy(mechanism).functions["compute_state"](0.3, 0.2, *list_values(mechanism))
    wanted = [U.diff(phi), U.diff(phi, s), U.diff(phi, s, 2)]
    wanted += [sigma, sigma.diff(phi), sigma.diff(s), sigma.diff(phi, 2), sigma.diff(phi, s)]
    wanted += [sigma.diff(s, 2)]
    assert state.derivatives == pytest.approx([float(one.subs(at)) for one in wanted], rel=1e-12)


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"coordinate": (0.5, 0.02)}, "coordinate is .* the lower end of s first"),
        ({"coordinate": (math.nan, 0.5)}, "coordinate is .* two finite numbers"),
        ({"elastic": ("bending",)}, "elastic is .* there is none of the name bending"),
    ],
)
def test_invalid_description_is_rejected_with_reason(changes, reason):
    with pytest.raises(svsa.ParameterError, match=reason):
        build_wrong(stay, **changes)


def test_actuator_without_a_source_is_rejected():
    with pytest.raises(svsa.ParameterError, match="missing: bending_nm_m3"):
        sources = dict(get_mechanism("leaf_spring").sources)
        del sources["bending_nm_m3"]
        build_wrong(stay, sources=sources)


def test_stiffness_outside_the_range_reports_the_range():
    with pytest.raises(svsa.ParameterError, match=r"0\.2 to 15 N·m/rad"):
        svsa.simulate("4b", actuator="qbmove", duration_s=0.01)


def test_unknown_actuator_error_lists_installed_actuators():
    with pytest.raises(svsa.ParameterError, match="svsa, awas2, bavs, leaf_spring"):
        svsa.simulate("4a", actuator="nowhere")


def test_plant_and_model_must_have_the_same_mechanism():
    with pytest.raises(svsa.ParameterError, match=r"nominal\.mechanism"):
        svsa.simulate("4a", nominal=get_mechanism("qbmove").nominal)
