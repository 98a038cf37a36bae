"""The linearized closed loop about rest in continuous time, with plant ≠ nominal model.

    ẋ = A x + B (u + w)                              the true plant
    u = Kx x + Kŵ ŵ + Km m + Ku u                    the law, on the nominal model
    ŵ̇ = β (J_n v̇ − F_n x − u − ŵ)                    the observer, Eq 10
    ṁ = Rx x + Rŵ ŵ + Rm m + Ru u                    the memory of the law

A, B and F_n have closed forms; the derivatives of the law are finite differences.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.lever import compute_lever_ratio_for_stiffness
from svsa.actuators.parameters import ActuatorParameters
from svsa.actuators.signals import Disturbance, State, Torque
from svsa.analysis.design.differences import differentiate
from svsa.analysis.design.linear_model import linearize_at
from svsa.analysis.design.sampled_loop import find_rest
from svsa.control.call import build_call
from svsa.control.installed import get_law
from svsa.control.law import Setting
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from svsa.simulation.loop.loop import decide
from svsa.simulation.plant.effects import IDEAL
from svsa.simulation.plant.sensors import build_positions
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness

_INSTANT_S = 1e-5
_LASTING = 0.1
_VELOCITIES = (1, 3, 5)
_MOTORS = (1, 2)


class LawDerivatives(NamedTuple):
    """A law about rest. torque (2, n) and rate (m, n) over (x, ŵ, u applied, its m memories)."""

    torque: np.ndarray
    rate: np.ndarray


class ClosedLoop:
    """ż = A z + B w, e = C z for small motions about rest.

    z = (x, ŵ if the law uses that of the observer, memory of the law).

    Attributes:
        A: Shape (n, n).
        B: Shape (n, 3), for w on link, motor 1 and motor 2, N·m.
        C: Shape (2, n), for q_d − q, rad, and σ_d − σ, N·m/rad.
    """

    def __init__(self, A: np.ndarray, B: np.ndarray, C: np.ndarray) -> None:
        self.A, self.B, self.C = A, B, C

    @property
    def poles(self) -> np.ndarray:
        """The eigenvalues of A, rad/s, slowest first."""
        eigenvalues = sorted(
            map(complex, np.linalg.eigvals(self.A)), key=lambda s: (-s.real, s.imag)
        )
        return np.array(eigenvalues)

    @property
    def slowest(self) -> float:
        """The largest real part, rad/s; below zero the loop is stable: Hurwitz."""
        return float(np.max(np.real(self.poles)))

    @property
    def is_hurwitz(self) -> bool:
        """Whether all small motions about rest decay."""
        return self.slowest < 0.0

    @property
    def least_damping(self) -> float:
        """The least of −Re s / |s|: 1 without oscillation, below 0 unstable."""
        return float(np.min(-np.real(self.poles) / np.maximum(np.abs(self.poles), 1e-12)))


def linearize_loop(configuration: Configuration, sigma: float) -> ClosedLoop:
    """Linearize the closed loop of a configuration's first lane about rest.

    Args:
        configuration: The run; its first lane, plant, nominal model and effects are used.
        sigma: Stiffness σ_d at rest, N·m/rad.

    Returns:
        The linear closed loop.

    Raises:
        ParameterError: If the law cannot be linearized, or σ_d is outside the stiffness range.
    """
    return connect(configuration, sigma, linearize_law(configuration, sigma))


def connect(
    configuration: Configuration,
    sigma: float,
    law: LawDerivatives,
    actuator: ActuatorParameters | None = None,
) -> ClosedLoop:
    """Connect a linearized law to the true plant.

    At rest the controller has the nominal σ at σ_d, which determines μ.

    Args:
        configuration: The run.
        sigma: σ_d, N·m/rad.
        law: The linearized law.
        actuator: The true actuator; by default that of the configuration.

    Returns:
        The closed loop.

    Raises:
        ParameterError: If the law is not installed.
    """
    c = configuration
    K = c.nominal.rotational_stiffness_nm_per_rad
    mu = float(compute_lever_ratio_for_stiffness(sigma, K))
    plant, nominal = linearize_at(actuator or c.actuator, mu), linearize_at(c.nominal, mu)
    observed = 3 if get_law(c.law).estimate == "observer" else 0
    count = 9 + len(law.rate)
    kept = [*range(6 + observed), *range(9, count)]

    states = np.eye(count)
    inner = np.delete(np.arange(11 + len(law.rate)), (9, 10))
    solve = np.linalg.inv(np.eye(2) - law.torque[:, 9:11])
    u = solve @ law.torque[:, inner]
    dx = plant.A @ states[:6] + plant.B[:, :2] @ u
    dw = plant.B[:, 2:]
    J = np.array([c.nominal.link_inertia_kg_m2, c.nominal.motor1_inertia_kg_m2])
    J = np.append(J, c.nominal.motor2_inertia_kg_m2)[:, np.newaxis]
    beta = np.array(c.observer.bandwidth_rad_per_s)[:, np.newaxis]
    F = J * nominal.A[_VELOCITIES, :] @ states[:6]
    unexplained = J * dx[_VELOCITIES, :] - F
    unexplained[_MOTORS, :] -= u
    destimate = beta * (unexplained - states[6:9])
    dmemory = law.rate[:, inner] + law.rate[:, 9:11] @ u
    A = np.vstack([dx, destimate, dmemory])[np.ix_(kept, kept)]
    B = np.vstack([dw, beta * J * dw[_VELOCITIES, :], np.zeros((len(dmemory), 3))])[kept]
    C = -plant.C @ states[:6][:, kept]
    return ClosedLoop(A, B, C)


def linearize_law(configuration: Configuration, sigma: float) -> LawDerivatives:
    """Linearize a law's torque and the rate of its memory about rest, by central differences.

    The law is called as in the loop, without limits and with a period so short that its memory
    changes as in continuous time. Parts of the memory that never change, or change only from one
    tick to the next, are no states and are left out.
    """
    c = configuration.changed(
        position=ConstantPosition(),
        stiffness=ConstantStiffness(stiffness_nm_per_rad=sigma),
        actuator=configuration.nominal,
        effects=IDEAL.changed(torque_limits=False),
        comparisons=(),
        loads=(),
    )
    run = Run(c)
    b = run.blocks[0]._replace(period=_INSTANT_S)
    installed = get_law(c.law)
    setting = Setting(b.nominal, b.domain, math.inf, math.inf, b.period)
    law = installed.bind(c.get_parameters(c.lanes[0]), setting)
    start = find_rest(run).memory

    def respond(z: np.ndarray) -> np.ndarray:
        memory = z[11:].copy()
        values = z.tolist()
        known, estimate = State(*values[:6]), Disturbance(*values[6:9])
        measured, applied = build_positions(known), Torque(*values[9:11])
        call = build_call(law, memory)
        _, torque = decide(b, call, run.inputs, known, estimate, applied, measured, 0)
        return np.concatenate([torque, (memory - z[11:]) / _INSTANT_S])

    jacobian = differentiate(respond, np.concatenate([np.zeros(11), start]))
    own = jacobian[2:, 11:]
    rates = np.abs(np.diag(own)) * _INSTANT_S
    is_moved = np.any(np.abs(jacobian[2:]) > 1e-4, axis=1)
    lasting = np.flatnonzero(is_moved & (rates < _LASTING))
    columns = np.concatenate([np.arange(11), 11 + lasting])
    return LawDerivatives(jacobian[:2][:, columns], jacobian[2:][np.ix_(lasting, columns)])
