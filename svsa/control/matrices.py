"""Small matrix functions for the design of a law, bit-identical on every machine.

A numerical library orders its operations differently on each processor, which changes the bits of
gains. Here every sum is computed from the first term to the last, by numpy's element-wise additions
and multiplications.
"""

import numpy as np

from svsa.errors import SvsaError

TAYLOR_TERMS = 18
MAX_DOUBLINGS = 60
RICCATI_TOLERANCE = 1e-15
MAX_RICCATI = 1e100


def weigh(bound: float) -> float:
    """Return 1/bound², the weight of an error in a quadratic cost (Bryson's rule)."""
    return 1.0 / (bound * bound)


def multiply(A: np.ndarray, B: np.ndarray, *others: np.ndarray) -> np.ndarray:
    """Multiply matrices: A B …, each of two dimensions, in a fixed order of operations."""
    product = A[:, :1] * B[:1]
    for k in range(1, len(B)):
        product = product + A[:, k : k + 1] * B[k : k + 1]
    return multiply(product, *others) if others else product


def raise_to(A: np.ndarray, power: int) -> np.ndarray:
    """Compute the power of a square matrix, A^power with power ≥ 0."""
    return np.eye(len(A)) if power == 0 else multiply(A, raise_to(A, power - 1))


def solve(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """Solve A X = B for X by Gaussian elimination with partial pivoting.

    Raises:
        SvsaError: If A is singular.
    """
    n = len(A)
    rows = np.hstack([A, B]).astype(float)
    for k in range(n):
        pivot = k + int(np.argmax(np.abs(rows[k:, k])))
        if rows[pivot, k] == 0.0:
            raise SvsaError("A matrix of a law's design is singular.")
        rows[[k, pivot]] = rows[[pivot, k]]
        rows[k] = rows[k] / rows[k, k]
        for i in range(n):
            if i != k:
                rows[i] = rows[i] - rows[i, k] * rows[k]
    return rows[:, n:]


def compute_exponential(A: np.ndarray) -> np.ndarray:
    """Compute e^A by its Taylor series about A/2^s with ‖A/2^s‖₁ ≤ 1/2, squared s times."""
    norm, squarings = float(np.max(np.abs(A))) * len(A), 0
    while norm > 0.5:
        norm, squarings = norm / 2.0, squarings + 1
    scaled = A * 2.0**-squarings
    term = total = np.eye(len(A))
    for k in range(1, TAYLOR_TERMS):
        term = multiply(term, scaled) / k
        total = total + term
    for _ in range(squarings):
        total = multiply(total, total)
    return total


def solve_riccati(A: np.ndarray, B: np.ndarray, Q: np.ndarray, R: np.ndarray) -> np.ndarray:
    """P = Aᵀ P A − Aᵀ P B (R + Bᵀ P B)⁻¹ Bᵀ P A + Q, the stabilising solution.

    By doubling (Chu, Fan, Lin and Wang, 2004): each step covers as many time steps as all previous
    ones together.

    Raises:
        SvsaError: If it does not converge: (A, B) cannot be stabilised.
    """
    identity = np.eye(len(A))
    G, P = multiply(B, solve(R, B.T)), Q
    for _ in range(MAX_DOUBLINGS):
        W = identity + multiply(G, P)
        V, VG = solve(W, A), solve(W, G)
        step = multiply(A.T, P, V)
        G = G + multiply(A, VG, A.T)
        A = multiply(A, V)
        P = P + step
        largest = np.max(np.abs(P))
        if np.max(np.abs(step)) <= RICCATI_TOLERANCE * largest:
            return P
        if not largest < MAX_RICCATI:
            break
    raise SvsaError("The Riccati equation of a law's design has no stabilising solution.")
