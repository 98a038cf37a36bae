"""Derivatives of a function of an array, by differences."""

from collections.abc import Callable

import numpy as np

_STEP = 1e-6


def differentiate(
    function: Callable[[np.ndarray], np.ndarray], at: np.ndarray, step: float = _STEP
) -> np.ndarray:
    """The Jacobian at a point, (values, arguments), by central differences."""
    return differentiate_both(function, at, step)[0]


def differentiate_both(
    function: Callable[[np.ndarray], np.ndarray], at: np.ndarray, step: float = _STEP
) -> tuple[np.ndarray, np.ndarray]:
    """`differentiate`, and how much the derivatives to both sides differ, of the same shape."""
    middle, steps = function(at)[:, np.newaxis], step * np.eye(len(at))
    ahead = np.column_stack([function(at + offset) for offset in steps])
    behind = np.column_stack([function(at - offset) for offset in steps])
    return (ahead - behind) / (2.0 * step), np.abs(ahead + behind - 2.0 * middle) / step
