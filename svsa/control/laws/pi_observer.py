"""NDOBC on a proportional-integral observer: x̂ and ŵ from positions alone, in one observer.

Each body is predicted by the nominal model with ŵ and the actual torque; then position, velocity
and ŵ are corrected with three poles at ω. The law is Eq 24 with that x̂ and ŵ. It needs no
velocity, and avoids the lag of a separate state estimator, because it uses the encoder readings
directly.
"""

from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import Actuator
from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.control.law import Law, Setting
from svsa.control.laws.feedback_linearization import GainConstants
from svsa.control.laws.ndobc import compute_ndobc
from svsa.control.observers.extended import TriplePole, build_triple_pole
from svsa.control.observers.own import Observed, get_observed, remember_state
from svsa.control.observers.state import predict_state
from svsa.control.parameters import LawParameters
from svsa.inputs.checked import Number, quantity
from svsa.numerics.compilation import compiled
from svsa.numerics.simd.choice import choose


class PolesAndObserver(LawParameters):
    """Poles on the real axis, and the observer's.

    The defaults come from 64 Sobol points (a 58.5–62, p 35–70, ω 148–168) and 30 steps from the
    best, among those that satisfy every column of the prototypes' figures (`python -m
    tests.benchmarks.prototypes`): near the one with the fewest faults in 48 load removals. Cost of
    the training runs 0.84; 0.82 with 61.6, 49.5, 151.
    """

    position_pole_rad_per_s: Number = quantity(
        "rad/s", "a of (s + a)⁴ of the position", symbol="a", ge=5, le=150, default=59.0
    )
    stiffness_pole_rad_per_s: Number = quantity(
        "rad/s", "p of (s + p)² of the stiffness", symbol="p", ge=5, le=150, default=54.0
    )
    observer_rad_per_s: Number = quantity(
        "rad/s", "ω: three poles of the observer of each body", symbol="ω", ge=5, le=500,
        default=167.0,
    )  # fmt: skip


class Constants(NamedTuple):
    """Gains of law and observer.

    Attributes:
        gains: Gains of Eq 25.
        observer: Gains of the corrector.
    """

    gains: GainConstants
    observer: TriplePole


def build(parameters: PolesAndObserver, setting: Setting) -> Constants:
    """The coefficients of (s + a)⁴ and (s + p)², and the gains of the observer for this period."""
    a, p = parameters.position_pole_rad_per_s, parameters.stiffness_pole_rad_per_s
    gains = GainConstants(a**4, 4.0 * a**3, 6.0 * a**2, 4.0 * a, p**2, 2.0 * p)
    return Constants(gains, build_triple_pole(parameters.observer_rad_per_s, setting.period))


@compiled
def correct_body(
    gains: TriplePole,
    position: float,
    velocity: float,
    disturbance: float,
    inertia: float,
    measured: float,
) -> tuple[float, float, float]:
    """Position, velocity and ŵ of one body moved towards its measured position, rad."""
    r = measured - position
    return (
        position + gains.position * r,
        velocity + gains.velocity * r,
        disturbance + inertia * gains.acceleration * r,
    )


@compiled
def control(
    nominal: Actuator,
    constants: Constants,
    memory: np.record,
    x: State,
    reference: Reference,
    estimate: Disturbance,
    applied: Torque,
    period: float,
    measured: Positions,
) -> Torque:
    """NDOBC on its own x̂ and ŵ."""
    k, m, own = constants.observer, measured, memory
    y = predict_state(nominal, own.x, get_observed(own), applied, period)
    q, dq, w2 = correct_body(k, y.q, y.dq, own.w2, nominal.M, m.q)
    theta1, dtheta1, w4 = correct_body(k, y.theta1, y.dtheta1, own.w4, nominal.B1, m.theta1)
    theta2, dtheta2, w6 = correct_body(k, y.theta2, y.dtheta2, own.w6, nominal.B2, m.theta2)
    is_started = own.is_started > 0.0
    given = State(x.q, x.dq, x.theta1, x.dtheta1, x.theta2, x.dtheta2)
    known = choose(is_started, State(q, dq, theta1, dtheta1, theta2, dtheta2), given)
    own.w2 = choose(is_started, w2, own.w2)
    own.w4 = choose(is_started, w4, own.w4)
    own.w6 = choose(is_started, w6, own.w6)
    remember_state(own, known)
    return compute_ndobc(nominal, constants.gains, known, reference, get_observed(own))


PI_OBSERVER = Law(
    name="pi_observer",
    title="PI observer",
    summary="NDOBC with one observer of state and load, which needs position measurements only.",
    equation=r"u=A^{-1}(b-v-\Gamma\hat w),\quad\dot{\hat w}=\omega^3 J\,(y-\hat y)",
    source="",
    parameters=PolesAndObserver,
    build=build,
    control=control,
    memory=Observed,
    estimate="own",
)
