"""The state estimator: measured positions → x̂, by predictor and corrector."""

from svsa.actuators.dynamics import Actuator, ExternalLoad, compute_rate, shift
from svsa.actuators.signals import Disturbance, Measurement, State, Torque
from svsa.numerics.compilation import compiled


@compiled
def build_measured_state(measurement: Measurement) -> State:
    """Build x̂ from measured positions and velocities: q = θ1 + φ, the rest as measured."""
    y = measurement
    return State(y.theta1 + y.phi, y.dq, y.theta1, y.dtheta1, y.theta2, y.dtheta2)


@compiled
def correct(
    position: float, velocity: float, measured: float, decay: float, period: float
) -> tuple[float, float]:
    """Correct position and velocity towards the measured position (rad), critically damped.

    With p = e^(−ωT) for the corner ω: position += (1 − p²) r, velocity += (1 − p)²/T · r, r =
    measured − position. Both errors then decay as p^k.

    Args:
        position: Predicted position, rad.
        velocity: Predicted velocity, rad/s.
        measured: Measured position, rad.
        decay: p.
        period: T, s.

    Returns:
        Position, rad, and velocity, rad/s.
    """
    p = decay
    residual = measured - position
    rate = (1.0 - p) * (1.0 - p) / period
    return position + (1.0 - p * p) * residual, velocity + rate * residual


@compiled
def predict_state(
    nominal: Actuator, x: State, w: Disturbance, torque: Torque, period: float
) -> State:
    """Predict x̂ one period later by Heun's rule on ẋ = f(x) + g(x)u + p(x)ŵ.

    Args:
        nominal: Constants of the nominal model.
        x: Estimated state x̂.
        w: Estimated disturbance ŵ, N·m.
        torque: Motor torque u in the period, N·m.
        period: Control period T, s.

    Returns:
        State x̂ at the end of the period.
    """
    load = ExternalLoad(w.w2, w.w4, w.w6, 0.0, 0.0)
    k1 = compute_rate(nominal, x, torque, load)
    k2 = compute_rate(nominal, shift(x, k1, period), torque, load)
    return shift(shift(x, k1, 0.5 * period), k2, 0.5 * period)


@compiled
def update_state_estimate(
    nominal: Actuator,
    decay: float,
    x: State,
    w: Disturbance,
    torque: Torque,
    measurement: Measurement,
    period: float,
) -> State:
    """x̂ after a sample: predicted by the nominal model with ŵ (Eq 8), then corrected.

    Args:
        nominal: `Actuator` of the nominal model.
        decay: e^(−ωT) of the corner ω.
        x: Last x̂, `State`.
        w: ŵ, `Disturbance`, N·m.
        torque: `Torque` applied since, N·m.
        measurement: Current `Measurement`.
        period: T, s.

    Returns:
        `State`.
    """
    x = predict_state(nominal, x, w, torque, period)
    y = measurement
    q, dq = correct(x.q, x.dq, y.theta1 + y.phi, decay, period)
    theta1, dtheta1 = correct(x.theta1, x.dtheta1, y.theta1, decay, period)
    theta2, dtheta2 = correct(x.theta2, x.dtheta2, y.theta2, decay, period)
    return State(q, dq, theta1, dtheta1, theta2, dtheta2)
