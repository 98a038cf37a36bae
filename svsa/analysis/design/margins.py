"""Stability margins of the sampled loop about rest, defined equally for all laws.

The loop is opened where the motors' torque reaches the plant, u = C z and z' = A z + B d of
`SampledLoop`; neither the observer nor the law receives d:

    S(z) = I + C (zI − A)⁻¹ B        d → u + d, both motors, 2 × 2
    L(z) = S⁻¹ − I = −C (zI − A + B C)⁻¹ B

Torque limits, counts, noise and friction are left out, as in `linearize_tick`: the margins are
valid for small motions, while neither torque is at its limit.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.lever import compute_lever_ratio_for_stiffness
from svsa.analysis.design.linear_model import linearize_at
from svsa.analysis.design.robustness import PARAMETERS, find_end
from svsa.analysis.design.sampled_loop import SampledLoop, compute_radius, linearize_tick
from svsa.runs.definition.configuration import Configuration

JOINT = (
    "link_inertia_kg_m2",
    "motor1_inertia_kg_m2",
    "motor2_inertia_kg_m2",
    "spring_stiffness_n_per_m",
)
SYMBOLS = tuple(PARAMETERS[name] for name in JOINT)
MIN_GAIN, MAX_GAIN = 0.01, 100.0
MIN_ERROR, MAX_ERROR = -0.95, 4.0
KINK = 0.5
_NEUTRAL = 1e-6
_MIN_HZ, _FREQUENCIES = 0.01, 2000
_RADII = np.geomspace(0.05, 2.0 * MAX_ERROR, 32)
_STARTS, _STEPS, _CLOSE = 4, 30, 1e-4


@dataclass(frozen=True)
class GainRange:
    """Factors on one torque for which the loop stays stable, with the other torque unchanged.

    Attributes:
        low: Lower end of the stable range; None if stable down to 0.01.
        high: Upper end of the stable range; None if stable up to 100.
    """

    low: float | None
    high: float | None


class JointError(NamedTuple):
    """True over nominal minus 1 of M, B1, B2 and K (`SYMBOLS`) at which the loop is not stable."""

    errors: tuple[float, ...]

    @property
    def norm(self) -> float:
        """Norm √(Σ error²) of the relative errors of the parameters, 1."""
        return math.hypot(*self.errors)


class Margins(NamedTuple):
    """Margins of a law at one σ.

    If the loop is unstable, modulus and delay are 0, and gains and error None.

    Attributes:
        radius: Largest |z| of the loop's poles, 1.
        modulus: Modulus margin 1/‖S‖∞, at most 1.
        delay_s: Smallest additional delay of both torques, unknown to the observer, that makes the
            loop unstable, s; None if there is none.
        gain1: Gain range of u1.
        gain2: Gain range of u2.
        error: Smallest joint error that was found, None if there is none up to `MAX_ERROR`.
        kink: See `SampledLoop`.
    """

    radius: float
    modulus: float
    delay_s: float | None
    gain1: GainRange | None
    gain2: GainRange | None
    error: JointError | None
    kink: float

    @property
    def is_stable(self) -> bool:
        """Whether the loop is stable; constant memory counts as stable."""
        return _is_stable(self.radius)

    @property
    def is_switching(self) -> bool:
        """Whether the law switches at rest (no derivative); the margins are then of an average."""
        return self.kink > KINK

    def to_json(self) -> dict[str, Any]:
        """Convert to numbers named with their units; null for missing ones."""
        return {
            "is_stable": self.is_stable,
            "is_switching": self.is_switching,
            "largest_pole": self.radius,
            "modulus": self.modulus,
            "delay_s": self.delay_s,
            "torque1_gain": self.gain1 and vars(self.gain1),
            "torque2_gain": self.gain2 and vars(self.gain2),
            "joint_error": self.error and self.error.norm,
            "joint_errors": self.error and dict(zip(SYMBOLS, self.error.errors, strict=True)),
        }


def compute_margins(
    configuration: Configuration, sigma: float, seeks_error: bool = True
) -> Margins:
    """Compute the margins of a configuration's first lane about rest.

    Modulus, delay and gain margins are those of the loop with the configuration's own plant; the
    joint error is relative to the nominal model.

    Args:
        configuration: The run.
        sigma: σ_d, N·m/rad.
        seeks_error: Whether to search the joint error, which takes about a second.

    Returns:
        The margins.
    """
    loop = _close(linearize_tick(configuration, sigma))
    radius = loop.radius
    if not _is_stable(radius):
        return Margins(radius, 0.0, 0.0, None, None, None, loop.kink)
    period = configuration.sampling.period_s
    omega = np.geomspace(2.0 * math.pi * _MIN_HZ, math.pi / period, _FREQUENCIES)
    S = compute_sensitivity(loop, omega * period)
    worst = float(np.max(np.linalg.norm(S, 2, axis=(1, 2))))
    gain1, gain2 = (_find_gains(loop, motor) for motor in (0, 1))
    return Margins(
        radius,
        1.0 / worst,
        _find_delay(omega, np.linalg.inv(S) - np.eye(2)),
        gain1,
        gain2,
        find_joint_error(configuration, sigma) if seeks_error else None,
        loop.kink,
    )


def compute_sensitivity(loop: SampledLoop, angle: np.ndarray) -> np.ndarray:
    """S(e^{jωT}) at ωT = `angle`, rad, of shape (n,); returns (n, 2, 2)."""
    shifts = np.exp(1j * angle)[:, np.newaxis, np.newaxis] * np.eye(len(loop.A))
    return np.eye(2) + loop.C @ np.linalg.solve(shifts - loop.A, loop.W[np.newaxis, :, 1:])


def _is_stable(radius: float) -> bool:
    return radius < 1.0 + _NEUTRAL


def _close(loop: SampledLoop) -> SampledLoop:
    """Remove the states outside the feedback loop, which do not affect a margin."""
    kept = loop.closing
    A, C = loop.A[np.ix_(kept, kept)], loop.C[:, kept]
    return loop._replace(
        A=A, B=loop.B[kept], W=loop.W[kept], X=loop.X[kept], C=C, closing=np.arange(len(kept))
    )


def _find_gains(loop: SampledLoop, motor: int) -> GainRange:
    b, c = loop.W[:, 1 + motor], loop.C[motor]

    def is_stable(gain: float) -> bool:
        return _is_stable(compute_radius(loop.A + (gain - 1.0) * np.outer(b, c)))

    return GainRange(find_end(is_stable, MIN_GAIN), find_end(is_stable, MAX_GAIN))


def _find_delay(omega: np.ndarray, L: np.ndarray) -> float | None:
    """The smallest τ, s, with det(I + L e^{−jωτ}) = 0: an eigenvalue of L is −e^{jωτ}.

    Between two frequencies modulus and angle of the eigenvalues are interpolated.
    """
    eigenvalues = np.linalg.eigvals(L)
    for pair, last in zip(eigenvalues[1:], eigenvalues[:-1], strict=True):
        if np.sum(np.abs(pair[::-1] - last)) < np.sum(np.abs(pair - last)):
            pair[:] = pair[::-1]
    size = np.log(np.maximum(np.abs(eigenvalues), np.finfo(float).tiny))
    angle = np.unwrap(np.angle(-eigenvalues), axis=0)
    delays = []
    for motor in (0, 1):
        for at in np.flatnonzero(size[1:, motor] * size[:-1, motor] < 0.0):
            share = size[at, motor] / (size[at, motor] - size[at + 1, motor])
            turn = angle[at, motor] + share * (angle[at + 1, motor] - angle[at, motor])
            delays.append(
                turn % (2.0 * math.pi) / (omega[at] + share * (omega[at + 1] - omega[at]))
            )
    return float(min(delays)) if delays else None


def find_joint_error(configuration: Configuration, sigma: float) -> JointError | None:
    """Find the smallest joint error of M, B1, B2 and K that makes the loop about rest unstable.

    The smallest √(Σ error²) with errors from `MIN_ERROR` to `MAX_ERROR` relative to the nominal
    model. A deterministic search: 80 directions of the corners, edges and axes, then, from the best
    of them, repeatedly the nearest point of the tangent plane of radius = 1 (Hasofer–Lind). The
    result destabilises the loop; it is not proven that no smaller one does.

    Returns:
        The error, or None if none was found or the nominal loop itself is not stable.
    """
    nominal = configuration.changed(actuator=configuration.nominal)
    loop = _close(linearize_tick(nominal, sigma))
    if not _is_stable(loop.radius):
        return None
    build = _build_perturbed(nominal, sigma, loop)

    def find_crossing(direction: np.ndarray) -> np.ndarray | None:
        inside = 0.0
        for radius in _RADII:
            errors = radius * direction
            if np.any((errors < MIN_ERROR) | (errors > MAX_ERROR)):
                return None
            if not _is_stable(compute_radius(build(errors))):
                outside = radius
                while outside - inside > _CLOSE * outside:
                    middle = 0.5 * (inside + outside)
                    if _is_stable(compute_radius(build(middle * direction))):
                        inside = middle
                    else:
                        outside = middle
                return outside * direction
            inside = radius
        return None

    signs = [
        np.array(direction)
        for direction in product((-1.0, 0.0, 1.0), repeat=len(JOINT))
        if any(direction)
    ]
    crossings = [find_crossing(direction / np.linalg.norm(direction)) for direction in signs]
    starts = sorted(
        (crossing for crossing in crossings if crossing is not None), key=np.linalg.norm
    )
    minima = [_descend(build, find_crossing, start) for start in starts[:_STARTS]]
    if not minima:
        return None
    return JointError(tuple(min(minima, key=np.linalg.norm).tolist()))


def _descend(
    build: Callable[[np.ndarray], np.ndarray],
    find_crossing: Callable[[np.ndarray], np.ndarray | None],
    errors: np.ndarray,
) -> np.ndarray:
    """From one crossing to a nearer one, along the gradient of the radius there."""
    share = 1.0
    for _ in range(_STEPS):
        here = compute_radius(build(errors))
        ahead = [compute_radius(build(errors + offset)) for offset in _CLOSE * np.eye(len(errors))]
        gradient = np.array(ahead) - here
        size = np.linalg.norm(gradient)
        if size == 0.0 or share < _CLOSE:
            break
        target = (1.0 - share) * errors / np.linalg.norm(errors) + share * gradient / size
        nearer = find_crossing(target / np.linalg.norm(target))
        if nearer is not None and np.linalg.norm(nearer) < np.linalg.norm(errors):
            errors = nearer
        else:
            share *= 0.5
    return errors


def _build_perturbed(
    configuration: Configuration, sigma: float, loop: SampledLoop
) -> Callable[[np.ndarray], np.ndarray]:
    """A of the loop as a function of the relative errors of `JOINT`, (4,).

    Only the step of the plant changes, x' = Φ x + Γ u: A + X (ΔΦ x + ΔΓ C), where x are the first
    six states. Φ and Γ are those of the simulated plant's Runge–Kutta step.
    """
    nominal = configuration.nominal
    mu = float(compute_lever_ratio_for_stiffness(sigma, nominal.rotational_stiffness_nm_per_rad))
    gravity = configuration.effects.gravity
    moment = gravity.moment_nm if gravity else 0.0
    unit, h = np.eye(6), configuration.sampling.period_s

    def step(errors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        changed = {
            name: (1.0 + error) * getattr(nominal, name)
            for name, error in zip(JOINT, errors.tolist(), strict=True)
        }
        actuator = nominal.model_copy(update=changed)
        model = linearize_at(actuator, mu)
        A, B = model.A.copy(), model.B[:, :2]
        A[1, 0] -= moment / actuator.link_inertia_kg_m2
        mean = h * (unit + h / 2.0 * A @ (unit + h / 3.0 * A @ (unit + h / 4.0 * A)))
        return unit + mean @ A, mean @ B

    before = step(np.zeros(len(JOINT)))

    def build(errors: np.ndarray) -> np.ndarray:
        transition, response = step(errors)
        change = (response - before[1]) @ loop.C
        change[:, :6] += transition - before[0]
        return loop.A + loop.X @ change

    return build
