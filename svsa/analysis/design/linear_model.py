"""The actuator as a linear system, for small motions about rest."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from svsa.actuators.dynamics import build_actuator
from svsa.actuators.lever import compute_lever_ratio_for_stiffness, compute_lever_ratio_slope
from svsa.actuators.parameters import ActuatorParameters
from svsa.actuators.signals import CHANNELS
from svsa.actuators.spring import compute_spring_derivatives
from svsa.inputs.checked import check_number
from svsa.runs.definition.design import Design
from svsa.runs.definition.design_file import load_prototype

STATES = (
    "position_rad",
    "velocity_rad_per_s",
    "motor1_position_rad",
    "motor1_velocity_rad_per_s",
    "motor2_position_rad",
    "motor2_velocity_rad_per_s",
)
INPUTS = (
    "torque1_nm",
    "torque2_nm",
    "disturbance_link_nm",
    "disturbance_motor1_nm",
    "disturbance_motor2_nm",
)
OUTPUTS = ("position_rad", "stiffness_nm_per_rad")


@dataclass(frozen=True, eq=False)
class LinearModel:
    """ẋ = A x + B u, y = C x + D u, all as differences from rest, in SI.

    The inputs are the motors' torques and w on link and motors. The model unpacks into the four
    matrices: `control.ss(*model)`.

    Attributes:
        A: Shape (6, 6).
        B: Shape (6, 5).
        C: Shape (2, 6).
        D: Shape (2, 5).
        lever_ratio: μ at rest, 1.
        states: Names of channels, with their units in `units`.
        inputs: Names of channels.
        outputs: Names of channels.
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray
    lever_ratio: float
    states: tuple[str, ...] = STATES
    inputs: tuple[str, ...] = INPUTS
    outputs: tuple[str, ...] = OUTPUTS

    def __iter__(self) -> Iterator[np.ndarray]:
        return iter((self.A, self.B, self.C, self.D))

    @property
    def units(self) -> dict[str, str]:
        """The unit of every state, input and output."""
        named = {*self.states, *self.inputs, *self.outputs}
        return {channel.name: channel.unit for channel in CHANNELS if channel.name in named}


def linearize(
    stiffness_nm_per_rad: float,
    design: Design | None = None,
    actuator: ActuatorParameters | None = None,
) -> LinearModel:
    """Linearize the plant of Eq 9 about rest without a load, φ = 0.

        M q̈  = −D q̇ − σ (q − θ1) + w2         B2 θ̈2 = −D2 θ̇2 + u2 + w6
        B1 θ̈1 = −D1 θ̇1 + σ (q − θ1) + u1 + w4        δσ = σ_μ μ' δθ2

    At φ = 0 the terms with ∂τ_e/∂μ, the reaction τ_r and ∂σ/∂φ are of second order.

    Args:
        stiffness_nm_per_rad: Stiffness σ at rest, N·m/rad.
        design: Limits and, unless `actuator` is given, the true actuator; by default the
            prototype's.
        actuator: The actuator to linearize. For the controller's model pass `design.nominal`.

    Returns:
        The matrices of the linear model.

    Raises:
        ParameterError: If the stiffness is outside the range of the limits.
    """
    design = design or load_prototype()
    limits = design.limits
    check_number(
        "stiffness_nm_per_rad",
        stiffness_nm_per_rad,
        "N·m/rad",
        limits.stiffness_min_nm_per_rad,
        limits.stiffness_max_nm_per_rad,
    )
    parameters = actuator or design.actuator
    K = parameters.rotational_stiffness_nm_per_rad
    mu = float(compute_lever_ratio_for_stiffness(stiffness_nm_per_rad, K))
    return linearize_at(parameters, mu)


def linearize_at(parameters: ActuatorParameters, mu: float) -> LinearModel:
    """`linearize` where the lever ratio at rest is known: μ = `mu`, whatever σ it gives."""
    K = parameters.rotational_stiffness_nm_per_rad
    constants = build_actuator(parameters, mu)
    spring = compute_spring_derivatives(mu, 0.0, K)
    M, B1, B2, D = constants.M, constants.B1, constants.B2, constants.D
    D1, D2, sigma = constants.D1, constants.D2, spring.sigma
    A, B, C = np.zeros((6, 6)), np.zeros((6, 5)), np.zeros((2, 6))
    A[0, 1] = A[2, 3] = A[4, 5] = 1.0
    A[1, [0, 1, 2]] = -sigma / M, -D / M, sigma / M
    A[3, [0, 2, 3]] = sigma / B1, -sigma / B1, -D1 / B1
    A[5, 5] = -D2 / B2
    B[1, 2] = 1.0 / M
    B[3, [0, 3]] = 1.0 / B1
    B[5, [1, 4]] = 1.0 / B2
    C[0, 0], C[1, 4] = 1.0, spring.sigma_mu * compute_lever_ratio_slope(constants.gamma)
    return LinearModel(A, B, C, np.zeros((2, 5)), mu)
