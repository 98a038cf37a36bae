"""Initial values of the parameters: equations of motion in weak form, by least squares.

Every term of Eq 1 is filtered with the same Gaussian window; the derivatives are then applied to
the window, not to the encoder counts (as in weak-form regression, e.g. Messenger and Bortz 2021).
The result is linear in the parameters.
"""

import numpy as np
from scipy.ndimage import gaussian_filter1d

from svsa.analysis.identification.kernel import STATES, Parameters, compute_unit_torques
from svsa.analysis.identification.record import Evidence

_WINDOW_S = 0.012
_CREEP_RAD_PER_S = 0.05
_MIN = 1e-5
_SMOOTH_ROWS = 11
_SHAPE = {"static_ratio": 1.2, "stribeck": 0.1, "creep1": 0.02, "creep2": 0.02} | {
    "delay1": 0.0,
    "delay2": 0.0,
    "lever_error": 0.0,
}


def guess_states(evidence: Evidence) -> np.ndarray:
    """Estimate the states (rows, 6) from the smoothed measured angles."""
    angles, width = evidence.angles, 0.5 * _WINDOW_S / evidence.setting.period
    q = angles[:, 0] + angles[:, 2]
    states = np.empty((len(angles), STATES))
    for column, angle in enumerate((q, angles[:, 0], angles[:, 1])):
        states[:, 2 * column] = gaussian_filter1d(angle, width)
        states[:, 2 * column + 1] = _filter(angle, width, 1, evidence.setting.period)
    return states


def guess_noise(evidence: Evidence) -> np.ndarray:
    """Estimate the rms noise of θ1, θ2, φ as the residual of a smooth motion, (3,), rad."""
    from scipy.signal import savgol_filter  # imported here: the import is slow

    rough = evidence.angles - savgol_filter(evidence.angles, _SMOOTH_ROWS, 3, axis=0)
    return np.sqrt(np.mean(rough**2, axis=0))


def guess_parameters(evidence: Evidence) -> np.ndarray:
    """Estimate the vector of `Parameters`; unobservable ones have typical values.

    If the stiffness is known, K is near the one that is assumed: the lever ratio follows from it.
    """
    period = evidence.setting.period
    width = _WINDOW_S / period
    spring = np.empty((len(evidence.angles), 3))
    K = evidence.configuration.actuator.rotational_stiffness_nm_per_rad
    compute_unit_torques(evidence.setting, K, evidence.angles, spring)
    theta1, theta2, phi = evidence.angles.T
    q = theta1 + phi
    rows = _find_inner_rows(evidence, round(4 * width))

    def weigh(signal: np.ndarray, order: int = 0) -> np.ndarray:
        return _filter(signal, width, order, period)[rows]

    def compute_friction(angle: np.ndarray) -> np.ndarray:
        velocity = _filter(angle, width, 1, period)
        return weigh(np.tanh(velocity / _CREEP_RAD_PER_S))

    zero = np.zeros(len(rows))
    link, motor1, motor2 = (weigh(column) for column in spring.T)
    columns = {
        "M": (weigh(q, 2), zero, zero),
        "B1": (zero, weigh(theta1, 2), zero),
        "B2": (zero, zero, weigh(theta2, 2)),
        "D": (weigh(q, 1), zero, zero),
        "D1": (zero, weigh(theta1, 1), zero),
        "D2": (zero, zero, weigh(theta2, 1)),
        "K": (-link, -motor1, -motor2),
        "coulomb1": (zero, compute_friction(theta1), zero),
        "coulomb2": (zero, zero, compute_friction(theta2)),
        "gravity_moment": (weigh(np.sin(q)), zero, zero),
    }
    matrix = np.stack([np.concatenate(parts) for parts in columns.values()], 1)
    asked = np.concatenate([zero, *(weigh(u) for u in evidence.torques.asked.T)])
    scale = np.linalg.norm(matrix, axis=0) + 1e-12
    solution = np.linalg.lstsq(matrix / scale, asked, rcond=1e-9)[0] / scale
    estimates = dict(zip(columns, solution.tolist(), strict=True))
    moment = estimates.pop("gravity_moment")
    values = {name: max(value, _MIN) for name, value in estimates.items()} | _SHAPE
    return np.array(Parameters(**values, gravity_moment=moment))


def _filter(signal: np.ndarray, width: float, order: int, period: float) -> np.ndarray:
    return gaussian_filter1d(signal, width, order=order) / period**order


def _find_inner_rows(evidence: Evidence, margin: int) -> np.ndarray:
    """List the rows of the segments without those whose window exceeds an end."""
    rows = (evidence.segments[:, None] + np.arange(evidence.length)).ravel()
    return rows[(rows >= margin) & (rows < len(evidence.angles) - margin)]
