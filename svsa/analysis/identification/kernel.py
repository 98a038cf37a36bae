"""Compiled identification: simulation of the plant over a segment, and its sensitivities.

The equations are those of the simulated plant. All compiled functions of the identification are in
this file, because numba's cache detects a change only in this file.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator, compute_internal_torque
from svsa.actuators.lever import compute_lever_ratio_for_stiffness
from svsa.actuators.signals import State, Torque
from svsa.numerics.compilation import compiled
from svsa.numerics.fields import replace_field
from svsa.simulation.plant.effects import EffectConstants
from svsa.simulation.plant.effects.friction import FrictionConstants
from svsa.simulation.plant.integration import integrate_period
from svsa.simulation.plant.load_table import LoadTable, build_load_table
from svsa.simulation.plant.sensors import read_sensors

UNLOADED = build_load_table(())
STATES = 6
OUTPUTS = 3


class Setting(NamedTuple):
    """Known quantities.

    gamma and reaction are those of `Actuator`.

    Attributes:
        mu0: Lever ratio at θ2 = 0, 1; if `sigma` is known, the part of it that K does not change.
        sigma: Known stiffness at φ = 0, N·m/rad, whose lever ratio follows from K; 0 if the lever
            ratio itself is known.
        period: T, s.
        effects: Effects of the plant, with the lag of the current loop; friction and gravity moment
            of the link are estimated.
        loads: Loads on the plant.
    """

    gamma: float
    mu0: float
    sigma: float
    reaction: int
    period: float
    effects: EffectConstants
    loads: LoadTable


class Torques(NamedTuple):
    """Torques of both motors at every sample, (rows, 2), N·m: actual, and commanded until the
    next.
    """

    made: np.ndarray
    asked: np.ndarray


class Parameters(NamedTuple):
    """All estimated parameters, SI units, in the order of the vector.

    M to K are those of `Actuator`; coulomb to creep those of `compute_friction`.

    Attributes:
        gravity_moment: m g r of the link, N·m.
        delay1: Delay from a recorded torque to that of motor 1, s. Drives that receive commands one
            after the other have different delays.
        delay2: The same for motor 2, s.
        lever_error: Error of the known lever ratio, 1.
    """

    M: float
    B1: float
    B2: float
    D: float
    D1: float
    D2: float
    K: float
    coulomb1: float
    coulomb2: float
    static_ratio: float
    stribeck: float
    creep1: float
    creep2: float
    gravity_moment: float
    delay1: float
    delay2: float
    lever_error: float


@compiled
def build_parameters(p: np.ndarray) -> Parameters:
    """The vector of unknowns (17,) as `Parameters`."""
    return Parameters(
        p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], p[9], p[10], p[11], p[12], p[13],
        p[14], p[15], p[16],
    )  # fmt: skip


@compiled
def compute_mu0(setting: Setting, K: float) -> float:
    """The lever ratio μ at θ2 = 0 of a spring with K in N·m/rad (Eq 3 at φ = 0)."""
    if setting.sigma > 0.0:
        return setting.mu0 + compute_lever_ratio_for_stiffness(setting.sigma, K)
    return setting.mu0


@compiled
def compute_late_value(torques: np.ndarray, row: int, motor: int, shift: float) -> float:
    """Return a motor's recorded torque at the sample `row`, delayed.

    Args:
        torques: Shape (rows, 2), N·m.
        row: Number of the sample.
        motor: 0 or 1.
        shift: Delay in periods; interpolated linearly between two samples, constant beyond the
            ends.

    Returns:
        Torque, N·m.
    """
    whole = math.floor(shift)
    share = shift - whole
    last = torques.shape[0] - 1
    late = min(max(row - int(whole), 0), last)
    later = min(max(row - int(whole) - 1, 0), last)
    return (1.0 - share) * torques[late, motor] + share * torques[later, motor]


@compiled
def compute_shifted_torque(torques: np.ndarray, row: int, shift1: float, shift2: float) -> Torque:
    """Return both motors' `Torque` at the sample `row`, each delayed by its own periods."""
    return Torque(
        compute_late_value(torques, row, 0, shift1), compute_late_value(torques, row, 1, shift2)
    )


@compiled
def simulate(
    setting: Setting,
    p: np.ndarray,
    start: np.ndarray,
    torques: Torques,
    first: int,
    outputs: np.ndarray,
) -> None:
    """Simulate θ1, θ2, φ from the sample `first` on.

    Args:
        setting: Known quantities.
        p: `Parameters`, shape (17,).
        start: State at the first sample, shape (6,).
        torques: `Torques` of the whole record.
        first: First sample.
        outputs: Shape (samples, 3), rad, written.
    """
    c = build_parameters(p)
    mu0 = compute_mu0(setting, c.K) + c.lever_error
    actuator = Actuator(c.M, c.B1, c.B2, c.D, c.D1, c.D2, c.K, setting.gamma, mu0, setting.reaction)
    friction = FrictionConstants(
        c.coulomb1, c.coulomb2, c.coulomb1 * c.static_ratio, c.coulomb2 * c.static_ratio,
        c.stribeck, c.creep1, c.creep2,
    )  # fmt: skip
    effects = replace_field(setting.effects, "friction", friction)
    effects = replace_field(effects, "gravity", c.gravity_moment)
    x = State(start[0], start[1], start[2], start[3], start[4], start[5])
    shift1, shift2 = c.delay1 / setting.period, c.delay2 / setting.period
    for k in range(outputs.shape[0]):
        outputs[k, 0] = x.theta1
        outputs[k, 1] = x.theta2
        outputs[k, 2] = x.q - x.theta1
        made = compute_shifted_torque(torques.made, first + k, shift1, shift2)
        asked = compute_shifted_torque(torques.asked, first + k, shift1, shift2)
        x = integrate_period(
            actuator, effects, x, made, asked, setting.loads, first + k, setting.period, 1
        )


@compiled
def differentiate(
    setting: Setting,
    p: np.ndarray,
    start: np.ndarray,
    steps: np.ndarray,
    torques: Torques,
    first: int,
    outputs: np.ndarray,
    slopes: np.ndarray,
) -> None:
    """Simulate, with difference quotients by every parameter and by the initial state.

    Args:
        setting: Known quantities.
        p: `Parameters`, shape (17,).
        start: State at the first sample, shape (6,).
        steps: Steps of the quotients, shape (17 + 6,).
        torques: `Torques` of the whole record.
        first: First sample.
        outputs: Shape (samples, 3), written.
        slopes: Shape (17 + 6, samples, 3), written.
    """
    unknowns = p.shape[0]
    for i in range(-1, steps.shape[0]):
        moved, moved_start = p.copy(), start.copy()
        if 0 <= i < unknowns:
            moved[i] += steps[i]
        elif i >= unknowns:
            moved_start[i - unknowns] += steps[i]
        target = outputs if i < 0 else slopes[i]
        simulate(setting, moved, moved_start, torques, first, target)
        if i >= 0:
            for k in range(outputs.shape[0]):
                for m in range(OUTPUTS):
                    target[k, m] = (target[k, m] - outputs[k, m]) / steps[i]


@compiled
def compute_unit_torques(
    setting: Setting, K: float, angles: np.ndarray, torques: np.ndarray
) -> None:
    """Compute the torques of a spring divided by its K.

    Args:
        setting: Known quantities.
        K: K, N·m/rad, from which the lever ratio follows if the stiffness is known.
        angles: θ1, θ2, φ, rad, shape (rows, 3).
        torques: Shape (rows, 3), 1, written: `InternalTorque`.
    """
    mu0 = compute_mu0(setting, K)
    unit = Actuator(1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, setting.gamma, mu0, setting.reaction)
    for k in range(angles.shape[0]):
        theta1, theta2, phi = angles[k, 0], angles[k, 1], angles[k, 2]
        F = compute_internal_torque(unit, State(theta1 + phi, 0.0, theta1, 0.0, theta2, 0.0))
        torques[k, 0], torques[k, 1], torques[k, 2] = F.link, F.motor1, F.motor2


@compiled
def measure(
    effects: EffectConstants, first_tick: int, states: np.ndarray, measured: np.ndarray
) -> None:
    """Compute the sensor values of the true angles.

    Args:
        effects: `EffectConstants`.
        first_tick: Tick of the first row.
        states: θ1, θ2, φ, rad, shape (rows, 3).
        measured: Measured θ1, θ2, φ, rad, shape (rows, 3), written.
    """
    for k in range(states.shape[0]):
        theta1, theta2, phi = states[k, 0], states[k, 1], states[k, 2]
        x = State(theta1 + phi, 0.0, theta1, 0.0, theta2, 0.0)
        y = read_sensors(effects, x, first_tick + k)
        measured[k, 0], measured[k, 1], measured[k, 2] = y.theta1, y.theta2, y.phi
