"""The fault that ended a run, with the values that violated a bound."""

from svsa.actuators.domain import (
    DEFLECTION_LIMIT,
    LEVER_END,
    NOT_FINITE,
    compute_deflection_limit,
    compute_relative_determinant_of,
)
from svsa.actuators.dynamics import compute_deflection
from svsa.actuators.elasticity import Actuator, compute_coordinate, compute_stiffness_of
from svsa.actuators.faults import FAULT_CODES
from svsa.actuators.lever import compute_zero_stiffness_deflection
from svsa.actuators.signals import State
from svsa.errors import Fault
from svsa.simulation.loop.lane import Blocks


def build_fault(code: int, lane: int, tick: int, blocks: Blocks, x: State, name: str = "") -> Fault:
    """Build the fault of the domain code `code` at the state x, with the violating values.

    `name` is the name of the lane, by its law, if there are several lanes.
    """
    values, message = _describe(code, tick * blocks.period, blocks, x)
    if name:
        message = f"{name}: {message}"
    return Fault(FAULT_CODES[code], lane, tick, tick * blocks.period, message, values)


def _describe(code: int, time: float, blocks: Blocks, x: State) -> tuple[dict[str, float], str]:
    values = {
        "position_rad": x.q,
        "velocity_rad_per_s": x.dq,
        "motor1_position_rad": x.theta1,
        "motor1_velocity_rad_per_s": x.dtheta1,
        "motor2_position_rad": x.theta2,
        "motor2_velocity_rad_per_s": x.dtheta2,
    }
    if code == NOT_FINITE:
        message = f"At {time:.3f} s a torque or a state was not a finite number: the run ended."
        return _keep_finite(values), message
    mu = compute_coordinate(blocks.plant, x.theta2)
    phi = compute_deflection(x)
    domain = blocks.domain
    values |= {"lever_ratio": mu, "deflection_rad": phi}
    is_svsa = isinstance(blocks.plant, Actuator)
    if code == LEVER_END:
        values |= {"lever_ratio_min": domain.mu_min, "lever_ratio_max": domain.mu_max}
        end = f"the lever ratio μ = {mu:.4f} reached the end of the spiral"
        if not is_svsa:
            end = f"the stiffness coordinate s = {mu:.4f} reached its end"
        message = (
            f"At {time:.3f} s {end}: it must"
            f" stay between {domain.mu_min:.4f} and {domain.mu_max:.4f}."
        )
        return values, message
    values["stiffness_nm_per_rad"] = compute_stiffness_of(blocks.plant, mu, phi)
    if code == DEFLECTION_LIMIT:
        limit = compute_deflection_limit(domain, blocks.plant, mu)
        values["deflection_limit_rad"] = limit
        message = (
            f"At {time:.3f} s the deflection φ = {phi:.4f} rad passed its limit of ±{limit:.4f} rad"
        )
        if is_svsa:
            zero = compute_zero_stiffness_deflection(mu)
            values["zero_stiffness_deflection_rad"] = zero
            message += f": at μ = {mu:.4f} the stiffness falls to zero at {zero:.4f} rad"
        message += "."
    else:
        share = compute_relative_determinant_of(blocks.plant, mu, phi)
        values["relative_determinant"] = share
        message = (
            f"At {time:.3f} s the decoupling matrix A(x) came near singular: det A is"
            f" {share:.4f} of its value at φ = 0, at least {domain.singularity_fraction:g} is"
            " needed."
        )
    return values, message


def _keep_finite(values: dict[str, float]) -> dict[str, float]:
    """Drop values that are not finite, which JSON cannot represent."""
    return {name: value for name, value in values.items() if abs(value) < float("inf")}
