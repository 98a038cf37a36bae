"""The spring: elastic torque, stiffness, energy and reaction torque (Eq 2, 3, 5).

In every function mu is the lever ratio μ (1, in (0, 1)), phi the deflection φ = q − θ1
(rad), K = K_s R² (N·m/rad), and n = 1 − μ cos φ.
"""

import math
from typing import NamedTuple

from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import log1p
from svsa.numerics.trigonometry import sin_versin

REACTION_ENERGY = 0
REACTION_PRINTED = 1


class SpringDerivatives(NamedTuple):
    """τ_e and its partial derivatives for the linearization (Eq 17–23).

    The suffix contains the variables of the derivative: torque_mu = ∂τ_e/∂μ, sigma_phiphi =
    ∂²σ/∂φ², …

    Attributes:
        torque: τ_e, N·m.
        sigma: ∂τ_e/∂φ, N·m/rad.
    """

    torque: float
    torque_mu: float
    torque_mumu: float
    sigma: float
    sigma_phi: float
    sigma_mu: float
    sigma_phiphi: float
    sigma_phimu: float
    sigma_mumu: float


class SpringTorques(NamedTuple):
    """τ_e, N·m, and ∂U/∂s, J per unit of s; ∂U/∂θ2 = κ ∂U/∂s."""

    torque: float
    reaction: float


class SpringState(NamedTuple):
    """The spring at one state: torques, stiffness and derivatives."""

    torques: SpringTorques
    derivatives: SpringDerivatives


class StiffnessMargin(NamedTuple):
    """The plant's stiffness and torques at the beginning of a tick.

    Attributes:
        torques: τ_e and τ_r, N·m.
        sigma: σ, N·m/rad.
        determinant: (σ σ_s − τ_s σ_φ) over its value at φ = 0; det A(x) is a multiple of it.
    """

    torques: SpringTorques
    sigma: float
    determinant: float


class Spring(NamedTuple):
    """Subexpressions of lever and spring that all spring functions share.

    Attributes:
        mu: μ, 1.
        s: sin φ.
        c: cos φ.
        d: 1 − cos φ.
        i: 1/n.
        j: 1/(1 − μ).
    """

    mu: float
    s: float
    c: float
    d: float
    i: float
    j: float


@compiled
def compute_spring(mu: float, phi: float) -> Spring:
    """`Spring` at μ and φ, |φ| ≤ π/4, accurate to the last digits; one division for both
    reciprocals.

    For every μ the stiffness is zero at less than π/4, so that no run leaves this range.
    """
    s, d = sin_versin(phi)
    m = 1.0 - mu
    n = m + mu * d
    r = 1.0 / (m * n)
    return Spring(mu, s, 1.0 - d, d, r * m, r * n)


@compiled
def compute_elastic_torque(mu: float, phi: float, K: float) -> float:
    """τ_e = K μ² sin φ cos φ / (1 − μ cos φ)², N·m, Eq 2. Positive pulls q back."""
    p = compute_spring(mu, phi)
    return K * mu * mu * p.s * p.c * (p.i * p.i)


@compiled
def compute_stiffness(mu: float, phi: float, K: float) -> float:
    """σ = ∂τ_e/∂φ = K μ² (cos 2φ − μ cos φ) / (1 − μ cos φ)³, N·m/rad, Eq 3."""
    p = compute_spring(mu, phi)
    return K * mu * mu * (2.0 * p.c * p.c - 1.0 - mu * p.c) * (p.i * p.i * p.i)


@compiled
def compute_elastic_energy(mu: float, phi: float, K: float) -> float:
    """V = K [1/(1−μ) − 1/n + ln((1−μ)/n)], J; zero at φ = 0, ∂V/∂φ = τ_e exactly.

    Computed with ε = μ(1 − cos φ)/(1 − μ), which avoids cancellation at small deflection.
    """
    p = compute_spring(mu, phi)
    epsilon = mu * p.d * p.j
    return K * (epsilon * p.j / (1.0 + epsilon) - log1p(epsilon))


@compiled
def compute_reaction_torque(mu: float, phi: float, K: float, gamma: float) -> float:
    """τ_r = ∂V/∂θ2 = K μ [1/(1−μ)² − cos²φ/n²] / (2πγ) ≥ 0, N·m; replaces Eq 5.

    Computed with 1/(1−μ) − cos φ/n = (1 − cos φ)/((1−μ) n), which avoids cancellation.

    Args:
        mu: μ, 1.
        phi: φ, rad.
        K: K_s R², N·m/rad.
        gamma: Reduction γ of the spiral, 1.

    Returns:
        τ_r, N·m.
    """
    p = compute_spring(mu, phi)
    slope = 1.0 / (2.0 * math.pi * gamma)
    return K * mu * p.d * (p.j + p.c * p.i) * (p.j * p.i) * slope


@compiled
def compute_printed_reaction_torque(mu: float, phi: float, K: float) -> float:
    """τ_r as printed in Eq 5, times R and positive, N·m; for comparison only.

    R K_s R² a² |sin 2β| sin²φ / [2 (R − a cos φ)(a² + R² − 2 a R cos φ)] with a = μR and
    β = arctan(−2πμ), the tangent angle of the spiral; R cancels.
    """
    t = 2.0 * math.pi * mu
    sin_2beta = 2.0 * t / (1.0 + t * t)
    p = compute_spring(mu, phi)
    square = 1.0 + mu * mu - 2.0 * mu * p.c
    return K * mu * mu * sin_2beta * p.s * p.s * p.i / (2.0 * square)


@compiled
def compute_spring_derivatives(mu: float, phi: float, K: float) -> SpringDerivatives:
    """All of `SpringDerivatives` by the quotient rule on Eq 2 and 3.

    τ_e = K μ² S/n² with S = sin φ cos φ; σ = K μ² N/n³ with N = cos 2φ − μ cos φ;
    ∂τ_e/∂μ = 2Kμ S/n³; ∂²τ_e/∂μ² = 2K S (1 + 2μ cos φ)/n⁴.
    """
    p = compute_spring(mu, phi)
    s, c = p.s, p.c
    S = s * c
    S1 = c * c - s * s
    S2 = -4.0 * S
    n1 = mu * s
    n2 = mu * c
    N = S1 - mu * c
    N1 = S2 + mu * s
    N2 = -4.0 * S1 + mu * c
    i2 = p.i * p.i
    i3, i4 = i2 * p.i, i2 * i2
    i5 = i4 * p.i
    Kmu2 = K * mu * mu
    Q = 2.0 * K * mu
    return SpringDerivatives(
        torque=Kmu2 * S * i2,
        torque_mu=Q * S * i3,
        torque_mumu=2.0 * K * S * (1.0 + 2.0 * mu * c) * i4,
        sigma=Kmu2 * N * i3,
        sigma_phi=Kmu2 * (N1 * i3 - 3.0 * N * n1 * i4),
        sigma_mu=Q * (S1 * i3 - 3.0 * S * n1 * i4),
        sigma_phiphi=Kmu2
        * (N2 * i3 - (6.0 * N1 * n1 + 3.0 * N * n2) * i4 + 12.0 * N * n1 * n1 * i5),
        sigma_phimu=Q * (S2 * i3 - (6.0 * S1 * n1 + 3.0 * S * n2) * i4 + 12.0 * S * n1 * n1 * i5),
        sigma_mumu=2.0
        * K
        * (
            (S1 * (1.0 + 2.0 * mu * c) - 2.0 * S * n1) * i4
            - 4.0 * S * (1.0 + 2.0 * mu * c) * n1 * i5
        ),
    )


@compiled
def compute_stiffness_slope(mu: float, K: float, slope: float) -> float:
    """g = ∂σ/∂θ2 at φ = 0, which is 2 K μ μ'/(1 − μ)³.

    Args:
        mu: μ, 1.
        K: K_s R², N·m/rad.
        slope: μ', 1/rad.

    Returns:
        g, N·m/rad².
    """
    return compute_spring_derivatives(mu, 0.0, K).sigma_mu * slope
