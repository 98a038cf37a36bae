"""Invalid energies and actuators are rejected with the reason."""

import pytest

import svsa
from svsa.actuators.energy import compile_energy
from svsa.actuators.installed import get_mechanism
from tests.actuators.members import build_wrong


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


@pytest.mark.parametrize(
    ("energy", "reason"),
    [
        (bend, "it is not smooth"),
        (stay, "does not depend on s"),
        (push, "its stiffness at φ = 0 .* not > 0"),
        (turn, "is not monotonic in s"),
        (strange, "it contains the function"),
    ],
)
def test_invalid_energy_is_rejected_with_reason(energy, reason):
    with pytest.raises(svsa.ParameterError, match=reason):
        compile_energy(build_wrong(energy))


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
