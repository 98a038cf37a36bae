"""PD on the motors: the link follows through its spring, without a model of it."""

from typing import NamedTuple

from svsa.actuators.lever import compute_lever_ratio_for_stiffness, compute_lever_ratio_slope
from svsa.actuators.signals import Torque
from svsa.control.law import Law, Setting
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled


class MotorPdParameters(LawParameters):
    """Bandwidth and damping of both motors."""

    frequency_rad_per_s: Number = quantity(
        "rad/s", "Natural frequency ω of both motors", symbol="ω", ge=1, le=150, default=60.0
    )
    damping: Number = quantity(
        "1", "Damping ratio ζ of both motors", symbol="ζ", ge=0.1, le=3, default=1.0
    )


class Constants(NamedTuple):
    """kp: ω², s⁻². kd: 2ζω, s⁻¹."""

    kp: float
    kd: float


def build(parameters: MotorPdParameters, setting: Setting) -> Constants:
    """The gains of s² + 2ζω s + ω²."""
    frequency = parameters.frequency_rad_per_s
    return Constants(frequency**2, 2.0 * parameters.damping * frequency)


@compiled
def control(nominal, gains, memory, x, reference, estimate, applied, period):
    """u = B (kp (θ_d − θ) + kd (θ̇_d − θ̇)), θ1_d = q_d, θ2_d where σ = σ_d at φ = 0."""
    mu = compute_lever_ratio_for_stiffness(reference.sigma, nominal.K)
    theta2 = (mu - nominal.mu0) / compute_lever_ratio_slope(nominal.gamma)
    u1 = gains.kp * (reference.q - x.theta1) + gains.kd * (reference.dq - x.dtheta1)
    u2 = gains.kp * (theta2 - x.theta2) - gains.kd * x.dtheta2
    return Torque(nominal.B1 * u1, nominal.B2 * u2)


MOTOR_PD = Law(
    name="motor_pd",
    title="PD",
    summary="Each motor is a spring and a damper about where it should be.",
    equation=r"u_i=B_i\,\bigl(\omega^2(\theta_{id}-\theta_i)"
    r"+2\zeta\omega(\dot\theta_{id}-\dot\theta_i)\bigr)",
    source="",
    parameters=MotorPdParameters,
    build=build,
    control=control,
    rejects_feedforward=True,
)
