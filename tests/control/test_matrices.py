"""The small matrices of a law's design compared with scipy."""

import numpy as np
import pytest
from scipy.linalg import expm, solve_discrete_are

from svsa.control.matrices import (
    compute_exponential,
    multiply,
    raise_to,
    solve,
    solve_riccati,
)
from svsa.errors import SvsaError

RANDOM = np.random.default_rng(5)


@pytest.mark.parametrize("n", range(1, 7))
def test_products_powers_solutions_and_exponentials_match_scipy(n: int) -> None:
    A, B = RANDOM.normal(size=(2, n, n))
    np.testing.assert_allclose(multiply(A, B, A), A @ B @ A, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(raise_to(A, 5), np.linalg.matrix_power(A, 5), atol=1e-10)
    np.testing.assert_allclose(solve(A, B), np.linalg.solve(A, B), rtol=1e-9)
    np.testing.assert_allclose(compute_exponential(4 * A), expm(4 * A), rtol=1e-9)


def test_zero_pivot_is_exchanged_and_singular_matrix_reported() -> None:
    swap = np.array([[0.0, 1.0], [1.0, 0.0]])
    np.testing.assert_array_equal(solve(swap, np.eye(2)), swap)
    with pytest.raises(SvsaError, match="singular"):
        solve(np.ones((2, 2)), np.eye(2))


@pytest.mark.parametrize("period", [1e-3, 0.02])
def test_riccati_equation_is_solved_with_a_stable_feedback(period: float) -> None:
    chain = compute_exponential(np.diag(np.ones(4), 1) * period)
    A, B = chain[:4, :4], chain[:4, 4:]
    Q, R = np.diag([1e6, 1e2, 0.0, 0.0]), np.array([[1e-4]])
    P = solve_riccati(A, B, Q, R)
    k = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A)
    np.testing.assert_allclose(A.T @ P @ (A - B @ k) + Q, P, rtol=1e-9, atol=1e-9 * np.max(P))
    np.testing.assert_allclose(P, solve_discrete_are(A, B, Q, R), rtol=1e-7)
    assert np.max(np.abs(np.linalg.eigvals(A - B @ k))) < 1.0


def test_uncontrollable_system_is_rejected() -> None:
    with pytest.raises(SvsaError, match="Riccati"):
        solve_riccati(np.array([[2.0]]), np.array([[0.0]]), np.eye(1), np.eye(1))
