"""Derivatives of a function of an array, by differences."""

from collections.abc import Callable

import numpy as np

_STEP = 1e-6


def differentiate(function: Callable[[np.ndarray], np.ndarray], at: np.ndarray) -> np.ndarray:
    """The Jacobian at a point, (values, arguments), by central differences."""
    steps = _STEP * np.eye(len(at))
    columns = [(function(at + step) - function(at - step)) / (2.0 * _STEP) for step in steps]
    return np.column_stack(columns)
