"""The mechanical stops: of the lever's travel and of the deflection, hit without rebound."""

from typing import NamedTuple

from svsa.actuators.signals import State
from svsa.numerics.compilation import compiled


class Stops(NamedTuple):
    """Between which the mechanism moves. theta2_min, theta2_max, deflection_max: rad."""

    theta2_min: float
    theta2_max: float
    deflection_max: float


@compiled
def hit_stops(stops: Stops, x: State, inertia: float, inertia1: float) -> State:
    """The state after an inelastic hit, or x as it is between the stops.

    The stiffness motor stands still at its stop. At the stop of the deflection link and
    principal motor go on with the velocity of their common momentum. stops: `Stops`. x:
    `State`. inertia: of the link with what hangs on it, inertia1: of motor 1, kg·m².
    """
    q, dq, theta1, dtheta1 = x.q, x.dq, x.theta1, x.dtheta1
    theta2, dtheta2 = x.theta2, x.dtheta2
    if theta2 < stops.theta2_min:
        theta2, dtheta2 = stops.theta2_min, max(dtheta2, 0.0)
    elif theta2 > stops.theta2_max:
        theta2, dtheta2 = stops.theta2_max, min(dtheta2, 0.0)
    phi = q - theta1
    excess = phi - min(max(phi, -stops.deflection_max), stops.deflection_max)
    if excess != 0.0:
        share = inertia1 / (inertia + inertia1)
        q -= share * excess
        theta1 += (1.0 - share) * excess
        if (dq - dtheta1) * excess > 0.0:
            dq = dtheta1 = (1.0 - share) * dq + share * dtheta1
    return State(q, dq, theta1, dtheta1, theta2, dtheta2)
