"""PD on both motors about the flat motion: `svsa.control.laws.pid` without integrals.

Tomei's PD of elastic joints. A load on the link deflects the spring, which the motor positions do
not show: the error is at least w2/σ.
"""

from svsa.control.law import Law, Setting
from svsa.control.laws.pid import Constants, Integrals, MotorGains, control
from svsa.control.laws.pid import build as build_pid
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity


class MotorPoles(LawParameters):
    """Poles of both motors, each with a virtual spring and damper."""

    motor1_rad_per_s: Number = quantity(
        "rad/s", "ω1 of the principal motor's loop", symbol="ω1", ge=1, le=300, default=107.8
    )
    motor1_damping: Number = quantity("1", "ζ1", symbol="ζ1", ge=0.05, le=5, default=1.05)
    motor2_rad_per_s: Number = quantity(
        "rad/s", "ω2 of the stiffness motor's loop", symbol="ω2", ge=1, le=300, default=103.7
    )
    motor2_damping: Number = quantity("1", "ζ2", symbol="ζ2", ge=0.05, le=5, default=0.7)


def build(parameters: MotorPoles, setting: Setting) -> Constants:
    """Build the constants of a PID without integrals and without link feedback."""
    without = {
        "position_integral_per_s": 0.0,
        "link_rad_per_s": 0.0,
        "stiffness_integral_per_s": 0.0,
    }
    return build_pid(MotorGains(**dict(parameters), **without), setting)


PD = Law(
    name="pd",
    title="PD",
    summary="A PD controller on each motor about the reference motion. A load leaves a"
    " steady-state error.",
    equation=r"u_i=u_{i,\mathrm{ff}}+B_i\,[\omega_i^2(\theta_{id}-\theta_i)"
    r"+2\zeta_i\omega_i(\dot\theta_{id}-\dot\theta_i)]",
    source='P. Tomei, "A simple PD controller for robots with elastic joints", '
    "https://ieeexplore.ieee.org/document/90238",
    parameters=MotorPoles,
    build=build,
    control=control,
    memory=Integrals,
)
