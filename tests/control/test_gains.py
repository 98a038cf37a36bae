"""Gains: poles and coefficients of Eq 25, and rejected polynomials."""

import numpy as np
import pytest

import svsa


def test_gains_and_poles_are_equivalent():
    """(s+60)⁴ and (s+40)² have the declared coefficients; their roots are the poles."""
    assert svsa.Gains.from_poles([-60.0] * 4, [-40.0] * 2) == svsa.load_prototype().gains
    other = svsa.Gains.from_poles([-45.0, -80.0, -30.0 + 30.0j, -30.0 - 30.0j], [-20.0, -40.0])
    poles = [-30.0 - 30.0j, -30.0 + 30.0j, -45.0, -80.0]
    np.testing.assert_allclose(other.position_roots, poles, rtol=1e-9)


@pytest.mark.parametrize(
    ("position", "word", "finding"),
    [
        ((1.0, 1.0, 1.0, -1.0), "Hurwitz", "0.9334 ± 1.132j lies right of the imaginary axis"),
        ((0.0, 1.0, 1.0, 1.0), "Hurwitz", "0 lies on the imaginary axis"),
        ((1e14,) * 4, "slower", "is faster than 1000 rad/s"),
    ],
)
def test_unstable_and_too_fast_gains_are_rejected_with_their_roots(position, word, finding):
    with pytest.raises(svsa.ParameterError) as refused:
        svsa.Gains(position_coefficients=position, stiffness_coefficients=(1600.0, 80.0))
    (violation,) = refused.value.violations
    assert violation.name == "position_coefficients"
    assert word in violation.bound
    assert finding in violation.message
    assert len(violation.message) < 90
    assert "roots are" in violation.bound


@pytest.mark.parametrize(
    "poles", [[-60.0] * 3, [-60.0, -60.0, -60.0, -30.0 + 5.0j], [-60.0, -60.0, -60.0, float("nan")]]
)
def test_poles_without_a_real_polynomial_are_rejected(poles):
    with pytest.raises(svsa.ParameterError, match="position_poles_rad_per_s"):
        svsa.Gains.from_poles(poles, [-40.0] * 2)
