"""Stiffness of the tip of an arm from the stiffness of its joints."""

import itertools

import numpy as np
import numpy.typing as npt

STRAIGHT = 1e-6
"""Smallest sine between two links that is not straight or folded."""

Array = npt.NDArray[np.float64]


def compute_tip_stiffness(lengths: Array, q: Array, stiffness: Array) -> Array:
    """Compute the stiffness of the tip at rest, K = (J diag(1/σ) Jᵀ)⁻¹, without that of gravity.

    Args:
        lengths: Lengths of the links, (joints,), m.
        q: Angles of the joints, (ticks, joints), rad.
        stiffness: σ of each joint, (ticks, joints), N·m/rad.

    Returns:
        K, (ticks, 2, 2), N/m, of x to the right and y up. Infinite or NaN where the arm is straight
        or folded, because its tip does not move in one direction there; so everywhere for one link.
    """
    angles = np.cumsum(q, 1)
    outwards = (slice(None), slice(None, None, -1))
    jx, jy = (
        np.cumsum((lengths * along(angles))[outwards], 1)[outwards] for along in (np.cos, np.sin)
    )
    pairs = list(itertools.combinations(range(len(lengths)), 2))
    areas = [jx[:, i] * jy[:, j] - jx[:, j] * jy[:, i] for i, j in pairs]
    # Cauchy–Binet: a sum of squares, which the rounding of xx yy − xy² does not falsify.
    determinant, size = np.zeros(len(q)), np.zeros(len(q))
    with np.errstate(divide="ignore", invalid="ignore"):
        for area, (i, j) in zip(areas, pairs, strict=True):
            determinant += area**2 / (stiffness[:, i] * stiffness[:, j])
            size += area**2
        xx, xy, yy = (np.sum(a * b / stiffness, 1) for a, b in ((jx, jx), (jx, jy), (jy, jy)))
        straight = STRAIGHT * sum(lengths[i] * lengths[j] for i, j in pairs)
        determinant[np.sqrt(size) <= straight] = 0.0
        adjugate = np.stack([np.stack([yy, -xy], 1), np.stack([-xy, xx], 1)], 1)
        return adjugate / determinant[:, None, None]
