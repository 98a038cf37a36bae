"""The lever: stiffness motor angle ↔ lever ratio μ ↔ stiffness at zero deflection (Eq 4)."""

import math

from svsa.numerics.compilation import compiled
from svsa.numerics.trigonometry import acos


@compiled
def compute_lever_ratio(theta2: float, mu0: float, gamma: float) -> float:
    """μ = μ0 + θ2 / (2πγ), Eq 4.

    Args:
        theta2: Angle of the stiffness motor at the gearbox output, rad.
        mu0: μ at θ2 = 0, 1.
        gamma: Reduction γ of the spiral, 1.

    Returns:
        μ, 1.
    """
    return mu0 + theta2 * compute_lever_ratio_slope(gamma)


@compiled
def compute_lever_ratio_slope(gamma: float) -> float:
    """μ' = dμ/dθ2 = 1 / (2πγ), 1/rad (from Eq 4)."""
    return 1.0 / (2.0 * math.pi * gamma)


@compiled
def compute_lever_ratio_for_stiffness(sigma: float, K: float) -> float:
    """The μ whose stiffness at φ = 0 is σ: μ = r/(1 + r), r = √(σ/K) (Eq 3 at φ = 0).

    Args:
        sigma: σ, N·m/rad, ≥ 0.
        K: K_s R², N·m/rad, > 0.

    Returns:
        μ in [0, 1).
    """
    r = math.sqrt(sigma / K)
    return r / (1.0 + r)


@compiled
def compute_zero_stiffness_deflection(mu: float) -> float:
    """The |φ| at which σ reaches zero: cos 2φ = μ cos φ (numerator of Eq 3).

    With c = cos φ: 2c² − μc − 1 = 0, c = (μ + √(μ² + 8))/4. Beyond this angle the stiffness is
    negative.

    Args:
        mu: Lever ratio in [0, 1).

    Returns:
        Angle, rad, positive.
    """
    return acos((mu + math.sqrt(mu * mu + 8.0)) / 4.0)
